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
    float reach = 0.0f;
    if (!round_ray(blob, world, prepared.ray, reach)) return false;
    prepared.ray.look_ahead(blob);
    prepared.lanes = {&prepared.ray};
    return true;
}
/// Limits of walks are places ahead.
using Limit = std::int32_t;
inline Limit window_limit(const SeenRay& ray) { return ray.last_ahead(detail::window_limit(ray)); }
inline Limit hit_limit(const SeenRay& ray, float whole_tau) {
    return ray.last_ahead(detail::hit_limit(ray, whole_tau));
}

#include <runtime/small_walk.inl>

[[gnu::always_inline]] inline unsigned slab_test(const Node& node, const RayLanes& lanes, Limit limit, Keys keys) {
    return seen_children(*lanes.ray, node.bytes, limit, keys.among & all_children(node));
}

/// The triangles of a leaf that the ray may hit. Apart from the walk, as the kernel is: of their needs only the larger
/// one is ever on the stack.
template <class Leaf>
[[gnu::noinline]] typename Leaf::Slots ray_candidates(const Leaf& leaf, const SeenRay& ray,
                                                      const std::int32_t* anchor) {
    const SeenLeaf seen(static_cast<int>(std::bit_width(leaf.size)) - 1 + ray.fraction_bits);
    SeenVertex vertices[Leaf::max_vertices];
    for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
        std::int32_t place[3];
        leaf.place_vertex(vertex, anchor, ray.fraction_bits, place);
        vertices[vertex] = seen.vertex(ray, place);
    }
    typename Leaf::Slots mask = 0;
    auto corners = scalar::corners_of(leaf);
    for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
        const scalar::CornerNumbers triangle = corners.next();
        if (seen.allows(vertices[triangle.a], vertices[triangle.b], vertices[triangle.c]))
            mask |= typename Leaf::Slots{1} << slot;
    }
    return mask & leaf.used_slots();
}
template <class Leaf>
[[gnu::always_inline]] inline typename Leaf::Slots ray_candidates(const Leaf& leaf, const SeenRay& ray) {
    std::int32_t anchor[3];
    leaf.place_anchor(ray.origin, ray.fraction_bits, anchor);
    return ray_candidates(leaf, ray, anchor);
}
template <class Leaf>
[[gnu::noinline]] bool hits_slot(const Leaf& leaf, unsigned slot, const SeenRay& ray, TriangleHit& hit) {
    count_decision();
    std::int32_t anchor[3];
    leaf.place_anchor(ray.origin, ray.fraction_bits, anchor);
    LatticeTriangle from_origin;
    for (unsigned i = 0; i < 3; ++i)
        leaf.place_vertex(leaf.corner(slot, i), anchor, ray.fraction_bits, from_origin.corner[i]);
    return small_ray_triangle::hits(ray, from_origin, hit);
}
using scalar::owner_index;

namespace {  // what is called once becomes part of its caller

#include <runtime/ray_visitors.inl>

}  // namespace

#include <runtime/ray_queries.inl>
#include <runtime/approximate_rays.inl>

}  // namespace espalier::detail::small
