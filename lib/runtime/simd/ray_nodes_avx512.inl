// Rays against the boxes of a node, AVX-512: packed nodes and the ray itself as with AVX2, plain nodes in sixteen
// lanes. Included inside the namespace.

using avx2::prepare;

[[maybe_unused, gnu::always_inline]] inline unsigned slab_test(const PackedNode& node, const PlacedRayLanes& lanes_,
                                                               float limit, float* near) {
    return avx2::slab_test(node, lanes_, limit, near);
}
#include <runtime/ray_plain_nodes.inl>
