// Batches of rays, neon.
#include <bit>

#include <runtime/copies.hpp>
#include <runtime/ray_batch.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/ray_triangle.hpp>
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
#include <runtime/ray_in_batch.inl>
#include <runtime/ray_group.inl>
#include <runtime/ray_batch.inl>
}  // namespace espalier::detail::neon
#endif
