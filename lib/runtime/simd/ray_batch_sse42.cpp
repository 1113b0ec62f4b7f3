// Batches of rays, sse42.
#include <bit>

#include <runtime/copies.hpp>
#include <runtime/ray_batch.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/ray_triangle.hpp>
#if ESPALIER_X86
#include <runtime/simd/lanes_sse42.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {
#include <runtime/simd/prepare_ray_x86.inl>
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
}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
#endif
