// Rays against the boxes of a plain node, in lanes.
#ifndef ESPALIER_RAYS_PLAIN_SLAB_TEST_HPP
#define ESPALIER_RAYS_PLAIN_SLAB_TEST_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/slab_test.hpp>

ESPALIER_BEGIN_SET

/// The children whose slab interval, widened, meets [tau_min, limit], and where each begins (Kay and Kajiya 1986).
/// Neither end of the window is negative or -0, so that floats may be compared as integers.
[[maybe_unused]] ESPALIER_ALWAYS_INLINE inline unsigned slab_test(const PlainNode& node, const PlainRayLanes& lanes_,
                                                                  float limit, float* near) {
    const PlainRayLanes& ray = *as_if_changed(&lanes_);
    unsigned mask = 0;
    for (unsigned first = 0; first < PlainNode::max_children; first += lanes) {
        const auto tau = [&](unsigned at, int k, const float* offset) ESPALIER_ALWAYS_INLINE_LAMBDA {
            const Floats plane = to_floats(load_words(node.bytes + at + 2 * std::size_t{first}));
            return to_compared(multiply_add(plane, splat(ray.base_inverse[k]), splat(offset[k])));
        };
        const auto near_plane = [&](int k) ESPALIER_ALWAYS_INLINE_LAMBDA {
            return tau(ray.planes.near_at[k], k, ray.near_offset);
        };
        const auto far_plane = [&](int k) ESPALIER_ALWAYS_INLINE_LAMBDA {
            return tau(ray.planes.far_at[k], k, ray.far_offset);
        };
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
