// The triangles along a space-filling curve.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// A triangle and the place of its box's centre on the curve: 21 bits of each axis interlaced, x highest.
struct MortonEntry {
    std::uint64_t code;
    std::uint32_t triangle;
};

/// Ascending codes, of equal ones the lower triangle first ("A computer oriented geodetic data base and a new technique
/// in file sequencing", Morton 1966). Centres are integers, so that no machine rounds differently.
[[nodiscard]] std::vector<MortonEntry> morton_order(const LatticeMesh& mesh);

/// How many of the two or more entries lie before the highest bit in which their codes differ; half of them where none
/// does, which is what numbering equal codes comes to ("Maximizing parallelism in the construction of BVHs, octrees,
/// and k-d trees", Karras 2012).
[[nodiscard]] std::uint32_t morton_split(std::span<const MortonEntry> entries);

}  // namespace espalier::baker
