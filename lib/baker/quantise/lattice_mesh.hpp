// The mesh on its lattice: the contract between snapping and every later stage.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <baker/base/indexed_hash_set.hpp>
#include <baker/input/source.hpp>
#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

/// Corners are numbers into LatticeMesh::vertices, in the winding and with the first corner of the source.
struct LatticeTriangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t original_id;
};

struct LatticeMesh {
    Lattice lattice;
    std::vector<LatticePoint> vertices;             ///< distinct; a few may belong to collapsed triangles alone
    std::vector<std::uint8_t> is_used;              ///< for each vertex: whether a kept triangle has it
    std::vector<LatticeTriangle> triangles;         ///< kept ones; ascending original ids
    std::vector<SourceTriangle> collapsed;          ///< with an area in the source and none on the lattice
    std::vector<std::uint32_t> vertex_of_position;  ///< IndexedHashSet::none where no triangle with an area has it
    LatticePoint extent;                            ///< largest coordinates of the kept ones; the smallest are 0
    std::uint32_t used_vertices = 0;
    bool is_deformable = false;  ///< vertices are positions of the source: none is welded
};

[[nodiscard]] inline std::uint64_t hash_of(const LatticePoint& point) {
    const auto xy = std::uint64_t{static_cast<std::uint32_t>(point.x)} << 32 | static_cast<std::uint32_t>(point.y);
    return mix_bits(xy ^ mix_bits(static_cast<std::uint32_t>(point.z)));
}

/// Whether the three points lie on one line. Coordinates are below 2^24, so the products stay below 2^49.
[[nodiscard]] inline bool is_collapsed(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const std::int64_t bx = b.x - a.x;
    const std::int64_t by = b.y - a.y;
    const std::int64_t bz = b.z - a.z;
    const std::int64_t cx = c.x - a.x;
    const std::int64_t cy = c.y - a.y;
    const std::int64_t cz = c.z - a.z;
    return by * cz == bz * cy && bz * cx == bx * cz && bx * cy == by * cx;
}

}  // namespace espalier::baker
