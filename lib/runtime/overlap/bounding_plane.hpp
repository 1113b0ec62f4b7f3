// A plane that bounds a shape, from a normal whose coordinates take more than 64 bits.
#pragma once

#include <cstdint>

#include <runtime/lattice/triangle.hpp>
#include <runtime/traversal/box_nodes.hpp>

namespace espalier::detail {

/// Room for a plane that bounds a shape and the points that say where: for all points X of the shape,
/// dot(normal, X - at) <= reach, in units of 2^-fraction_bits, and |X - at| <= size, summed over the axes.
struct Support {
    WideVector normal;
    Integer3 at;
    Int128 reach;
    std::int64_t size;
};

/// The plane with its normal cut down to 23 bits, moved outward by as much as that may turn it.
LatticePlane bounding_plane(const Support& support, int fraction_bits) noexcept;

}  // namespace espalier::detail
