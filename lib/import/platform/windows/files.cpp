#include <import/platform/files.hpp>

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <algorithm>
#include <random>

#include <import/platform/process.hpp>
#include <import/platform/windows/system.hpp>

namespace espalier::importer {

namespace {

constexpr std::size_t largest_write = std::size_t{1} << 20;

int write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const auto count = static_cast<unsigned>(std::min(bytes.size(), largest_write));
        const int written = ::_write(descriptor, bytes.data(), count);
        if (written < 0) return errno;
        if (written == 0) return ENOSPC;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return 0;
}

/// Creates a file that did not exist. Returns its descriptor, or -1 and sets errno.
int create_file(const std::filesystem::path& path) {
    return ::_wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
}

/// Returns six letters and digits.
std::string random_ending() {
    constexpr std::string_view characters = "abcdefghijklmnopqrstuvwxyz0123456789";
    std::random_device numbers;
    std::string result;
    for (int i = 0; i < 6; ++i) result += characters[numbers() % characters.size()];
    return result;
}

HANDLE open_existing(const std::filesystem::path& path, DWORD access) {
    return ::CreateFileW(path.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                         OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
}

/// Returns the name of an open file, without the mark of names of any length; an empty one where the drive has none.
std::wstring name_of(HANDLE file) {
    std::wstring name(MAX_PATH, L'\0');
    DWORD length = ::GetFinalPathNameByHandleW(file, name.data(), static_cast<DWORD>(name.size()), 0);
    if (length > name.size()) {
        name.resize(length);
        length = ::GetFinalPathNameByHandleW(file, name.data(), length, 0);
    }
    name.resize(length < name.size() ? length : 0);
    constexpr std::wstring_view mark = L"\\\\?\\";
    constexpr std::wstring_view mark_of_shares = L"\\\\?\\UNC\\";
    if (name.starts_with(mark_of_shares)) return L"\\\\" + name.substr(mark_of_shares.size());
    return name.starts_with(mark) ? name.substr(mark.size()) : name;
}

}  // namespace

std::filesystem::path path_of(std::string_view text) { return {utf16_of(text)}; }

std::string text_of(const std::filesystem::path& path) { return utf8_of(path.native()); }

InputFile::InputFile(const std::filesystem::path& path) : file_(::_wfopen(path.c_str(), L"rb")) {
    if (file_ == nullptr) error_ = errno;
}

std::uint64_t InputFile::size() const {
    if (file_ == nullptr) return 0;
    return static_cast<std::uint64_t>(std::max<__int64>(::_filelengthi64(::_fileno(file_)), 0));
}

/// A link to a file that does not exist is refused, because its name cannot be found.
int follow_links(const std::filesystem::path& path, std::filesystem::path& target) {
    target = path;
    const DWORD attributes = ::GetFileAttributesW(path.c_str());
    if (attributes == INVALID_FILE_ATTRIBUTES) return 0;  // a new file
    const HANDLE file = open_existing(path, 0);
    if (file == INVALID_HANDLE_VALUE) return last_error();
    const std::wstring name = name_of(file);
    const int error = last_error();
    ::CloseHandle(file);
    if (!name.empty()) target = name;
    return name.empty() && (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0 ? error : 0;
}

int write_temporary(const std::filesystem::path& target, std::span<const std::byte> bytes,
                    std::filesystem::path& temporary) {
    temporary.clear();
    std::filesystem::path path;
    int descriptor = -1;
    for (int attempt = 0; attempt < 100 && descriptor < 0; ++attempt) {
        path = target.parent_path() / path_of('.' + text_of(target.filename()) + '.' + random_ending());
        descriptor = create_file(path);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) return errno;
    int error = write_all(descriptor, bytes);
    if (error == 0 && ::_commit(descriptor) != 0) error = errno;
    if (::_close(descriptor) != 0 && error == 0) error = errno;
    if (error == 0) {
        temporary = path;
    } else {
        ::DeleteFileW(path.c_str());
    }
    return error;
}

int replace_file(const std::filesystem::path& target, const std::filesystem::path& temporary) {
    const DWORD flags = MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH;
    return ::MoveFileExW(temporary.c_str(), target.c_str(), flags) != 0 ? 0 : last_error();
}

int write_directly(const std::string& path, std::span<const std::byte> bytes) {
    if (is_standard_output(path)) return write_all(1, bytes);
    const int descriptor = ::_wopen(path_of(path).c_str(), _O_WRONLY | _O_BINARY | _O_NOINHERIT);
    if (descriptor < 0) return errno;
    const int error = write_all(descriptor, bytes);
    return ::_close(descriptor) != 0 && error == 0 ? errno : error;
}

int error_of_writing_to(const std::string& path) {
    constexpr int write_access = 2;
    return ::_waccess(path_of(path).c_str(), write_access) != 0 ? errno : 0;
}

/// A file that is open elsewhere without sharing its deletion stays, and so does a read-only one.
int error_of_replacing(const std::filesystem::path& target) {
    const HANDLE file = open_existing(target, DELETE);
    if (file == INVALID_HANDLE_VALUE) return last_error();
    BY_HANDLE_FILE_INFORMATION facts{};
    const bool is_read_only =
        ::GetFileInformationByHandle(file, &facts) != 0 && (facts.dwFileAttributes & FILE_ATTRIBUTE_READONLY) != 0;
    ::CloseHandle(file);
    return is_read_only ? EACCES : 0;
}

}  // namespace espalier::importer
