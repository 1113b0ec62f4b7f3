#include <runtime/answers/first_reference.hpp>

#include <runtime/traversal/find_triangle.hpp>
#include <runtime/traversal/find.hpp>
#include <runtime/traversal/small_boxes.hpp>

namespace espalier::detail {

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
