// Rays against the boxes of a packed node, in lanes.
#ifndef ESPALIER_RAYS_SLAB_TEST_HPP
#define ESPALIER_RAYS_SLAB_TEST_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/traverse.hpp>
#if ESPALIER_LANES >= 8
#include <runtime/rays/slab_test_avx2.hpp>
#endif

#if ESPALIER_LANES <= 4
ESPALIER_BEGIN_SET

/// The children whose slab interval, widened, meets [tau_min, limit], and where each begins (Kay and Kajiya 1986).
/// Neither end of the window is negative or -0, so that floats may be compared as integers.
[[maybe_unused]] ESPALIER_ALWAYS_INLINE inline unsigned slab_test(const PackedNode& node, const RayLanes& lanes_,
                                                                  float limit, float* near) {
    const RayLanes& ray = *as_if_changed(&lanes_);
    const SlabFrame frame = load_slab_frame(node, ray);
    unsigned mask = 0;
    for (unsigned first = 0; first < PackedNode::max_children; first += lanes) {
        const auto plane = [&](unsigned at, int k, Floats offset) {
            return to_compared(multiply_add(bytes_to_floats(node.bytes + at + first), frame.scale[k], offset));
        };
        const auto near_plane = [&](int k) { return plane(ray.planes.near_at[k], k, frame.near_offset[k]); };
        const auto far_plane = [&](int k) { return plane(ray.planes.far_at[k], k, frame.far_offset[k]); };
        const auto enter = larger(larger(near_plane(0), near_plane(1)),  //
                                  larger(near_plane(2), to_compared(splat(ray.tau_min))));
        const auto leave = smaller(smaller(far_plane(0), far_plane(1)),  //
                                   smaller(far_plane(2), to_compared(splat(limit))));
        mask |= at_most(enter, leave) << first;
        store_compared(near + first, enter);
    }
    return mask & all_children(node);
}

ESPALIER_END_SET
#endif

#endif
