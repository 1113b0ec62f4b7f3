// The rules for every node and every leaf of a blob, of any origin.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <espalier/base/function_ref.hpp>

#include <baker/verify/decode_tree.hpp>

namespace espalier::baker {

struct TreeCounts {
    std::uint64_t nodes = 0;
    std::uint64_t triangles = 0;
    std::uint64_t leaf_bytes = 0;
    unsigned depth = 0;
};

/// A complaint about one leaf, or none. `region` is what its own box and those of all nodes above it have in common: a
/// query that looks for something in there comes to the leaf.
using LeafCheck = FunctionRef<std::optional<std::string>(const DecodedLeaf& leaf, const DecodedBox& region)>;

/// Walks the tree in the order of the format and calls `check_leaf` in storage order. Every child box must hold all
/// vertices below it (not where parts of triangles lie in several leaves: there `check_leaf` must see to it) and end
/// near the asset, every reference must be the running counter's, and at the end everything must have been given out.
/// Answers with the first thing that does not hold, naming node and byte offset in the blob, or with nothing.
[[nodiscard]] std::optional<std::string> check_tree(const TreeBytes& tree, LeafCheck check_leaf, TreeCounts& counts);

}  // namespace espalier::baker
