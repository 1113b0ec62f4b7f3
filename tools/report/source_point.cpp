#include "source_point.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include <import/base/numbers.hpp>
#include <import/base/placement.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

/// Coordinates of maps are long; beyond these sizes a number has an exponent of ten.
constexpr double largest_plain = 1e15, smallest_plain = 1e-5;

std::string without_exponent(double number) {
    if (number != 0.0 && !(std::abs(number) >= smallest_plain && std::abs(number) < largest_plain))
        return shortest(number);
    std::array<char, 64> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), number + 0.0, std::chars_format::fixed);
    return {buffer.data(), end.ptr};
}

double in_source(float coordinate, double origin) {
    constexpr int least_digits = 6;  // shorter ones have zeros there
    const double sum = double(coordinate) + origin;
    if (!std::isfinite(sum)) return sum;
    for (int digits = least_digits; digits < std::numeric_limits<double>::max_digits10; ++digits) {
        const double shorter = parse_double(rounded(sum, digits)).value_or(sum);
        if (to_float32(shorter - origin) == coordinate) return shorter;
    }
    return sum;
}

}  // namespace

std::string words_in_source(float coordinate, double origin) {
    return origin == 0.0 ? shortest(coordinate) : without_exponent(in_source(coordinate, origin));
}

Json json_in_source(float coordinate, double origin) {
    if (origin == 0.0) return json_number(coordinate);
    const double number = in_source(coordinate, origin);
    return std::isfinite(number) ? Json(number) : Json(nullptr);
}

std::string words_for_point(const SourcePoint& point) {
    const auto& [in_blob, origin] = point;
    return text(words_in_source(in_blob.x, origin.x), ' ', words_in_source(in_blob.y, origin.y), ' ',
                words_in_source(in_blob.z, origin.z));
}

Json json_point(const SourcePoint& point) {
    const auto& [in_blob, origin] = point;
    return Json::array({json_in_source(in_blob.x, origin.x), json_in_source(in_blob.y, origin.y),
                        json_in_source(in_blob.z, origin.z)});
}

Json json_box(const SourceBox& box) { return {{"min", json_point(box.min)}, {"max", json_point(box.max)}}; }

std::string words_for_origin(const Vec3d& origin) {
    return text(without_exponent(origin.x), ' ', without_exponent(origin.y), ' ', without_exponent(origin.z));
}

}  // namespace espalier::tools
