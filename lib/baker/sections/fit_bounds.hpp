// Bounds of the whole asset, tighter than its axis-aligned box: a sphere, an oriented box, a 26-DOP.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/format.hpp>

#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

/// Lengths in 1 / format::bounds::units_per_step.
struct FittedBox {
    std::array<std::int32_t, 4> quaternion{};  ///< w x y z
    std::array<std::int32_t, 3> lo{};          ///< along each row of its rotation, rounded down
    std::array<std::int32_t, 3> hi{};          ///< rounded up
};

struct FittedSphere {
    std::array<std::int32_t, 3> center{};
    std::uint32_t radius = 0;  ///< rounded up
};

/// In lattice steps, exactly: the least that holds all points.
struct FittedKDop {
    std::array<std::int32_t, format::bounds::k_dop_directions> lo{};
    std::array<std::int32_t, format::bounds::k_dop_directions> hi{};
};

/// The points farthest out in each of some hundred directions: whatever is fitted to them is nearly right for all.
[[nodiscard]] std::vector<LatticePoint> outermost_points(std::span<const LatticePoint> points);

/// Each holds all points, which is decided in integers; how tight it is depends on `outermost` as well. At least one
/// point. The same on every machine.
///
/// A box of little surface: a pattern search over rotations from 27 starts (after Chang, Gorissen, Melchior 2011, on
/// the outermost points alone as in Larsson, Källberg 2011). Its surface is at most that of the axis-aligned box, up to
/// rounding.
[[nodiscard]] FittedBox fit_box(std::span<const LatticePoint> points, std::span<const LatticePoint> outermost);
/// Within about a thousandth of the least radius (Badoiu, Clarkson 2003: steps towards the farthest point).
[[nodiscard]] FittedSphere fit_sphere(std::span<const LatticePoint> points, std::span<const LatticePoint> outermost);
[[nodiscard]] FittedKDop fit_k_dop(std::span<const LatticePoint> points);

/// Volumes in cubic lattice steps.
[[nodiscard]] double volume_of(const FittedBox& box);
[[nodiscard]] double volume_of(const FittedSphere& sphere);
/// Returns the volume of the intersection of the 26-DOP with the axis-aligned box from 0 to extent.
[[nodiscard]] double volume_of(const FittedKDop& k_dop, const LatticePoint& extent);

}  // namespace espalier::baker
