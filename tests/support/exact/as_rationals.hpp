// The runtime's rounded queries and lattice triangles as rationals: the only place where the oracle and the runtime
// meet.
#pragma once

#include <array>
#include <cstdint>

#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

#include "oracle/exact_geometry.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

using oracle::Rational;

inline oracle::Point exact_point(const GridPoint& point) {
    return oracle::Point(Rational(point[0]), Rational(point[1]), Rational(point[2]));
}

inline oracle::Triangle exact_triangle(const GridTriangle& triangle) {
    return {exact_point(triangle.a), exact_point(triangle.b), exact_point(triangle.c)};
}

/// In lattice steps, parametrised by tau.
inline oracle::Line exact_line(const detail::LatticeRay& ray) {
    oracle::Line line;
    for (int k = 0; k < 3; ++k) {
        line.origin[k] = Rational::of(std::int64_t{ray.origin[k]}, -ray.fraction_bits);
        line.direction[k] = Rational(std::int64_t{ray.direction[k]});
    }
    return line;
}

inline oracle::Point exact_center(const detail::RoundedPoint& point) {
    oracle::Point center;
    for (int k = 0; k < 3; ++k) center[k] = Rational::of(point.origin[k], -point.fraction_bits);
    return center;
}

inline detail::LatticeTriangle lattice_triangle(const GridTriangle& triangle) {
    return {{{triangle.a[0], triangle.a[1], triangle.a[2]},
             {triangle.b[0], triangle.b[1], triangle.b[2]},
             {triangle.c[0], triangle.c[1], triangle.c[2]}}};
}

/// An asset that is the lattice itself: world coordinates are lattice steps, so that tests choose the rounded query.
inline detail::BlobData lattice_asset(unsigned bits) {
    detail::BlobData data;
    data.bits = static_cast<std::uint8_t>(bits);
    for (int k = 0; k < 3; ++k) data.extent[k] = (std::int32_t{1} << bits) - 1;
    data.derive();
    return data;
}

}  // namespace espalier::tests
