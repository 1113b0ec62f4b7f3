#include <baker/encode/tree.hpp>

#include <algorithm>
#include <array>
#include <span>

#include <espalier/format.hpp>

#include <baker/encode/node.hpp>

namespace espalier::baker {

namespace {

ChildBox box_of(const BinaryNode& node) {
    ChildBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.lo[axis] = static_cast<std::int32_t>(node.lo[axis]);
        box.hi[axis] = static_cast<std::int32_t>(node.hi[axis]);
    }
    return box;
}

class TreeEncoder {
public:
    TreeEncoder(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide, Profile profile)
        : mesh_(mesh), tree_(tree), wide_(wide), profile_(profile) {
        encoded.nodes.resize(wide.nodes.size() * format::node_bytes(profile));
        encoded.leaves.reserve(wide.triangles.size() * 7);
    }

    /// The recursion goes no deeper than format::max_depth.
    void encode(std::uint32_t number) {
        const WideNode& node = wide_.nodes[number];
        const unsigned count = unsigned{node.node_children} + node.leaves;
        std::array<ChildBox, format::max_children> boxes;
        std::transform(node.binary_nodes.begin(), node.binary_nodes.begin() + count, boxes.begin(),
                       [&](std::uint32_t binary) { return box_of(tree_.nodes[binary]); });

        const NodeToWrite from{mesh_, wide_, node, profile_, std::span(boxes).first(count)};
        std::byte* const bytes = encoded.nodes.data() + number * format::node_bytes(profile_);
        if (format::has_plain_nodes(profile_)) {
            put_plain_node(from, bytes, encoded.leaves);
        } else {
            put_packed_node(from, bytes, encoded.leaves);
        }
        for (std::uint32_t i = 0; i < node.node_children; ++i) encode(node.first_child + i);
    }

    EncodedTree encoded;

private:
    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    const WideTree& wide_;
    Profile profile_;
};

}  // namespace

EncodedTree encode_tree(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide, Profile profile) {
    if (wide.nodes.empty()) return {};
    TreeEncoder encoder(mesh, tree, wide, profile);
    encoder.encode(0);
    return std::move(encoder.encoded);
}

}  // namespace espalier::baker
