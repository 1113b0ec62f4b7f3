// The lattice of one asset: world = origin + q * 2^step_exponent with whole q. The origin is itself a whole multiple of
// the step, so that all assets with one step lie on one lattice, whatever their origins are.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <espalier/bake.hpp>
#include <espalier/lattice.hpp>

#include <baker/base/expected.hpp>
#include <baker/input/source.hpp>

namespace espalier::baker {

[[nodiscard]] inline std::int32_t coordinate_of(const LatticePoint& point, std::size_t axis) {
    return axis == 0 ? point.x : axis == 1 ? point.y : point.z;
}

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

[[nodiscard]] SourceBounds bounds_of(const Source& source);

/// Round to nearest, ties to even, for |value| < 2^51: in binary64 the sum keeps no bit below 1.
[[nodiscard]] inline double round_half_even(double value) {
    constexpr double shifter = 0x1.8p52;
    return (value + shifter) - shifter;
}

/// The multiple of the step nearest to a coordinate, ties to even, as a number of steps from the world's origin. It
/// depends on the coordinate and the step alone. Float32 represents it, times the step: it is whole and at most 2^24,
/// or the coordinate itself, since float32 numbers from 2^24 on are whole. It is never minus zero.
[[nodiscard]] inline double snap_to_step(float coordinate, double reciprocal_step) {
    const double steps = double(coordinate) * reciprocal_step;  // exact: by a power of two, within binary64
    // mutant(< -> <=) equivalent: 2^24 is whole and rounds to itself
    return std::abs(steps) < 0x1p24 ? round_half_even(steps) : steps;
}

/// The same as a lattice coordinate: exact up to 2^53 steps, and not below 2^53 beyond.
[[nodiscard]] inline double snap_coordinate(float coordinate, float origin, double reciprocal_step) {
    return snap_to_step(coordinate, reciprocal_step) - double(origin) * reciprocal_step;
}

/// Whether the lattice is finer than float32 numbers are around the farthest coordinate: it then only records noise.
[[nodiscard]] bool is_below_float_spacing(const Lattice& lattice, const SourceBounds& bounds);

/// The finest lattice on which `bits` hold every coordinate.
Expected<Lattice> lattice_for_bits(const SourceBounds& bounds, unsigned bits);

/// How far a lattice point may be from what it stands for, as a header would say it.
[[nodiscard]] float largest_snap_error(int step_exponent);

/// The largest step exponent at which no lattice point is farther than `tolerance` from what it stands for.
[[nodiscard]] int step_exponent_for_tolerance(double tolerance);

/// The lattice with this step and as few bits as hold every coordinate; refused with the step that would fit.
Expected<Lattice> lattice_for_step(const SourceBounds& bounds, int step_exponent);

/// The same for a step that keeps a tolerance; refused with the tolerance that would fit.
Expected<Lattice> lattice_for_tolerance(const SourceBounds& bounds, int step_exponent, double tolerance);

}  // namespace espalier::baker
