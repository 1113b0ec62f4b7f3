// The shape of a tree: which triangles are in which node. Every layout of the ladder is made from one.
#pragma once

#include <baker/build/binary_tree.hpp>

#include "../base.hpp"

namespace espalier::bench {

struct ShapeNode {
    std::uint32_t parent;       ///< of the root: 0
    std::uint32_t first_child;  ///< the others follow it
    std::uint32_t child_count;  ///< 0: a leaf
    std::uint32_t first;        ///< of the triangles below
    std::uint32_t count;

    [[nodiscard]] bool is_leaf() const { return child_count == 0; }
};

struct TreeShape {
    std::vector<ShapeNode> nodes;  ///< the root is the first; children come after their parents
    unsigned degree = 2;           ///< children of a node, at most
    unsigned height = 0;           ///< levels below the root

    [[nodiscard]] std::size_t inner_count() const;
};

/// Returns the shape of a binary tree that ends at leaves of `most_leaf_triangles`. Triangles are in the tree's order.
[[nodiscard]] TreeShape binary_shape(const baker::BinaryTree& tree, unsigned most_leaf_triangles);

/// Returns the shape with up to `degree` children a node that has the leaves of a binary shape. Of all such shapes
/// whose nodes are among those of the binary one, it has the least sum of the areas of inner nodes: the fewest expected
/// visits (dynamic programming of "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", Ylitie,
/// Karras, Laine 2017). `boxes` has one for each node of the binary shape.
[[nodiscard]] TreeShape widened(const TreeShape& binary, std::span<const Aabb> boxes, unsigned degree);

/// Returns the box around the triangles of each node.
[[nodiscard]] std::vector<Aabb> boxes_of(const TreeShape& shape, std::span<const TriangleVertices> triangles,
                                         std::span<const Vec3> positions);

// Layouts of a tree in memory: the nodes of OPCODE's trees ("Memory-optimized bounding-volume hierarchies", Terdiman
// 2001), and nodes that hold the boxes of 2, 4, 8 or 16 children.
//
// A walk takes any of them: root() and root_box() are where it begins, visit_children() is how it goes on.

/// Where a child is: an inner node's index, or a leaf's triangles, at most 16, in the order of the tree.
class Link {
public:
    static constexpr unsigned most_triangles = 16;
    static constexpr std::uint32_t most_first = (1u << 27) - 1;

    constexpr Link() = default;  // none
    [[nodiscard]] static constexpr Link to_node(std::uint32_t index) { return Link(index); }
    [[nodiscard]] static constexpr Link to_leaf(std::uint32_t first, std::uint32_t count) {
        return Link(leaf_bit | (count - 1) << 27 | first);
    }
    [[nodiscard]] constexpr bool is_none() const { return bits_ == none; }
    [[nodiscard]] constexpr bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    [[nodiscard]] constexpr std::uint32_t index() const { return bits_; }
    [[nodiscard]] constexpr std::uint32_t first() const { return bits_ & most_first; }
    [[nodiscard]] constexpr std::uint32_t count() const { return (bits_ >> 27 & 15) + 1; }

private:
    static constexpr std::uint32_t leaf_bit = 1u << 31, none = ~0u;
    explicit constexpr Link(std::uint32_t bits) : bits_(bits) {}
    std::uint32_t bits_ = none;
};

/// A shape with the boxes of its nodes, which are larger than their triangles by what float rounds off in tests.
struct BoxedShape {
    const TreeShape* shape;
    std::vector<Aabb> boxes;
};

/// Each node has its own box. OPCODE: AABBCollisionNode, which has a box by its center.
struct CompleteNode {
    Aabb box;
    Link link;  ///< of an inner node: to the first of two children
};
static_assert(sizeof(CompleteNode) == 28);

/// A tree with a node for each inner node and for each leaf: 2n - 1 nodes over n leaves.
struct CompleteTree {
    static constexpr unsigned degree = 2;
    explicit CompleteTree(const BoxedShape& from);

    [[nodiscard]] Link root() const { return nodes[0].link; }
    [[nodiscard]] const Aabb& root_box() const { return nodes[0].box; }
    /// Calls test_leaf(link) for leaves without a box, then test_box(link, box) for all other children.
    template <class TestLeaf, class TestBox>
    void visit_children(Link of, const TestLeaf&, const TestBox& test_box) const {
        for (std::uint32_t i = 0; i < 2; ++i) {
            const CompleteNode& child = nodes[of.index() + i];
            test_box(child.link, child.box);
        }
    }
    std::vector<CompleteNode> nodes;
};

/// A box of 16-bit coordinates on the grid of its tree, rounded outward.
struct QuantisedBox {
    std::array<std::uint16_t, 3> low, high;
};

/// The grid of quantised boxes: its step is a power of two, so that a coordinate becomes a float exactly.
struct BoxGrid {
    explicit BoxGrid(const Aabb& around);
    [[nodiscard]] QuantisedBox rounded(const Aabb& box) const;
    [[nodiscard]] Aabb box_of(const QuantisedBox& box) const {
        Aabb decoded;
        for (std::size_t k = 0; k < 3; ++k) {
            decoded.low[k] = origin[k] + step * static_cast<float>(box.low[k]);
            decoded.high[k] = origin[k] + step * static_cast<float>(box.high[k]);
        }
        return decoded;
    }
    std::array<float, 3> origin;
    float step;
};

/// OPCODE: AABBNoLeafNode, and AABBQuantizedNoLeafNode with a QuantisedBox.
template <class Box>
struct NoLeafNode {
    Box box;
    Link links[2];
};
static_assert(sizeof(NoLeafNode<Aabb>) == 32 && sizeof(NoLeafNode<QuantisedBox>) == 20);

/// A tree with nodes for inner nodes alone: n - 1 nodes over n leaves. A leaf is a link in its parent, without a box.
template <class Box>
struct NoLeafTree {
    static constexpr unsigned degree = 2;
    explicit NoLeafTree(const BoxedShape& from);

    [[nodiscard]] Link root() const { return Link::to_node(0); }
    [[nodiscard]] Aabb root_box() const { return box_of(nodes[0]); }
    template <class TestLeaf, class TestBox>
    void visit_children(Link of, const TestLeaf& test_leaf, const TestBox& test_box) const {
        const NoLeafNode<Box>& node = nodes[of.index()];
        for (const Link link : node.links)
            if (link.is_leaf()) test_leaf(link);
        for (const Link link : node.links)
            if (!link.is_leaf()) test_box(link, box_of(nodes[link.index()]));
    }
    std::vector<NoLeafNode<Box>> nodes;
    BoxGrid grid;

private:
    [[nodiscard]] Aabb box_of(const NoLeafNode<Box>& node) const;
};

template <>
inline Aabb NoLeafTree<Aabb>::box_of(const NoLeafNode<Aabb>& node) const {
    return node.box;
}
template <>
inline Aabb NoLeafTree<QuantisedBox>::box_of(const NoLeafNode<QuantisedBox>& node) const {
    return grid.box_of(node.box);
}

/// The boxes of the children, which come first; the other places have no link.
template <unsigned most_children>
struct WideNode {
    Aabb boxes[most_children];
    Link links[most_children];
};

/// A tree of inner nodes, each with the boxes of all its children ("Shallow bounding volume hierarchies for fast SIMD
/// ray tracing of incoherent rays", Dammertz, Hanika, Keller 2008).
template <unsigned most_children>
struct WideTree {
    static constexpr unsigned degree = most_children;
    explicit WideTree(const BoxedShape& from);

    [[nodiscard]] Link root() const { return Link::to_node(0); }
    [[nodiscard]] const Aabb& root_box() const { return box; }
    template <class TestLeaf, class TestBox>
    void visit_children(Link of, const TestLeaf&, const TestBox& test_box) const {
        const WideNode<degree>& node = nodes[of.index()];
        for (unsigned i = 0; i < degree && !node.links[i].is_none(); ++i) test_box(node.links[i], node.boxes[i]);
    }
    std::vector<WideNode<degree>> nodes;
    Aabb box;
};

}  // namespace espalier::bench
