// Ray queries for small cores: few bytes of code and stack, and hardly a float.
#include <type_traits>

#include <runtime/base/options.hpp>
#include <runtime/kernels/crossing.hpp>
#include <runtime/kernels/small_ray_triangle.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/rays/small_code/seen_boxes.hpp>
#include <runtime/traversal/small_boxes.hpp>

// What this file has of its own; it needs no lanes.
#define ESPALIER_LANES_CONTRACT_HPP
#define ESPALIER_RAYS_LEAF_FILTER_HPP
#define ESPALIER_TRAVERSAL_TRAVERSE_HPP

// What processors of x86 run that have no AVX2 is small rather than fast. The level is that of a region: as an option
// of the file it would hold for inline functions that other files share, too, and the linker keeps one copy of each.
#if ESPALIER_X86
#define ESPALIER_BEGIN_SMALL ESPALIER_BEGIN_LEVEL("Os")
#define ESPALIER_END_SMALL ESPALIER_END_LEVEL
#else
#define ESPALIER_BEGIN_SMALL
#define ESPALIER_END_SMALL
#endif
#define ESPALIER_LANES 1

ESPALIER_BEGIN_SMALL
namespace espalier::detail::small {

using LatticeRay = SeenRay;
/// What boxes of a kind of node need.
template <class Node>
using RayLanesOf = std::conditional_t<std::is_same_v<Node, PlainNode>, SeenPlainRay, SeenRay>;
template <class Lanes>
struct PreparedRayIn {
    Lanes ray;

    [[nodiscard]] const Lanes& lanes() const { return ray; }
};
template <class Lanes>
ESPALIER_NOINLINE bool prepare_ray(const BlobData& blob, const Ray& ray, PreparedRayIn<Lanes>& prepared) {
    float reach = 0.0f;
    return round_ray(blob, ray, prepared.ray, reach) && prepared.ray.prepare(blob);
}
template <class Lanes>
ESPALIER_NOINLINE bool prepare_ray(const BlobData& blob, const RayOnLattice& given, PreparedRayIn<Lanes>& prepared) {
    static_cast<IntegerRay&>(prepared.ray) = given.ray;
    return prepared.ray.prepare(blob);
}
/// Limits of walks are places ahead.
using Limit = std::int32_t;
ESPALIER_NOINLINE inline Limit hit_limit(const SeenRay& ray, float whole_tau) {
    return ray.last_ahead(detail::hit_limit(ray, whole_tau));
}
/// Returns the limit of a walk that has found nothing yet: that of a hit at the window's end.
ESPALIER_ALWAYS_INLINE inline Limit window_limit(const SeenRay& ray) {
    return hit_limit(ray, ray.tau_offset + ray.tau_max);
}

using scalar::visit_leaf;
using scalar::with_leaves_of;

// The two ways through a tree for small cores, which have little stack: what waits is a word a level. Visitors as for
// traverse.hpp; only children of `among` are tested.

struct Keys {
    unsigned among;
};

/// Nodes on the way down of which some children have not had their turn: eight bits of these above each index, the
/// others in a byte.
template <class Node>
class WaitingNodes {
    static_assert(format::max_nodes <= 1u << 24 && Node::max_children <= 16);
    static constexpr bool is_wide = Node::max_children > 8;

public:
    ESPALIER_ALWAYS_INLINE void push(std::uint32_t node, unsigned children) {
        // mutant(<< -> one less) huge: the bit for nodes beyond the first eight million
        nodes_[size_] = children << 24 | node;
        if constexpr (is_wide) others_[size_] = static_cast<std::uint8_t>(children >> 8);
        ++size_;
    }
    /// False when there are none.
    ESPALIER_ALWAYS_INLINE bool pop(std::uint32_t& node, unsigned& children) {
        if (size_ == 0) return false;
        --size_;
        node = nodes_[size_] & ((1u << 24) - 1u);
        children = nodes_[size_] >> 24;
        if constexpr (is_wide) children |= unsigned{others_[size_]} << 8;
        return true;
    }

private:
    static constexpr unsigned most = format::max_depth - 1;  ///< the deepest nodes have leaves alone

    std::uint32_t nodes_[most];
    std::uint8_t others_[is_wide ? most : 1];
    std::uint8_t size_ = 0;  ///< a byte: the stack has no room for three more
};

/// A walk to the children with the smallest keys first. Once it has gone down to one of them, or a leaf has been
/// visited, the others are tested again: that is more exact by then, and no keys need to wait.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline void traverse_nearest_first(const BlobData& blob, Visitor& visitor) {
    using Node = typename Leaf::Node;
    WaitingNodes<Node> waiting;
    std::uint32_t index = 0;
    unsigned among = every_child_of<Node>;
    do {
        count_node_step();
        const Node node = node_at<Node>(blob, index);
        const unsigned seen = visitor.children(node, {among});
        among = SeenChildren<Node>::children(seen);
        if (among == 0) continue;
        const unsigned nearest = SeenChildren<Node>::nearest(seen);
        among &= ~(1u << nearest);
        const unsigned node_children = node.node_children();
        if (nearest < node_children) {
            if (among != 0) waiting.push(index, among);
            index = node.first_child() + nearest;
            among = every_child_of<Node>;
        } else {
            count_leaf_step();
            if (visit_leaf<Leaf>(blob, node, nearest - node_children, visitor) == Visit::stop) return;
        }
    } while (among != 0 || waiting.pop(index, among));
}

/// Visits children in storage order. Returns stop if the visitor does.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline Visit walk_in_storage_order(const BlobData& blob, Visitor& visitor) {
    using Node = typename Leaf::Node;
    WaitingNodes<Node> waiting;
    std::uint32_t index = 0;
    for (;;) {
        count_node_step();
        const Node node = node_at<Node>(blob, index);
        const unsigned mask = SeenChildren<Node>::children(visitor.children(node, {every_child_of<Node>}));
        const unsigned node_children = node.node_children();
        for (unsigned number = 0; mask >> node_children >> number != 0; ++number) {
            if ((mask >> node_children >> number & 1u) == 0) continue;
            count_leaf_step();
            if (visit_leaf<Leaf>(blob, node, number, visitor) == Visit::stop) return Visit::stop;
        }
        std::uint32_t first = node.first_child();
        unsigned nodes = mask & ((1u << node_children) - 1u);
        if (nodes == 0 && !waiting.pop(first, nodes)) return Visit::next;
        index = first + static_cast<unsigned>(std::countr_zero(nodes));
        nodes &= nodes - 1;
        if (nodes != 0) waiting.push(first, nodes);
    }
}

template <class Node>
ESPALIER_ALWAYS_INLINE inline unsigned slab_test(const Node& node, const RayLanesOf<Node>& lanes, Limit limit,
                                                 Keys keys) {
    return seen_children(lanes, node, limit, keys.among & all_children(node));
}

/// The triangles of a leaf that the ray may hit. Apart from the walk, as the kernel is: of their needs only the larger
/// one is ever on the stack.
template <class Leaf>
ESPALIER_NOINLINE typename Leaf::Slots ray_candidates(const Leaf& leaf, const SeenRay& ray) {
    const SeenLeaf seen(leaf.size_bits + ray.fraction_bits);
    // A vertex is placed where it and the next two will be.
    std::int32_t room[Leaf::max_vertices + 2];
    std::int32_t* const vertices = as_if_changed(&room[0]);  // in a register: counted from the frame, each look-up adds
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
        std::int32_t* const place = vertices + vertex;
        place_vertex(leaf, vertex, ray, place);
        *place =
            static_cast<std::int32_t>(seen.vertex(ray, place[ray.axis[0]], place[ray.axis[1]], place[ray.axis[2]]));
    }
    const auto at = [&](unsigned vertex) { return static_cast<SeenVertex>(vertices[vertex]); };
    typename Leaf::Slots mask = 0;
    auto corners = scalar::corners_of(leaf);
    // mutant(< -> <=) sanitizer: shifts by the width of the type where a leaf is full
    for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
        const scalar::CornerNumbers triangle = corners.next();
        if (seen.allows(at(triangle.a), at(triangle.b), at(triangle.c))) mask |= typename Leaf::Slots{1} << slot;
    }
    return mask & leaf.used_slots();
}
template <class Leaf>
ESPALIER_NOINLINE bool hits_slot(const Leaf& leaf, unsigned slot, const SeenRay& ray, TriangleHit& hit) {
    count_decision();
    LatticeTriangle from_origin;
    for (unsigned i = 0; i < 3; ++i) place_vertex(leaf, leaf.corner(slot, i), ray, from_origin.corner[i]);
    return small_ray_triangle::hits(ray, from_origin, hit);
}
/// Small cores have no stack to keep what was unpacked.
template <class Leaf>
using RayLeaf = KeptLeaf<Leaf>;
template <class Leaf>
ESPALIER_ALWAYS_INLINE inline typename Leaf::Slots ray_candidates(const BlobData& blob, const typename Leaf::Node& node,
                                                                  unsigned number, const SeenRay& ray, Leaf& leaf) {
    // A node of its own: GCC keeps a copied one on the stack for as long as the walk takes.
    decode_leaf(blob, typename Leaf::Node{node.bytes}, number, leaf);
    return ray_candidates(leaf, ray);
}
inline constexpr bool decides_by_signs = false;
template <class Leaf>
inline bool is_hit(const Leaf& leaf, unsigned slot, const SeenRay& ray) {
    TriangleHit hit;
    return hits_slot(leaf, slot, ray, hit);
}
using scalar::owner_index;
using scalar::storage_index;

}  // namespace espalier::detail::small
ESPALIER_END_SMALL

// What is called once becomes part of its caller.
#define ESPALIER_BEGIN_SET                                   \
    ESPALIER_BEGIN_SMALL namespace espalier::detail::small { \
        namespace {
#define ESPALIER_END_SET \
    }                    \
    }                    \
    ESPALIER_END_SMALL
#include <runtime/traversal/query.hpp>
#undef ESPALIER_BEGIN_SET
#undef ESPALIER_END_SET
#define ESPALIER_BEGIN_SET ESPALIER_BEGIN_SMALL namespace espalier::detail::small {
#define ESPALIER_END_SET \
    }                    \
    ESPALIER_END_SMALL
#include <runtime/rays/single.hpp>
#include <runtime/lanes/end_set.hpp>
