// A decoder of blobs that was written from docs/format.md and espalier/format alone and shares no code with the runtime
// or the baker: slow, plain, and the tests' second opinion on what the bytes mean.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/format.hpp>
#include <espalier/types.hpp>

namespace espalier::tests {

/// In lattice steps.
using GridPoint = std::array<std::int32_t, 3>;

struct GridBox {
    GridPoint low;
    GridPoint high;
    friend bool operator==(const GridBox&, const GridBox&) = default;
};

struct GridTriangle {
    GridPoint a;
    GridPoint b;
    GridPoint c;
    friend bool operator==(const GridTriangle&, const GridTriangle&) = default;
};

struct DecodedChild {
    GridBox box;
    bool is_node = false;
    std::uint32_t node = 0;            // of a node child
    std::uint32_t first_triangle = 0;  // of a leaf
    std::uint32_t triangle_count = 0;
};

struct DecodedNode {
    unsigned depth = 0;  // the root's is 1
    std::vector<DecodedChild> children;
};

struct DecodedSource {
    std::uint32_t first = 0, file = 0, mesh = 0;
};

struct DecodedBlob {
    std::uint32_t features = 0;
    Profile profile = Profile::fast;
    unsigned bits = 0;
    int step_exponent = 0;
    std::array<float, 3> origin{};
    std::array<std::uint32_t, 3> extent{};
    float max_error = 0.0f;
    unsigned depth = 0;
    std::uint32_t triangle_count = 0, vertex_count = 0, source_triangles = 0;
    std::vector<DecodedNode> nodes;
    std::vector<GridTriangle> triangles;      // in storage order
    std::vector<DecodedSource> sources;       // empty without original ids
    std::vector<std::uint32_t> original_ids;  // one for each triangle, or none
    std::vector<std::uint8_t> first_corners;  // as many: which corner of the original triangle comes first
    std::vector<std::uint16_t> materials;     // one for each triangle, or none
    std::vector<std::uint32_t> owners;        // of each triangle: its own number, or of the one that it is a copy of
    std::vector<std::uint8_t> triangles_in_leaf;  // of each leaf, in storage order
    std::uint32_t flat_limit = 0;
    std::vector<std::array<std::uint8_t, 3>> edge_flags;  // one for each triangle, or none
    // Bounds, each empty where there are none.
    std::vector<std::int32_t> oriented_box;        // quaternion w x y z, low 3, high 3
    std::vector<std::int32_t> sphere;              // center 3, radius
    std::vector<std::int32_t> k_dop;               // low, high for each direction
    std::array<std::uint64_t, 3> source_origin{};  // bits of float64; zero where there is none
    // Of a deformable blob, else zero or empty.
    std::uint32_t position_count = 0;  // of the sources
    float rest_cost = 0.0f;
    GridBox pose{};                                            // around the vertices in this pose
    std::vector<std::array<std::uint32_t, 3>> corner_sources;  // of each triangle: the positions that its corners are
};

/// Throws std::runtime_error on bytes that do not follow the format; it checks what it needs to go on, not every rule.
DecodedBlob decode(std::span<const std::byte> bytes);

/// Every distinct corner of the triangles, in order of coordinates.
std::vector<GridPoint> distinct_corners(const DecodedBlob& decoded);

}  // namespace espalier::tests
