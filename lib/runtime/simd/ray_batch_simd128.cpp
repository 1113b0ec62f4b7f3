// Batches of rays, simd128.
#include <bit>

#include <runtime/copies.hpp>
#include <runtime/ray_batch.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/ray_triangle.hpp>
#if ESPALIER_SIMD128
#include <runtime/simd/lanes_simd128.hpp>

namespace espalier::detail::simd128 {
#include <runtime/simd/prepare_ray_simd128.inl>
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
}  // namespace espalier::detail::simd128
#endif
