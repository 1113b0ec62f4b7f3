#include "encode_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include <espalier/format.hpp>

#include "byte_writer.hpp"

namespace espalier::baker {

namespace {

using format::node::max_shift;

struct Box {
    std::array<std::int32_t, 3> lo;
    std::array<std::int32_t, 3> hi;
};

Box box_of(const BinaryNode& node) {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lo[axis] = static_cast<std::int32_t>(node.lo[axis]);
        box.hi[axis] = static_cast<std::int32_t>(node.hi[axis]);
    }
    return box;
}

/// The lattice of 8-bit planes on one axis of a node.
struct Frame {
    std::int32_t base;
    unsigned shift;

    [[nodiscard]] std::uint32_t plane_below(std::int32_t coordinate) const {
        return static_cast<std::uint32_t>(coordinate - base) >> shift;
    }
    [[nodiscard]] std::uint32_t plane_above(std::int32_t coordinate) const {
        const auto round_up = (1u << shift) - 1;
        return (static_cast<std::uint32_t>(coordinate - base) + round_up) >> shift;
    }
    [[nodiscard]] std::int32_t coordinate(std::uint32_t plane) const {
        return base + static_cast<std::int32_t>(plane << shift);
    }
};

/// The finest frame in whose 256 planes everything from `lo` to `hi` fits.
Frame frame_for(std::int32_t lo, std::int32_t hi, unsigned base_unit) {
    Frame frame{lo >> base_unit << base_unit, 0};
    while (frame.shift < max_shift && frame.plane_above(hi) > 255) ++frame.shift;
    return frame;
}

/// The least code whose width holds `largest`.
unsigned width_code(std::uint32_t largest, unsigned bits) {
    unsigned code = 0;
    while (largest >> format::indexed_leaf::coordinate_width(code, bits) != 0) ++code;
    return code;
}

class TreeEncoder {
public:
    TreeEncoder(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide, EncodedTree& encoded)
        : mesh_(mesh), tree_(tree), wide_(wide), encoded_(encoded), bits_(mesh.lattice.bits) {}

    void encode(std::uint32_t number) {
        const WideNode& node = wide_.nodes[number];
        const unsigned count = unsigned{node.node_children} + node.leaves;
        std::array<Box, format::max_children> boxes;
        for (std::size_t i = 0; i < count; ++i) boxes[i] = box_of(tree_.nodes[node.binary_nodes[i]]);

        std::byte* bytes = encoded_.nodes.data() + std::size_t{number} * format::node::bytes;
        std::array<Frame, 3> frames;
        std::uint32_t shifts = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            frames[axis] = put_axis(std::span(boxes).first(count), axis, bytes);
            shifts |= frames[axis].shift << (5 * axis);
        }
        set_u16(bytes + format::node::shifts_at, shifts);
        set_u32(bytes + format::node::children_at,
                node.first_child | std::uint32_t{node.node_children} << 24 | std::uint32_t{node.leaves} << 28);
        if (node.leaves != 0) {
            set_u32(bytes + format::node::leaf_block_at, static_cast<std::uint32_t>(encoded_.leaves.size() / 4));
            put_leaf_block(node, std::span(boxes).subspan(node.node_children, node.leaves), frames);
        }
        for (std::uint32_t i = 0; i < node.node_children; ++i) encode(node.first_child + i);
    }

private:
    Frame put_axis(std::span<const Box> boxes, std::size_t axis, std::byte* bytes) const {
        std::int32_t lo = boxes.front().lo[axis];
        std::int32_t hi = boxes.front().hi[axis];
        for (const Box& box : boxes) {
            lo = std::min(lo, box.lo[axis]);
            hi = std::max(hi, box.hi[axis]);
        }
        const unsigned base_unit = bits_ > 16 ? bits_ - 16 : 0;
        const Frame frame = frame_for(lo, hi, base_unit);
        set_u16(bytes + format::node::base_at + 2 * axis, static_cast<std::uint32_t>(frame.base) >> base_unit);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const std::size_t at = format::max_children * axis + i;
            set_u8(bytes + format::node::lo_at + at, frame.plane_below(boxes[i].lo[axis]));
            set_u8(bytes + format::node::hi_at + at, frame.plane_above(boxes[i].hi[axis]));
        }
        return frame;
    }

    void put_leaf_block(const WideNode& node, std::span<const Box> boxes, const std::array<Frame, 3>& frames) {
        using namespace format::indexed_leaf;
        auto& bytes = encoded_.leaves;
        const std::size_t block = bytes.size();
        put_u32(bytes, wide_.leaves[node.first_leaf].first);
        bytes.resize(bytes.size() + descriptor_bytes * node.leaves);
        const std::size_t data = bytes.size();
        for (std::size_t i = 0; i < node.leaves; ++i) {
            pad_to(bytes, 2);
            const auto offset = static_cast<std::uint32_t>((bytes.size() - data) / 2);
            std::array<std::int32_t, 3> anchor;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                anchor[axis] = frames[axis].coordinate(frames[axis].plane_below(boxes[i].lo[axis]));
            }
            const std::uint32_t descriptor = offset | put_leaf(wide_.leaves[node.first_leaf + i], boxes[i], anchor);
            set_u32(bytes.data() + block + descriptors_at + descriptor_bytes * i, descriptor);
        }
        pad_to(bytes, 4);
    }

    /// Appends the leaf's streams; returns its descriptor without the offset.
    std::uint32_t put_leaf(const Leaf& leaf, const Box& box, const std::array<std::int32_t, 3>& anchor) {
        using namespace format::indexed_leaf;
        number_vertices(leaf);
        std::uint32_t descriptor = (leaf.count - 1) << triangles_shift | (vertex_count_ - 1) << vertices_shift;
        BitStream stream(encoded_.leaves);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            // The leaf's vertices reach its box's high side, so that alone decides the width.
            const unsigned code = width_code(static_cast<std::uint32_t>(box.hi[axis] - anchor[axis]), bits_);
            descriptor |= code << (widths_shift + 4 * axis);
            const unsigned width = coordinate_width(code, bits_);
            for (unsigned i = 0; i < vertex_count_; ++i) {
                const LatticePoint& point = mesh_.vertices[vertices_[i]];
                const std::int32_t coordinate = axis == 0 ? point.x : axis == 1 ? point.y : point.z;
                stream.put(static_cast<std::uint32_t>(coordinate - anchor[axis]), width);
            }
            stream.finish();
        }
        const unsigned width = corner_width(vertex_count_);
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const auto [a, b, c] = corners_[i];
            stream.put(std::uint32_t{a} | std::uint32_t{b} << width | std::uint32_t{c} << (2 * width), 3 * width);
        }
        stream.finish();
        return descriptor;
    }

    /// Numbers the leaf's vertices by first use.
    void number_vertices(const Leaf& leaf) {
        vertex_count_ = 0;
        for (std::uint32_t i = 0; i < leaf.count; ++i) {
            const auto& triangle = mesh_.triangles[wide_.triangles[leaf.first + i]];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = triangle.corners[corner];
                const auto end = vertices_.begin() + vertex_count_;
                const auto found = std::find(vertices_.begin(), end, vertex);
                corners_[i][corner] = static_cast<std::uint8_t>(found - vertices_.begin());
                if (found == end) vertices_[vertex_count_++] = vertex;
            }
        }
    }

    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    const WideTree& wide_;
    EncodedTree& encoded_;
    unsigned bits_;
    unsigned vertex_count_ = 0;  // of the leaf at hand, as the next two
    std::array<std::uint32_t, format::max_leaf_vertices> vertices_{};
    std::array<std::array<std::uint8_t, 3>, format::max_leaf_triangles> corners_{};
};

}  // namespace

EncodedTree encode_tree(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide) {
    EncodedTree encoded;
    if (wide.nodes.empty()) return encoded;
    encoded.nodes.resize(wide.nodes.size() * format::node::bytes);
    encoded.leaves.reserve(wide.triangles.size() * 7);
    TreeEncoder(mesh, tree, wide, encoded).encode(0);
    return encoded;
}

}  // namespace espalier::baker
