// Every triangle of a blob, in storage order.
#include <bit>

#include <espalier/walk.hpp>
#include <runtime/lattice_world.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier {
namespace detail {
namespace {

namespace scalar_walk {
using scalar::prefetch;
#include <runtime/traverse.inl>
}  // namespace scalar_walk

struct EveryTriangle {
    const BlobData& blob;
    FunctionRef<Visit(Triangle, const Corners&)> visit;

    static unsigned children(const Node& node, float*) {
        return (1u << (node.node_children() + node.leaf_children())) - 1u;
    }
    [[nodiscard]] Visit leaf(const IndexedLeaf& leaf) const {
        const std::uint32_t first = first_triangle(leaf);
        for (unsigned i = 0; i < leaf.triangle_count; ++i) {
            const LatticeTriangle t = leaf.triangle(i);
            const Corners corners = {to_world(blob, t.corner[0]), to_world(blob, t.corner[1]),
                                     to_world(blob, t.corner[2])};
            if (visit(Triangle{first + i}, corners) == stop) return stop;
        }
        return keep_going;
    }
};

}  // namespace
}  // namespace detail

bool for_each_triangle(const Blob& blob, FunctionRef<Visit(Triangle, const Corners&)> visit) {
    if (blob.triangle_count() == 0) return true;
    detail::EveryTriangle visitor = {blob.data(), visit};
    return detail::scalar_walk::traverse_in_storage_order(blob.data(), visitor);
}

}  // namespace espalier
