// The places of instances in float64. An instance places what its source was: its rotation and scale apply to the
// origin of its mesh as well, which the bake of the mesh subtracted. The scene's own origin is subtracted next. Only
// then does a translation become float32, by one rounding.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/scene.hpp>
#include <espalier/types.hpp>

#include <baker/scenes/instance_boxes.hpp>

namespace espalier::baker {

/// The sum of two float64 numbers, of which the second is at most half a unit in the last place of the first (Dekker
/// 1971; Hida, Li, Bailey 2001). Each result is within 2^-103 of itself.
struct DoubleSum {
    double high = 0.0;
    double low = 0.0;

    friend DoubleSum operator+(const DoubleSum& a, const DoubleSum& b);
    friend DoubleSum operator-(const DoubleSum& a);
    friend DoubleSum operator*(const DoubleSum& a, double b);
    friend DoubleSum operator/(const DoubleSum& a, const DoubleSum& b);
};

/// The place of a mesh's local origin in the source, with about 104 bits: rotation · (scale · origin) + translation.
class ExactPlace {
public:
    ExactPlace(const Transform& transform, const Vec3d& translation, const Vec3d& origin);

    /// Returns the place, each coordinate rounded to float64.
    [[nodiscard]] Vec3d rounded() const { return {sum_[0].high, sum_[1].high, sum_[2].high}; }
    /// Returns the place as it is from an origin, each coordinate rounded once to float32. `moved` receives a bound on
    /// how far that moves it: 0 if float32 holds it.
    [[nodiscard]] Vec3 seen_from(const Vec3d& origin, double& moved) const;

private:
    std::array<DoubleSum, 3> sum_;
    double slack_;  ///< a bound on what the sums leave out
};

/// An instance as the choice of an origin takes it.
struct PlacedBox {
    WorldBox box;        ///< around it, in the source
    double step;         ///< of its lattice in the world; of a tile the finest one; infinite without triangles
    bool is_in_float64;  ///< float32 does not hold its translation, its mesh has an origin, or the caller gave the
                         ///< scene one
};

/// Returns the first instance that float32 moves farther than a quarter of its step if coordinates count from `origin`;
/// of instances that float32 holds as they were given, none.
[[nodiscard]] std::optional<std::size_t> find_too_far(std::span<const PlacedBox> instances, const Vec3d& origin);

/// Returns an origin for the scene. 0 if find_too_far() finds none from there, unless float32 is too coarse at an
/// instance and all lie far from 0 for their size. Else a place near the middle of all instances: a multiple of a power
/// of two above the step of each, so that what was moved by whole steps still is, and above a 64th of the largest side.
/// If that is near enough, a view of a moving scene can have it too.
[[nodiscard]] Vec3d choose_scene_origin(std::span<const PlacedBox> instances);

}  // namespace espalier::baker
