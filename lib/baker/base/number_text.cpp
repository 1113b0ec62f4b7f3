#include <baker/base/number_text.hpp>

#include <cmath>
#include <cstdio>

namespace espalier::baker {

namespace {

std::string text_of(double value, int digits) {
    if (std::isnan(value)) return "NaN";
    if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

}  // namespace

std::string number_text(double value) { return text_of(value, 9); }

std::string short_number_text(double value) { return text_of(value, 6); }

std::optional<std::string> find_not_finite(const Vec3& point) {
    return find_not_finite(Vec3d{double(point.x), double(point.y), double(point.z)});
}

std::optional<std::string> find_not_finite(const Vec3d& point) {
    if (!std::isfinite(point.x)) return "x = " + number_text(point.x);
    if (!std::isfinite(point.y)) return "y = " + number_text(point.y);
    if (!std::isfinite(point.z)) return "z = " + number_text(point.z);
    return std::nullopt;
}

}  // namespace espalier::baker
