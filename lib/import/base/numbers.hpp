// Numbers to text and back. The text is the shortest that reads back as the same number; -0 is written as 0.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <espalier/types.hpp>

namespace espalier::importer {

std::string shortest(float value);
std::string shortest(double value);
/// Rounded to this many significant digits, for people.
std::string rounded(double value, int digits = 6);
/// "x y z"
std::string shortest(Vec3 value);

/// The whole text as a number; spaces before it are ignored. "inf" and "nan" are numbers here.
std::optional<double> parse_double(const std::string& text);
std::optional<float> parse_float(const std::string& text);

/// A part of a text: characters, or a number in its shortest form.
class TextPart {
public:
    TextPart(std::string_view words) : words_(words) {}
    TextPart(const std::string& words) : words_(words) {}
    TextPart(const char* words) : words_(words) {}
    TextPart(char character);
    TextPart(float number);
    TextPart(double number);
    TextPart(std::signed_integral auto number) : TextPart(number < 0, static_cast<std::uint64_t>(number)) {}
    TextPart(std::unsigned_integral auto number) : TextPart(false, std::uint64_t{number}) {}
    TextPart(bool) = delete;
    TextPart(const TextPart&) = delete;  // it may contain what it refers to
    TextPart& operator=(const TextPart&) = delete;

    [[nodiscard]] std::string_view words() const { return words_; }

private:
    TextPart(bool is_negative, std::uint64_t bits);

    std::array<char, 32> buffer_;
    std::string_view words_;
};

std::string joined(std::span<const TextPart> parts);

/// The parts as one string.
template <class... Parts>
std::string text(const Parts&... parts) {
    const TextPart all[] = {TextPart(parts)...};
    return joined(all);
}

/// The texts of things, with `between` between them.
template <class Things, class TextOf = std::identity>
std::string listed(const Things& things, std::string_view between, const TextOf& text_of = {}) {
    std::string result;
    for (const auto& thing : things)
        result += text(result.empty() ? std::string_view() : between, std::invoke(text_of, thing));
    return result;
}

/// "1 triangle", "2 triangles"
std::string counted(unsigned long long count, std::string_view singular);

/// Returns the text with the letters of ASCII in lower case.
std::string lower_case(std::string_view words);

/// Names come out of files that nobody trusts: control characters, which would steer a terminal, become '?'.
std::string printable(std::string_view name);

}  // namespace espalier::importer
