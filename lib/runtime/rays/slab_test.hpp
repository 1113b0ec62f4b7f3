// Rays against the boxes of a node, in lanes: the children whose slab interval, widened, meets [tau_min, limit], and
// where each begins (Kay and Kajiya 1986). Floats may be compared as integers, by their bits: neither end of the window
// is negative or -0.
#ifndef ESPALIER_RAYS_SLAB_TEST_HPP
#define ESPALIER_RAYS_SLAB_TEST_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/traverse.hpp>
#if ESPALIER_LANES >= 8
#include <runtime/rays/slab_test_avx2.hpp>
#endif

ESPALIER_BEGIN_SET

/// `near_plane(first, k)` and `far_plane(first, k)` return where the ray enters and leaves along axis k.
template <class Node, class Lanes, class NearPlane, class FarPlane>
ESPALIER_ALWAYS_INLINE inline unsigned test_slabs(const Node& node, const Lanes& ray, float limit, float* near,
                                                  NearPlane near_plane, FarPlane far_plane) {
    unsigned mask = 0;
    for (unsigned first = 0; first < Node::max_children; first += lanes) {
        const auto enter = larger(larger(near_plane(first, 0), near_plane(first, 1)),  //
                                  larger(near_plane(first, 2), to_compared(splat(ray.tau_min))));
        const auto leave = smaller(smaller(far_plane(first, 0), far_plane(first, 1)),  //
                                   smaller(far_plane(first, 2), to_compared(splat(limit))));
        mask |= at_most(enter, leave) << first;
        store_compared(near + first, enter);
    }
    return mask & all_children(node);
}

[[maybe_unused]] ESPALIER_ALWAYS_INLINE inline unsigned slab_test(const PlainNode& node, const PlainRayLanes& ray_lanes,
                                                                  float limit, float* near) {
    const PlainRayLanes& ray = *as_if_changed(&ray_lanes);
    const auto tau = [&](unsigned at, unsigned first, int k, const float* offset) ESPALIER_ALWAYS_INLINE_LAMBDA {
        const Floats plane = to_floats(load_words(node.bytes + at + 2 * std::size_t{first}));
        return to_compared(multiply_add(plane, splat(ray.base_inverse[k]), splat(offset[k])));
    };
    return test_slabs(
        node, ray, limit, near,
        [&](unsigned first, int k)
            ESPALIER_ALWAYS_INLINE_LAMBDA { return tau(ray.planes.near_at[k], first, k, ray.near_offset); },
        [&](unsigned first, int k)
            ESPALIER_ALWAYS_INLINE_LAMBDA { return tau(ray.planes.far_at[k], first, k, ray.far_offset); });
}

#if ESPALIER_LANES <= 4

[[maybe_unused]] ESPALIER_ALWAYS_INLINE inline unsigned slab_test(const PackedNode& node, const RayLanes& ray_lanes,
                                                                  float limit, float* near) {
    const RayLanes& ray = *as_if_changed(&ray_lanes);
    const SlabFrame frame = load_slab_frame(node, ray);
    const auto tau = [&](unsigned at, unsigned first, int k, Floats offset) ESPALIER_ALWAYS_INLINE_LAMBDA {
        return to_compared(multiply_add(bytes_to_floats(node.bytes + at + first), frame.scale[k], offset));
    };
    return test_slabs(
        node, ray, limit, near,
        [&](unsigned first, int k)
            ESPALIER_ALWAYS_INLINE_LAMBDA { return tau(ray.planes.near_at[k], first, k, frame.near_offset[k]); },
        [&](unsigned first, int k)
            ESPALIER_ALWAYS_INLINE_LAMBDA { return tau(ray.planes.far_at[k], first, k, frame.far_offset[k]); });
}

#endif

ESPALIER_END_SET

#endif
