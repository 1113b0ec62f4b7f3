// The lattice of one asset: world = origin + q * 2^step_exponent with whole q. The origin is itself a whole multiple of
// the step, so that all assets with one step lie on one lattice, whatever their origins are. Before, an origin of the
// source is subtracted from all positions, which is a multiple of the step too where the baker chooses it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <espalier/bake.hpp>
#include <espalier/advanced/lattice.hpp>

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
    Vec3d min;
    Vec3d max;
    double largest_side = 0.0;
    double largest_coordinate = 0.0;  ///< of any sign

    explicit SourceBounds(const Vec3d& point = {}) : min(point), max(point) {}
    void add(const Vec3d& point) {
        min = {std::min(min.x, point.x), std::min(min.y, point.y), std::min(min.z, point.z)};
        max = {std::max(max.x, point.x), std::max(max.y, point.y), std::max(max.z, point.z)};
    }
    /// Sets what follows from the corners.
    void measure() {
        largest_side = std::max({max.x - min.x, max.y - min.y, max.z - min.z});
        largest_coordinate = std::max(
            {std::abs(min.x), std::abs(min.y), std::abs(min.z), std::abs(max.x), std::abs(max.y), std::abs(max.z)});
    }
};

[[nodiscard]] SourceBounds bounds_of(const Source& source);

/// Returns BakeOptions::origin; where there is none, 0 or a place near the middle of the meshes. The latter is a whole
/// multiple of a power of two that no side of the meshes reaches, and so of any step: tiles with an origin each stay on
/// one lattice.
[[nodiscard]] Vec3d choose_origin(std::span<const MeshView> meshes, const BakeOptions& options);

/// Round to nearest, ties to even, for |value| < 2^51: in binary64 the sum keeps no bit below 1.
[[nodiscard]] inline double round_half_even(double value) {
    constexpr double shifter = 0x1.8p52;
    return (value + shifter) - shifter;
}

/// The multiple of the step nearest to a coordinate, ties to even, as a number of steps from 0. It depends on the
/// coordinate and the step alone. Float32 represents it, times the step: it is whole and at most 2^24, or the float32
/// nearest to the coordinate, since float32 numbers from 2^24 on are whole. It is never minus zero.
[[nodiscard]] inline double snap_to_step(double coordinate, double reciprocal_step) {
    const double steps = coordinate * reciprocal_step;  // exact: by a power of two, within binary64
    // mutant(< -> <=) equivalent: 2^24 is whole and rounds to itself
    return std::abs(steps) < 0x1p24 ? round_half_even(steps) : double(static_cast<float>(coordinate)) * reciprocal_step;
}

/// Snaps to a lattice coordinate: exact up to 2^53 steps, and at least 2^53 beyond.
[[nodiscard]] inline double snap_coordinate(double coordinate, float origin, double reciprocal_step) {
    return snap_to_step(coordinate, reciprocal_step) - double(origin) * reciprocal_step;
}

/// Whether the lattice is finer than float32 numbers are around the farthest coordinate: of a float32 source it then
/// only records noise.
[[nodiscard]] bool is_below_float_spacing(const Lattice& lattice, const SourceBounds& bounds);

/// The finest lattice on which `bits` hold every coordinate.
Expected<Lattice> lattice_for_bits(const SourceBounds& bounds, unsigned bits);

/// How far a lattice point may be from what it stands for, as a header would say it.
[[nodiscard]] float largest_snap_error(int step_exponent);

/// The largest step exponent at which no lattice point is farther than `tolerance` from what it stands for.
[[nodiscard]] int step_exponent_for_tolerance(double tolerance);

/// The lattice with this step and as few bits as hold every coordinate; refused with the step that would fit.
Expected<Lattice> lattice_for_step(const SourceBounds& bounds, int step_exponent);

/// Returns the lattice whose step keeps a tolerance, or an error that names the tolerance that would fit.
Expected<Lattice> lattice_for_tolerance(const SourceBounds& bounds, int step_exponent, double tolerance);

}  // namespace espalier::baker
