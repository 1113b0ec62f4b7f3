#include "platform/standard_streams.hpp"

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <stdio.h>

#include <cstdlib>

#include "platform/paths.hpp"

namespace espalier::tools {

namespace {

UINT code_page_before = 0;

/// The console outlives the process, and programs after it expect their own code page.
void restore_code_page() { ::SetConsoleOutputCP(code_page_before); }

void write_to(int descriptor, std::string_view words) {
    const int written = ::_write(descriptor, words.data(), static_cast<unsigned>(words.size()));
    static_cast<void>(written);
}

/// The number of a file on its disk.
bool identity_of(HANDLE file, BY_HANDLE_FILE_INFORMATION& identity) {
    return ::GetFileType(file) == FILE_TYPE_DISK && ::GetFileInformationByHandle(file, &identity) != 0;
}

}  // namespace

void prepare_standard_streams() {
    for (FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
    code_page_before = ::GetConsoleOutputCP();
    if (code_page_before == 0 || code_page_before == CP_UTF8) return;
    if (::SetConsoleOutputCP(CP_UTF8) != 0) std::atexit(restore_code_page);
}

bool is_stderr_terminal() {
    const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
    DWORD mode = 0;
    if (::GetConsoleMode(console, &mode) == 0) return false;
    return ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

bool is_standard_output(const std::string& path) {
    if (path == "/dev/stdout") return true;  // the name that other systems have for it
    const HANDLE file = ::CreateFileW(path_of(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                      nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file == INVALID_HANDLE_VALUE) return false;
    BY_HANDLE_FILE_INFORMATION named{};
    BY_HANDLE_FILE_INFORMATION standard_output{};
    const bool both_are_files =
        identity_of(file, named) && identity_of(::GetStdHandle(STD_OUTPUT_HANDLE), standard_output);
    ::CloseHandle(file);
    return both_are_files && named.dwVolumeSerialNumber == standard_output.dwVolumeSerialNumber &&
           named.nFileIndexHigh == standard_output.nFileIndexHigh &&
           named.nFileIndexLow == standard_output.nFileIndexLow;
}

void end_process(int exit_code, std::string_view to_stderr, std::string_view to_stdout) {
    write_to(2, to_stderr);
    write_to(1, to_stdout);
    if (code_page_before != 0) restore_code_page();
    ::_exit(exit_code);
}

}  // namespace espalier::tools
