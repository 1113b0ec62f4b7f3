// A shape rounded into lattice units, as the walk through the tree uses it: bounds and planes that enclose it, and a
// kernel. One walk serves all shapes.
#pragma once

#include <array>
#include <cstdint>

#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/lattice/triangle.hpp>
#include <runtime/traversal/box_nodes.hpp>

namespace espalier::detail {

/// What all rounded shapes share. It refers to its own members: rounded where it stays.
struct Volume {
    using Kernel = bool (*)(const Volume& volume, const LatticeTriangle& triangle);

    explicit Volume(Kernel of_shape) : kernel(of_shape) {}
    Volume(const Volume&) = delete;
    Volume& operator=(const Volume&) = delete;

    Kernel kernel;                   ///< whether shape and triangle share a point, exactly
    LatticePlane* planes = nullptr;  ///< the shape lies behind each of them
    unsigned plane_count = 0;
    bool planes_cull = true;    ///< whether they are compared with nodes, too
    bool bounded = true;        ///< the shape lies within the bounds; only then are these set
    bool is_enclosure = false;  ///< bounds and planes are the shape itself: a vertex within them is inside of it
    IntegerBounds bounds;

    void add_plane(const LatticePlane& plane) { planes[plane_count++] = plane; }
    /// Sets the bounds along an axis: what lies from low to high, in units of 2^-fraction_bits steps.
    void set_bounds(int axis, std::int64_t low, std::int64_t high, int fraction_bits) {
        bounds.low[axis] = clamp_to_bounds(-(-low >> fraction_bits));
        bounds.high[axis] = clamp_to_bounds(high >> fraction_bits);
    }
};

/// A shape of the caller, rounded: round_volume() fills it in, and meets() is its kernel. round_volume() returns
/// not_found if the shape overlaps nothing, whatever the triangles.
template <class Shape>
struct Rounded;

/// The base of a rounded shape, with room for its planes.
template <class Shape, std::size_t most_planes>
struct VolumeOf : Volume {
    VolumeOf()
        : Volume([](const Volume& volume, const LatticeTriangle& triangle) {
              return meets(static_cast<const Rounded<Shape>&>(volume), triangle);
          }) {
        planes = room.data();
    }
    std::array<LatticePlane, most_planes> room;
};

/// Finds the triangles that the shape overlaps, in storage order. True when the answer stopped it.
bool find_overlaps_of_volume(const BlobData& blob, const Volume& volume, Each& answer, const WalkAccuracy& accuracy);

}  // namespace espalier::detail
