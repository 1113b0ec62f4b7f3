// The lattice of one asset: world = origin + q * 2^step_exponent with whole q.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include <espalier/bake.hpp>

#include "source.hpp"

namespace espalier::baker {

struct LatticePoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

struct Lattice {
    Vec3 origin;
    int step_exponent = 0;
    unsigned bits = 1;

    [[nodiscard]] double step() const { return std::ldexp(1.0, step_exponent); }
};

/// The box around the corners of all triangles that have an area.
struct SourceBounds {
    Vec3 min;
    Vec3 max;
    double largest_side = 0.0;
    float largest_coordinate = 0.0f;  ///< of any sign
};

/// The float32 to write for the origin: finite, and zero for minus zero, which would be a second way to write the same
/// origin, and for subnormal numbers, which the format does not allow there: they are far below the finest step.
[[nodiscard]] float origin_coordinate(double coordinate);

[[nodiscard]] SourceBounds bounds_of(const Source& source);

/// Round to nearest, ties to even, for |value| < 2^51: in binary64 the sum keeps no bit below 1.
[[nodiscard]] inline double round_half_even(double value) {
    constexpr double shifter = 0x1.8p52;
    return (value + shifter) - shifter;
}

/// A coordinate in steps from the origin, rounded to whole ones. Deterministic: two correctly rounded operations, of
/// which the second, by a power of two, is exact.
[[nodiscard]] inline double snap_coordinate(float coordinate, float origin, double reciprocal_step) {
    return round_half_even((double(coordinate) - double(origin)) * reciprocal_step);
}

/// Whether the lattice is finer than float32 numbers are around the farthest coordinate: it then only records noise.
[[nodiscard]] bool is_below_float_spacing(const Lattice& lattice, const SourceBounds& bounds);

/// The finest lattice on which `bits` hold every coordinate.
[[nodiscard]] Result<Lattice, BakeError> lattice_for_bits(const SourceBounds& bounds, unsigned bits);

/// The largest step exponent at which no lattice point is farther than `tolerance` from what it stands for.
[[nodiscard]] int step_exponent_for_tolerance(double tolerance);

/// The lattice with this step and as few bits as hold every coordinate.
[[nodiscard]] Result<Lattice, BakeError> lattice_for_step(const SourceBounds& bounds, int step_exponent,
                                                          double tolerance);

}  // namespace espalier::baker
