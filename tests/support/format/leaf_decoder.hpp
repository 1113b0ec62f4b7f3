// The triangles of a leaf, decoded without code of the library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bytes_reader.hpp"
#include "decoder.hpp"

namespace espalier::tests::decoding {

/// One leaf, whose data begin at `at`, and its box in its node.
struct Leaf {
    std::uint32_t descriptor;
    std::size_t at;
    GridBox box;
};

/// The section of corners of a deformable blob. The leaves of other blobs have their own corners.
struct CornerRows {
    std::size_t at;
    std::size_t end;
};

/// The triangles of a plain leaf, and the vertex numbers of their corners.
struct PlainLeafContent {
    unsigned vertex_count = 0;
    std::vector<GridTriangle> triangles;
    std::vector<std::array<std::uint32_t, 3>> corners;
};

struct PredictedLeaf {
    std::vector<GridTriangle> triangles;
    std::size_t bytes = 0;
};

PlainLeafContent read_plain_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits, const CornerRows* corner_rows);

std::vector<GridTriangle> read_strip_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits);

/// A strip whose vertices are predicted: section 5.5.
PredictedLeaf read_predicted_strip(const Bytes& bytes, const Leaf& leaf, unsigned bits);

}  // namespace espalier::tests::decoding
