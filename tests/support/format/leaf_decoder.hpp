// The triangles of a leaf, decoded without code of the library.
#pragma once

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

struct PredictedLeaf {
    std::vector<GridTriangle> triangles;
    std::size_t bytes = 0;
};

std::vector<GridTriangle> read_plain_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits);

std::vector<GridTriangle> read_strip_leaf(const Bytes& bytes, const Leaf& leaf, unsigned bits);

/// A strip whose vertices are predicted: section 5.5.
PredictedLeaf read_predicted_strip(const Bytes& bytes, const Leaf& leaf, unsigned bits);

}  // namespace espalier::tests::decoding
