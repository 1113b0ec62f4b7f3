// The nodes of a blob's bytes, of either kind, to read and to break.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/format.hpp>

#include "edits.hpp"

namespace espalier::tests {

inline Profile profile_of(const std::vector<std::byte>& bytes) {
    return static_cast<Profile>(get(bytes, format::header::profile_at, 1));
}

/// Where node `number` begins.
inline std::size_t node_of(const std::vector<std::byte>& bytes, std::size_t number) {
    return format::header::bytes + number * format::node_bytes(profile_of(bytes));
}

/// Where the leaves begin.
inline std::size_t leaves_of(const std::vector<std::byte>& bytes) {
    return node_of(bytes, get(bytes, format::header::node_count_at, 4));
}

/// Where the fields of a node are.
struct NodeLayout {
    std::size_t children_at, leaf_block_at, lo_at, hi_at;
    std::size_t row_bytes, plane_bytes;
    unsigned max_children;
    std::size_t bytes;
};

inline NodeLayout layout_of(Profile profile) {
    using namespace format;
    if (profile == Profile::fast)
        return {plain_node::children_at,  plain_node::leaf_block_at, plain_node::lo_at,
                plain_node::hi_at,        plain_node::row_bytes,     2,
                plain_node::max_children, plain_node::bytes};
    return {packed_node::children_at,  packed_node::leaf_block_at, packed_node::lo_at,
            packed_node::hi_at,        packed_node::row_bytes,     1,
            packed_node::max_children, packed_node::bytes};
}

struct NodeCounts {
    std::uint64_t first_child = 0, nodes = 0, leaves = 0;
};

/// Of the node that begins at `at`.
inline NodeCounts counts_of(const std::vector<std::byte>& bytes, std::size_t at) {
    const std::uint64_t children = get(bytes, at + layout_of(profile_of(bytes)).children_at, 4);
    if (profile_of(bytes) != Profile::fast) return {children & 0xFFFFFFu, children >> 24 & 15u, children >> 28};
    return {children & 0xFFFFFFu, children >> 24, get(bytes, at + format::plain_node::leaf_children_at, 1)};
}

inline void put_counts(std::vector<std::byte>& bytes, std::size_t at, const NodeCounts& counts) {
    const std::size_t children_at = at + layout_of(profile_of(bytes)).children_at;
    if (profile_of(bytes) != Profile::fast) {
        put(bytes, children_at, counts.first_child | counts.nodes << 24 | counts.leaves << 28, 4);
    } else {
        put(bytes, children_at, counts.first_child | counts.nodes << 24, 4);
        put(bytes, at + format::plain_node::leaf_children_at, counts.leaves, 1);
    }
}

/// Where the block of the node's leaves begins.
inline std::size_t leaf_block_of(const std::vector<std::byte>& bytes, std::size_t at) {
    return leaves_of(bytes) + 4 * get(bytes, at + layout_of(profile_of(bytes)).leaf_block_at, 4);
}

/// Where the descriptor of leaf `number` of the node is, and its bytes.
inline std::size_t descriptor_of(const std::vector<std::byte>& bytes, std::size_t at, std::size_t number) {
    if (profile_of(bytes) == Profile::fast)
        return at + format::plain_node::leaves_at + format::plain_leaf::descriptor_bytes * number;
    const std::size_t each = profile_of(bytes) == Profile::tiny ? format::predicted_strip::descriptor_bytes
                                                                : format::strip_leaf::descriptor_bytes;
    return leaf_block_of(bytes, at) + format::strip_leaf::descriptors_at + each * number;
}
inline unsigned descriptor_bytes_of(const std::vector<std::byte>& bytes) {
    return static_cast<unsigned>(descriptor_of(bytes, 0, 1) - descriptor_of(bytes, 0, 0));
}

/// Where the data of leaf `number` of the node begins.
inline std::size_t leaf_data_of(const std::vector<std::byte>& bytes, std::size_t at, std::size_t number) {
    const std::uint64_t descriptor = get(bytes, descriptor_of(bytes, at, number), descriptor_bytes_of(bytes));
    if (profile_of(bytes) == Profile::fast)
        return leaf_block_of(bytes, at) + 4 * (descriptor & ((1u << format::plain_leaf::offset_bits) - 1u));
    const std::size_t data = descriptor_of(bytes, at, counts_of(bytes, at).leaves);
    if (profile_of(bytes) == Profile::tiny) {
        std::size_t before = 0;
        for (std::size_t i = 0; i < number; ++i) before += get(bytes, descriptor_of(bytes, at, i), 2) & 1023;
        return data + before;
    }
    return data + (descriptor & ((1u << format::strip_leaf::offset_bits) - 1u));
}

/// Makes a node unsound in one place: a plane above the box of its first child.
inline void break_node(std::vector<std::byte>& bytes, std::size_t at) {
    const NodeLayout layout = layout_of(profile_of(bytes));
    put(bytes, at + layout.lo_at, (std::uint64_t{1} << 8 * layout.plane_bytes) - 1,
        static_cast<unsigned>(layout.plane_bytes));
    put(bytes, at + layout.hi_at, 0, static_cast<unsigned>(layout.plane_bytes));
}

}  // namespace espalier::tests
