// The pairs of triangles of two blobs that touch, each with its triangles on the common grid: for what is made of them.
#pragma once

#include <cstddef>

#include <espalier/pair.hpp>
#include <runtime/pairs/queries.hpp>

namespace espalier::detail {

/// Takes a pair, and what places its triangles.
using OnContact = FunctionRef<Visit(const PairFrame&, const PairContact&, PlaceTriangles)>;
using WriteContact = FunctionRef<void(std::size_t place, const PairFrame&, const PairContact&, PlaceTriangles)>;

/// Visits the pairs of for_each_contact().
QueryStatus visit_contacts(const PlacedBlob& a, const PlacedBlob& b, OnContact visit, WorkLimit limit) noexcept;

/// Writes the pairs of collect_contacts() to places below the capacity.
Filled collect_contacts(const PlacedBlob& a, const PlacedBlob& b, std::size_t capacity, WriteContact write,
                        WorkLimit limit, const Cursor& from) noexcept;

/// Places the triangles of a pair, which may be of any bits. Returns ok, invalid_argument, or a refusal of the blobs.
QueryStatus place_triangles(const PlacedBlob& a, const PlacedBlob& b, const PairContact& pair, PairFrame& frame,
                            LatticeTriangle& of_a, LatticeTriangle& of_b) noexcept;

}  // namespace espalier::detail
