#include <import/base/numbers.hpp>

#include <cctype>
#include <charconv>
#include <cstdlib>

namespace espalier::importer {

namespace {

template <std::size_t Size, class... Arguments>
std::string_view write(std::array<char, Size>& buffer, Arguments... arguments) {
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), arguments...);
    return {buffer.data(), end.ptr};
}

template <class Number>
std::optional<Number> parsed(const std::string& text, Number (*convert)(const char*, char**)) {
    char* end = nullptr;
    const Number value = convert(text.c_str(), &end);
    if (end == text.c_str() || end != text.c_str() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

TextPart::TextPart(char character) : buffer_{character}, words_(buffer_.data(), 1) {}
// Adding 0 makes -0, which an exact cancellation leaves in a coordinate, 0, and leaves other numbers as they are.
TextPart::TextPart(float number) : words_(write(buffer_, number + 0.0f)) {}
TextPart::TextPart(double number) : words_(write(buffer_, number + 0.0)) {}
TextPart::TextPart(bool is_negative, std::uint64_t bits)
    : words_(is_negative ? write(buffer_, static_cast<std::int64_t>(bits)) : write(buffer_, bits)) {}

std::string joined(std::span<const TextPart> parts) {
    std::string result;
    for (const TextPart& part : parts) result += part.words();
    return result;
}

std::string shortest(float value) { return text(value); }
std::string shortest(double value) { return text(value); }
std::string rounded(double value, int digits) {
    std::array<char, 64> buffer;
    return std::string(write(buffer, value + 0.0, std::chars_format::general, digits));
}
std::string shortest(Vec3 value) { return shortest(value.x) + ' ' + shortest(value.y) + ' ' + shortest(value.z); }

std::optional<double> parse_double(const std::string& text) { return parsed(text, std::strtod); }
std::optional<float> parse_float(const std::string& text) { return parsed(text, std::strtof); }

std::string counted(unsigned long long count, std::string_view singular) {
    if (count == 1) return text(count, ' ', singular);
    if (singular.ends_with("mesh")) return text(count, ' ', singular, "es");
    if (singular.ends_with("leaf")) return text(count, ' ', singular.substr(0, singular.size() - 1), "ves");
    if (singular.ends_with("vertex")) return text(count, ' ', singular.substr(0, singular.size() - 2), "ices");
    return text(count, ' ', singular, 's');
}

std::string lower_case(std::string_view words) {
    std::string result(words);
    for (char& letter : result) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return result;
}

std::string printable(std::string_view name) {
    std::string result{name};
    for (char& character : result) {
        const auto code = static_cast<unsigned char>(character);
        if (code < 0x20 || code == 0x7F) character = '?';
    }
    return result;
}

}  // namespace espalier::importer
