#include <bit>

#include <runtime/find_triangle.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier::detail {
namespace {

namespace scalar_find {
#include <runtime/traverse.inl>
}  // namespace scalar_find

/// Storage indices ascend in the order of the walk (open proves it), a node's own leaves before what is below its node
/// children: so each subtree is a run of indices, and one child of each node holds the one that is looked for.
struct Finder {
    const BlobData& blob;
    std::uint32_t index;
    LatticeTriangle found;

    [[nodiscard]] std::uint32_t first_below(std::uint32_t number) const {
        Node node = node_at(blob, number);
        while (node.leaf_children() == 0) node = node_at(blob, node.first_child());
        return load_u32(node.leaf_block(blob));
    }
    [[nodiscard]] unsigned children(const Node& node, float*) const {
        const unsigned nodes = node.node_children();
        for (unsigned child = nodes; child != 0; --child)
            if (first_below(node.first_child() + child - 1) <= index) return 1u << (child - 1);
        return ((1u << node.leaf_children()) - 1u) << nodes;
    }
    template <class Leaf>
    Visit visit_leaf(const Leaf& leaf) {
        if (index - scalar::storage_index(leaf, 0) >= leaf.triangle_count()) return keep_going;
        auto slots = leaf.used_slots();
        for (std::uint32_t skip = index - scalar::storage_index(leaf, 0); skip != 0; --skip) slots &= slots - 1;
        found = leaf.triangle(static_cast<unsigned>(std::countr_zero(slots)));
        return stop;
    }
};

}  // namespace

LatticeTriangle find_triangle(const BlobData& blob, std::uint32_t index) {
    Finder finder = {blob, index, {}};
    scalar_find::with_leaves_of(
        blob, [&]<class Leaf>() { return scalar_find::traverse_in_storage_order<Leaf>(blob, finder); });
    return finder.found;
}

}  // namespace espalier::detail
