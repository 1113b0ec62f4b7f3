// A shape rounded into lattice units, as the walk through the tree uses it: bounds and planes that enclose it, and a
// kernel. One walk serves all shapes.
#pragma once

#include <cstdint>

#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/lattice/triangle.hpp>
#include <runtime/traversal/box_nodes.hpp>
#include <runtime/traversal/plane_nodes.hpp>

namespace espalier::detail {

/// The base of each rounded shape. It refers to its own members: rounded where it stays.
struct Volume {
    Volume() = default;
    Volume(const Volume&) = delete;
    Volume& operator=(const Volume&) = delete;

    bool (*meets)(const Volume& volume, const LatticeTriangle& triangle) = nullptr;
    const LatticePlane* planes = nullptr;  ///< the shape lies behind each of them
    unsigned plane_count = 0;
    bool bounded = true;   ///< the shape lies within the bounds; only then are these set
    bool is_empty = true;  ///< nothing overlaps it
    /// A vertex within the bounds and this deep behind each plane is inside the shape: 0 when bounds and planes are the
    /// shape itself, unknown when what encloses it does not bound its inside.
    std::int64_t depth_inside = unknown;
    static constexpr std::int64_t unknown = -1;
    IntegerBounds bounds;
};

/// The triangles that the shape overlaps, in storage order. True when the answer stopped it.
bool find_overlaps(const BlobData& blob, const Volume& volume, Each& answer, const WalkAccuracy& accuracy);

/// Rounds a shape and finds what it overlaps: find_overlaps_of() of most shapes. Stopped when the answer stopped it.
template <class Rounded, class Shape>
QueryStatus round_and_find(const BlobData& blob, const Shape& shape, Each& answer, const WalkAccuracy& accuracy) {
    Rounded volume;
    const QueryStatus status = round_volume(blob, shape, volume);
    if (status != QueryStatus::ok || blob.triangle_count == 0 || volume.is_empty) return status;
    return find_overlaps(blob, volume, answer, accuracy) ? QueryStatus::stopped : QueryStatus::ok;
}

}  // namespace espalier::detail
