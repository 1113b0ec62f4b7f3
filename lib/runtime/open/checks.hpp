// What the parts of open() share, also with those of scenes: the beginning of the header, the pass over the nodes that
// proves them a tree, and what it has seen so far.
#pragma once

#include <runtime/blob/deformable_blob.hpp>
#include <runtime/blob/node.hpp>

namespace espalier::detail {

// The header. Nothing else is trusted, and nothing outside the bytes is read.

/// What the first fields of a file of this library must be.
struct FileKind {
    std::uint32_t magic;
    std::uint16_t version_major;
    std::uint16_t version_minor;
    OpenStatus refusal;  ///< of bytes with another magic
};
inline constexpr FileKind blob_file = {format::magic, format::version_major, format::version_minor,
                                       OpenStatus::not_a_blob};

/// Reads the fields that give the others a meaning: magic, version, size. The checksum is read and not compared.
OpenStatus read_version_and_size(const std::byte* bytes, std::size_t size, BlobData& blob,
                                 const FileKind& kind = blob_file);
/// Reads the step, the origin, the extent and the largest error, which scenes have at the same places. Requires the
/// bits; returns whether all are within their ranges.
bool read_lattice(BlobData& blob);
/// Reads the rest of the header, checks each rule of it, and locates the sections.
OpenStatus read_header(BlobData& blob);
/// Sets the pointers to the sections, which together are the blob. Of their contents it reads only the number of copies
/// and, if `looks_at_padding`, the zero bits that sections end with.
OpenStatus locate_sections(BlobData& blob, bool looks_at_padding);

/// Makes the blob empty and stores why. Out of line, so that small cores have the code once.
ESPALIER_NOINLINE void refuse(BlobData& blob, OpenStatus status);

// The nodes and their leaves.

ESPALIER_SHARED_CODE inline bool is_zero(const std::byte* bytes, std::size_t count) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum |= load_u8(bytes + i);
    return sum == 0;
}

/// The unused high bits of the last byte of a stream.
inline bool is_padded_with_zeros(const std::byte* stream, unsigned bit_count) {
    return bit_count % 8 == 0 || load_u8(stream + bit_count / 8) >> (bit_count % 8) == 0;
}

/// How far the pass over the nodes has come.
struct OpenProgress {
    const BlobData& blob;
    PoseBounds bounds = pose_bounds_of(blob);  ///< in which every vertex must be
    std::uint32_t triangles = 0;
    std::uint32_t leaf_bytes = 0;    ///< at most those of the section
    std::uint32_t vertex_slots = 0;  ///< of plain leaves
};

/// The leaves of a node: inside the section, every vertex inside the asset, every corner a vertex.
bool take_leaves(PackedNode node, OpenProgress& seen);
bool take_leaves(PlainNode node, OpenProgress& seen);

/// A box for each child. There is at least one, and there are no more than a node holds.
[[maybe_unused]] inline bool has_sound_boxes(const PackedNode& node, unsigned children, const BlobData&) {
    using namespace format::packed_node;
    if (load_u16(node.bytes + shifts_at) >> 15 != 0) return false;
    for (unsigned shifts = load_u16(node.bytes + shifts_at); shifts != 0; shifts >>= 5)
        if ((shifts & 31u) > max_shift) return false;
    for (unsigned plane = 0; plane < 3 * max_children; ++plane) {
        const std::uint32_t low = load_u8(node.bytes + lo_at + plane);
        const std::uint32_t high = load_u8(node.bytes + hi_at + plane);
        if (low > high || (plane % max_children >= children && high != 0)) return false;
    }
    return true;
}
[[maybe_unused]] inline bool has_sound_boxes(const PlainNode& node, unsigned children, const BlobData& blob) {
    using namespace format::plain_node;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t most = static_cast<std::uint32_t>(blob.extent[k]) >> format::unit_shift(blob.bits);
        for (unsigned child = 0; child < max_children; ++child) {
            const std::uint32_t low = load_u16(node.low_planes(k) + 2 * std::size_t{child});
            const std::uint32_t high = load_u16(node.high_planes(k) + 2 * std::size_t{child});
            if (low > high || high > (child < children ? most : 0)) return false;
        }
    }
    return is_zero(node.bytes + reserved_at, bytes - reserved_at);
}

/// Visits every node exactly once, children after their parents, in depth-first order with a stack as deep as the
/// format allows. `blocks.next()` returns where the leaves of the next node that has any must begin;
/// `blocks.take(node)` checks them, and returns ok or a reason.
template <class Node, class Blocks>
OpenStatus check_tree(const BlobData& blob, Blocks& blocks) {
    struct Siblings {
        std::uint32_t next;
        std::uint32_t end;
    };
    Siblings stack[format::max_depth + 1];
    std::uint32_t seen_nodes = 1;  // the root, then every block of siblings when their parent is reached
    unsigned seen_depth = 0;
    unsigned depth = 1;
    stack[1 - 1] = {0, 1};
    while (depth != 0) {
        Siblings& siblings = stack[depth - 1];
        if (siblings.next == siblings.end) {
            --depth;
            continue;
        }
        if (depth > blob.depth) return OpenStatus::bad_node;
        // mutant(> -> >=) equivalent: both sides are equal then
        seen_depth = depth > seen_depth ? depth : seen_depth;
        const auto node = node_at<Node>(blob, siblings.next++);
        const unsigned nodes = node.node_children();
        const unsigned leaves = node.leaf_children();
        const unsigned children = nodes + leaves;
        if (children == 0 || children > Node::max_children || !has_sound_boxes(node, children, blob) ||
            node.first_child() != (nodes == 0 ? 0 : seen_nodes) || nodes > blob.node_count - seen_nodes ||
            node.leaf_block_place() != (leaves == 0 ? 0 : blocks.next()))
            return OpenStatus::bad_node;
        if (const OpenStatus status = blocks.take(node); status != OpenStatus::ok) return status;
        stack[depth++] = {seen_nodes, seen_nodes + nodes};
        seen_nodes += nodes;
    }
    return seen_nodes == blob.node_count && seen_depth == blob.depth ? OpenStatus::ok : OpenStatus::bad_node;
}

}  // namespace espalier::detail
