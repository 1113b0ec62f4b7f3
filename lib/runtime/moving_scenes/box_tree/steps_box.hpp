// Boxes of instances in whole steps of a world: integers, so that comparisons are exact and equal everywhere.
#pragma once

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// Coordinates of boxes lie within it, so that differences of two, and to a corner of a coarser grid, fit into 32 bits.
inline constexpr std::int32_t most_world_steps = (1 << 30) - 128;

/// A box in steps of the world; both ends belong to it. Empty if an end is below its start.
struct StepsBox {
    std::int32_t low[3];
    std::int32_t high[3];

    /// Returns a box that touches no other.
    static constexpr StepsBox none() {
        constexpr std::int32_t most = 0x7FFFFFFF, least = -most - 1;
        return {{most, most, most}, {least, least, least}};
    }
    /// Grows to hold another box.
    constexpr void add(const StepsBox& box) {
        for (int k = 0; k < 3; ++k) {
            low[k] = box.low[k] < low[k] ? box.low[k] : low[k];
            high[k] = box.high[k] > high[k] ? box.high[k] : high[k];
        }
    }
    /// Returns half of the surface: the sum of three products of two sides, in float and in this order on every
    /// machine. Of an empty box it is of no meaning.
    [[nodiscard]] constexpr float half_area() const {
        float side[3] = {};
        for (int k = 0; k < 3; ++k)
            side[k] = static_cast<float>(
                static_cast<std::int32_t>(static_cast<std::uint32_t>(high[k]) - static_cast<std::uint32_t>(low[k])));
        return (side[0] * side[1] + side[1] * side[2]) + side[2] * side[0];
    }
    friend constexpr bool operator==(const StepsBox&, const StepsBox&) = default;
};

/// A mesh or a tile as the tree needs it: its box in local space by its middle, its coarsest lattice step, its size,
/// and the largest scale in it.
struct PartBounds {
    Vec3 center;
    Vec3 half;
    float coarsest_step;
    float size;  ///< at least how far a point is from the local origin along any axis, in any pose
    float largest_scale;
};
PartBounds bounds_of(const BlobData& mesh);
PartBounds bounds_of(const BakedScene& tile);

/// Finds the box around a part at its place, wider than to_local() and to_world() round. False if it leaves the world.
bool find_steps_box(const PartBounds& bounds, const Transform& transform, std::int32_t step_exponent, StepsBox& box);

/// Returns that box in float, before it is rounded to steps; of a transform that to_local() does not apply it is NaN.
Box box_around(const PartBounds& bounds, const Transform& transform);

/// The largest numbers of all instances: by how much queries widen boxes depends on them.
struct Coarseness {
    float coarsest_step;    ///< in the world
    float largest_scale;    ///< of a transform, that of a tile times the largest in it
    float farthest_origin;  ///< at least how far the translation of an instance is from its box along an axis
    void add(const PartBounds& bounds, const Transform& transform);
    /// Returns whether no number is below another one's.
    [[nodiscard]] bool includes(const Coarseness& other) const {
        return coarsest_step >= other.coarsest_step && largest_scale >= other.largest_scale &&
               farthest_origin >= other.farthest_origin;
    }
};

/// The boxes of eight instances, coordinate by coordinate.
struct EightStepsBoxes {
    static constexpr unsigned count = 8;

    alignas(32) std::int32_t low[3][count];
    alignas(32) std::int32_t negative_high[3][count];

    [[nodiscard]] StepsBox operator[](unsigned i) const {
        return {{low[0][i], low[1][i], low[2][i]}, {-negative_high[0][i], -negative_high[1][i], -negative_high[2][i]}};
    }
};

/// Eight parts, and the place of each.
struct EightPlaces {
    const PartBounds* parts[EightStepsBoxes::count];
    const Transform* transforms[EightStepsBoxes::count];
};

/// Finds the boxes of eight instances with the bits of find_steps_box(), by the best instruction set of this machine.
/// Returns false, with boxes of no meaning, if one has no box or a scale or a rotation that is far from 1: then each
/// has to be found alone.
bool find_steps_boxes_by_best_set(const EightPlaces& places, std::int32_t step_exponent, EightStepsBoxes& boxes);

}  // namespace espalier::detail
