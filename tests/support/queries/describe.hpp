// The bits of a query in hexadecimal, to repeat a failure.
#pragma once

#include <array>
#include <bit>
#include <cstdio>
#include <span>
#include <string>
#include <type_traits>

#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

namespace espalier::tests {

inline std::string in_hexadecimal(std::span<const float> numbers) {
    std::string text;
    for (const float number : numbers) {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%a ", static_cast<double>(number));
        text += digits;
    }
    return text;
}

/// Of a shape or a placement, which is a structure of floats.
template <class Shape>
requires(std::is_class_v<Shape>&& std::is_trivially_copyable_v<Shape> && alignof(Shape) == alignof(float)) std::string
    describe(const Shape& shape) {
    return in_hexadecimal(std::bit_cast<std::array<float, sizeof(Shape) / sizeof(float)>>(shape));
}

inline std::string describe(const Ray& ray) {
    const float window[] = {ray.t_min, ray.t_max};
    return describe(ray.origin) + "towards " + describe(ray.direction) + "within " + in_hexadecimal(window) + "faces " +
           std::to_string(static_cast<int>(ray.culling));
}

/// What a kind of shape is called.
inline const char* name_of(const Sphere&) { return "a sphere"; }
inline const char* name_of(const Capsule&) { return "a capsule"; }
inline const char* name_of(const Box&) { return "a box"; }
inline const char* name_of(const OrientedBox&) { return "an oriented box"; }
inline const char* name_of(const Cone&) { return "a cone"; }
inline const char* name_of(const Triangle&) { return "a triangle"; }
inline const char* name_of(const ConvexVolume&) { return "planes"; }
inline const char* name_of(const ConvexHull&) { return "a hull"; }

}  // namespace espalier::tests
