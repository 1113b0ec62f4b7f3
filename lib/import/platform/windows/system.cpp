#include <import/platform/windows/system.hpp>

#include <windows.h>

#include <cerrno>
#include <system_error>

namespace espalier::importer {

std::string utf8_of(std::wstring_view text) {
    const int length = static_cast<int>(text.size());
    if (length == 0) return {};
    const int bytes = ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, nullptr, 0, nullptr, nullptr);
    std::string result(static_cast<std::size_t>(bytes), '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, result.data(), bytes, nullptr, nullptr);
    return result;
}

std::wstring utf16_of(std::string_view text) {
    const int length = static_cast<int>(text.size());
    if (length == 0) return {};
    const int words = ::MultiByteToWideChar(CP_UTF8, 0, text.data(), length, nullptr, 0);
    std::wstring result(static_cast<std::size_t>(words), L'\0');
    ::MultiByteToWideChar(CP_UTF8, 0, text.data(), length, result.data(), words);
    return result;
}

int last_error() {
    const std::error_code error(static_cast<int>(::GetLastError()), std::system_category());
    const std::error_condition condition = error.default_error_condition();
    return condition.category() == std::generic_category() ? condition.value() : EIO;
}

}  // namespace espalier::importer
