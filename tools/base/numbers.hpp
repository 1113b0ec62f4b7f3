// Numbers to text and back. The text is the shortest that reads back as the same number.
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include <espalier/types.hpp>

namespace espalier::tools {

std::string shortest(float value);
std::string shortest(double value);
/// Rounded to this many significant digits, for people.
std::string rounded(double value, int digits = 6);
/// "x y z"
std::string shortest(Vec3 value);

/// The whole text as a number; spaces before it are ignored. "inf" and "nan" are numbers here.
std::optional<double> parse_double(const std::string& text);
std::optional<float> parse_float(const std::string& text);

/// The parts as one string, numbers in their shortest form.
template <class... Parts>
std::string text(const Parts&... parts) {
    std::ostringstream stream;
    const auto append = [&stream](const auto& part) {
        if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(part)>>) {
            stream << shortest(part);
        } else {
            stream << part;
        }
    };
    (append(parts), ...);
    return stream.str();
}

/// "1 triangle", "2 triangles"
std::string counted(unsigned long long count, std::string_view singular);

/// Names come out of files that nobody trusts: control characters, which would steer a terminal, become '?'.
std::string printable(std::string_view name);

}  // namespace espalier::tools
