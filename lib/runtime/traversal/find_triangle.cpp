// From a storage index to the triangle, and whether a query reaches no reference to a triangle before one.
#include <bit>

#include <espalier/base/function_ref.hpp>
#include <runtime/answers/first_reference.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/traversal/find_triangle.hpp>
#include <runtime/traversal/find.hpp>
#include <runtime/traversal/small_boxes.hpp>

namespace espalier::detail {
namespace {

/// One more than the node child that holds the index; 0 if an own leaf of the node does.
template <class Leaf>
unsigned node_child_above(const BlobData& blob, const typename Leaf::Node& node, std::uint32_t index) {
    unsigned child = node.node_children();
    while (child != 0 && first_below<Leaf>(blob, node.first_child() + child - 1) > index) --child;
    return child;
}

template <class Leaf>
LatticeTriangle triangle_in(const Leaf& leaf, std::uint32_t skip) {
    auto slots = leaf.used_slots();
    for (; skip != 0; --skip) slots &= slots - 1;
    return leaf.triangle(static_cast<unsigned>(std::countr_zero(slots)));
}

}  // namespace

IntegerBounds bounds_of(const LatticeTriangle& triangle) {
    IntegerBounds bounds;
    for (int k = 0; k < 3; ++k) {
        const Span span = span_of(triangle, k);
        bounds.low[k] = span.low;
        bounds.high[k] = span.high;
    }
    return bounds;
}

LatticeTriangle find_triangle(const BlobData& blob, std::uint32_t index) {
    return scalar::with_leaves_of(blob, [&]<class Leaf>() {
        using Node = typename Leaf::Node;
        Node node = node_at<Node>(blob, 0);
        for (;;) {
            count_node_step();
            const unsigned child = node_child_above<Leaf>(blob, node, index);
            if (child == 0) break;
            node = node_at<Node>(blob, node.first_child() + child - 1);
        }
        for (unsigned number = 0;; ++number) {
            count_leaf_step();
            LatticeTriangle triangle;
            const bool is_found = scalar::with_leaf<Leaf>(blob, node, number, [&](const Leaf& leaf) {
                const std::uint32_t skip = index - scalar::storage_index(leaf, 0);
                if (skip >= leaf.triangle_count()) return false;
                triangle = triangle_in(leaf, skip);
                return true;
            });
            if (is_found) return triangle;
        }
    });
}

unsigned child_holding(const BlobData& blob, std::uint32_t node_index, std::uint32_t index) {
    return scalar::with_leaves_of(blob, [&]<class Leaf>() {
        count_node_step();
        const auto node = node_at<typename Leaf::Node>(blob, node_index);
        if (const unsigned above = node_child_above<Leaf>(blob, node, index); above != 0) return above - 1;
        const auto holds = [&](const Leaf& leaf) {
            count_leaf_step();
            return index - scalar::storage_index(leaf, 0) < leaf.triangle_count();
        };
        unsigned number = 0;
        while (!scalar::with_leaf<Leaf>(blob, node, number, holds)) ++number;
        return node.node_children() + number;
    });
}

Triangle corners_at(const BlobData& blob, std::uint32_t index, const LatticeTriangle* triangle) noexcept {
    return triangle != nullptr ? corners_of(blob, *triangle) : corners_of(blob, find_triangle(blob, index));
}

namespace {

/// Looks for a reference to one triangle in storage order.
struct FirstReference {
    const BlobData& blob;
    ReachedChildren reached;
    std::uint32_t owner;   ///< its lowest reference
    IntegerBounds bounds;  ///< of its corners
    std::uint32_t found = no_triangle.index;

    unsigned children(const PlainNode& node, float*) const {
        unsigned mask = children_within(node, blob.bits, bounds);
        // Subtrees are runs of indices: those that end before the owner need no visit.
        for (unsigned child = node.node_children(); child-- > 1;) {
            // mutant(> -> >=) work: visits subtrees that end before the owner, which hold no reference to it
            if (first_below<PlainLeaf>(blob, node.first_child() + child) > owner) continue;
            // mutant(<< -> one less, &= everything) work: visits subtrees that end before the owner, which hold no
            // reference to it
            mask &= ~0u << child;
            break;
        }
        return mask == 0 ? 0 : reached(node, mask);
    }
    Visit visit_leaf(const PlainLeaf& leaf) {
        const std::uint32_t begin = scalar::storage_index(leaf, 0), end = begin + leaf.triangle_count();
        for (std::uint32_t index = begin; index < end; ++index) {
            if (owner_of(blob, index) != owner) continue;
            found = index;
            return Visit::stop;
        }
        return Visit::next;
    }
};

}  // namespace

bool is_first_reference(const BlobData& blob, std::uint32_t index, ReachedChildren reached) {
    if constexpr (!reads_duplicate_references) return true;
    FirstReference first = {blob, reached, owner_of(blob, index), bounds_of(find_triangle(blob, index))};
    scalar::visit_in_storage_order<PlainLeaf>(blob, first);
    return first.found == index;
}

bool is_first_reference(const BlobData& blob, std::uint32_t index, const IntegerRay& ray) {
    return is_first_reference(blob, index, [&](const PlainNode& node, unsigned children) {
        return children_passed(ray, node, blob.bits, children);
    });
}

}  // namespace espalier::detail
