#include "base64.hpp"

#include <cstdint>

namespace espalier::tools {

namespace {

/// Returns 64 for what is no digit.
std::uint32_t digit_value(char digit) {
    if (digit >= 'A' && digit <= 'Z') return static_cast<std::uint32_t>(digit - 'A');
    if (digit >= 'a' && digit <= 'z') return static_cast<std::uint32_t>(digit - 'a' + 26);
    if (digit >= '0' && digit <= '9') return static_cast<std::uint32_t>(digit - '0' + 52);
    if (digit == '+') return 62;
    return digit == '/' ? 63 : 64;
}

}  // namespace

std::optional<std::vector<std::byte>> decode_base64(std::string_view text) {
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> result;
    result.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    unsigned count = 0;
    for (const char digit : text) {
        const std::uint32_t value = digit_value(digit);
        if (value == 64) return std::nullopt;
        bits = bits << 6 | value;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        result.push_back(static_cast<std::byte>(bits >> count & 0xffu));
    }
    return result;
}

}  // namespace espalier::tools
