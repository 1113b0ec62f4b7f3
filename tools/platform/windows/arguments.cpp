#include "platform/arguments.hpp"

#include <windows.h>

#include <shellapi.h>

#include "text.hpp"

namespace espalier::tools {

/// Those of main are in the code page of the machine, which lacks most letters.
std::vector<std::string> words_of_command_line(int, char**) {
    int count = 0;
    wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
    std::vector<std::string> result;
    for (int i = 1; i < count; ++i) result.push_back(utf8_of(words[i]));
    ::LocalFree(words);
    return result;
}

}  // namespace espalier::tools
