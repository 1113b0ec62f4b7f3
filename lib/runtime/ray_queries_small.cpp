// Ray queries for small cores: few bytes of code and stack, and hardly a float.
#include <bit>

#include <runtime/ray_queries.hpp>
#include <runtime/seen_boxes.hpp>
#include <runtime/seen_triangles.hpp>
#include <runtime/small_boxes.hpp>
#include <runtime/small_ray_triangle.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier::detail::small {

using LatticeRay = SeenRay;
/// Boxes need no more than the ray itself.
struct RayLanes {
    const SeenRay* ray;
};
struct PreparedRay {
    SeenRay ray;
    RayLanes lanes;
};
inline bool prepare(const BlobData& blob, const Ray& world, PreparedRay& prepared) {
    RaySlope slope;
    if (!round_ray(blob, world, prepared.ray, slope)) return false;
    prepared.ray.look_ahead(blob);
    prepared.lanes = {&prepared.ray};
    return true;
}

#include <runtime/small_walk.inl>

[[gnu::always_inline]] inline unsigned slab_test(const Node& node, const RayLanes& lanes, float limit, Keys keys) {
    return seen_children(*lanes.ray, node.bytes, limit, keys.among & all_children(node), keys.ahead);
}

/// The triangles of a leaf that the ray may hit. Apart from the walk, as the kernel is: of their needs only the larger
/// one is ever on the stack.
template <class Leaf>
[[gnu::noinline]] typename Leaf::Slots ray_candidates(const Leaf& leaf, const SeenRay& ray) {
    const SeenVertices<Leaf::max_vertices> vertices(leaf, ray);
    typename Leaf::Slots mask = 0;
    auto corners = scalar::corners_of(leaf);
    for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
        const scalar::CornerNumbers triangle = corners.next();
        if (vertices.allows(triangle.a, triangle.b, triangle.c)) mask |= typename Leaf::Slots{1} << slot;
    }
    return mask & leaf.used_slots();
}
template <class Leaf>
[[gnu::noinline]] bool hits_slot(const Leaf& leaf, unsigned slot, const SeenRay& ray, TriangleHit& hit) {
    count_decision();
    LatticeTriangle triangle = leaf.triangle(slot);
    return small_ray_triangle::hits(ray, triangle, hit);
}
using scalar::owner_index;

#include <runtime/ray_visitors.inl>
#include <runtime/ray_queries.inl>
#include <runtime/approximate_rays.inl>

}  // namespace espalier::detail::small
