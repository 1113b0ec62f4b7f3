// Where two blobs touch, for what is made of it: the pairs of triangles, each with its triangles on the common grid,
// and the way from there back to the space of the first blob and to the world.
#pragma once

#include <runtime/lattice/to_local.hpp>
#include <runtime/pairs/queries.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

/// The pairs of boxes that queries may still visit, and who counts what they do with leaves.
struct PairWork {
    std::uint64_t left;
    PairCounters* counters = nullptr;
};

/// Returns what first_contact() returns for a limit of `work.left`, and takes from it what the search has used.
PairContact find_first_contact(const PlacedBlob& a, const PlacedBlob& b, PairWork& work) noexcept;

/// Takes a pair, the references by which the walk has found it, and what places its triangles.
using OnContact = FunctionRef<Visit(const PairFrame&, const PairContact&, const TrianglePair&, PlaceTriangles)>;
using WriteContact = FunctionRef<void(std::size_t place, const PairFrame&, const PairContact&, PlaceTriangles)>;

/// Visits the pairs of for_each_contact().
QueryStatus visit_contacts(const PlacedBlob& a, const PlacedBlob& b, OnContact visit, WorkLimit limit) noexcept;

/// Writes the pairs of collect_contacts() to places below the capacity.
Filled collect_contacts(const PlacedBlob& a, const PlacedBlob& b, std::size_t capacity, WriteContact write,
                        WorkLimit limit, const Cursor& from) noexcept;

/// Places the triangles of a pair, which may be of any bits. Returns ok, invalid_argument, or a refusal of the blobs.
QueryStatus place_triangles(const PlacedBlob& a, const PlacedBlob& b, const PairContact& pair, PairFrame& frame,
                            LatticeTriangle& of_a, LatticeTriangle& of_b) noexcept;

/// Returns a place of the grid in a's space.
inline Vec3 point_in_units(const PairFrame& frame, const Vec3& place) {
    return to_local(*frame.a, scale_by_power_of_two(place.x, frame.shift), scale_by_power_of_two(place.y, frame.shift),
                    scale_by_power_of_two(place.z, frame.shift));
}

/// Converts a distance of the world into a's units, or back. One that is not zero does not become zero.
inline float converted(float distance, float scale, bool into_world) {
    if (scale == 1.0f || magnitude_bits(distance) == 0) return distance;
    const float result = into_world ? distance * scale : distance / scale;
    return result >= least_coordinate ? result : least_coordinate;
}

/// Returns a length in steps of the grid in the world, where a has that scale.
inline float length_in_world(const PairFrame& frame, float steps, float scale) {
    return converted(scale_by_power_of_two(steps, frame.shift + frame.a->step_exponent), scale, true);
}

}  // namespace espalier::detail
