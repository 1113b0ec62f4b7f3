// Every triangle of a blob, in storage order.
#include <bit>

#include <espalier/walk.hpp>
#include <runtime/copies.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier {
namespace detail {
namespace {

namespace scalar_walk {
using scalar::lanes;
using scalar::prefetch;
#include <runtime/traverse.inl>
}  // namespace scalar_walk

struct EveryTriangle {
    const BlobData& blob;
    FunctionRef<Visit(Triangle, const Corners&)> visit;

    static unsigned children(const Node& node, float*) {
        return (1u << (node.node_children() + node.leaf_children())) - 1u;
    }
    template <class Leaf>
    [[nodiscard]] Visit visit_leaf(const Leaf& leaf) const {
        for (auto slots = leaf.used_slots(); slots != 0; slots &= slots - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(slots));
            const std::uint32_t index = scalar::storage_index(leaf, slot);
            if (is_copy(blob, index)) continue;
            const LatticeTriangle t = leaf.triangle(slot);
            const Corners corners = {to_world(blob, t.corner[0]), to_world(blob, t.corner[1]),
                                     to_world(blob, t.corner[2])};
            if (visit(Triangle{index}, corners) == stop) return stop;
        }
        return keep_going;
    }
};

}  // namespace
}  // namespace detail

bool for_each_triangle(const Blob& blob, FunctionRef<Visit(Triangle, const Corners&)> visit) {
    if (blob.triangle_count() == 0) return true;
    detail::EveryTriangle visitor = {blob.data(), visit};
    return detail::scalar_walk::with_leaves_of(blob.data(), [&]<class Leaf>() {
        return detail::scalar_walk::traverse_in_storage_order<Leaf>(blob.data(), visitor) == keep_going;
    });
}

}  // namespace espalier
