// Ray queries, neon.
#include <bit>

#include <runtime/ray_queries.hpp>
#include <runtime/small_boxes.hpp>
#if ESPALIER_NEON
#include <runtime/simd/lanes_neon.hpp>

namespace espalier::detail::neon {
#include <runtime/simd/prepare_ray_portable.inl>
#include <runtime/traverse.inl>
#include <runtime/ray_nodes.inl>
#include <runtime/ray_plain_nodes.inl>
#include <runtime/float_vertices.inl>
#include <runtime/pair_vertices.inl>
#include <runtime/unpacked_leaf.inl>
#include <runtime/ray_filter.inl>
#include <runtime/ray_visitors.inl>
#include <runtime/ray_queries.inl>
#include <runtime/approximate_rays.inl>
}  // namespace espalier::detail::neon
#endif
