// Batches of rays, AVX-512: leaves sixteen lanes at a time, nodes and the ray itself as with AVX2.
#include <bit>

#include <runtime/copies.hpp>
#include <runtime/ray_batch.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/ray_triangle.hpp>
#if ESPALIER_X86 && defined(__x86_64__)
#include <runtime/simd/lanes_avx512.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {
#include <runtime/simd/prepare_ray_x86.inl>
#include <runtime/simd/ray_nodes_avx2.inl>
}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET

ESPALIER_BEGIN_TARGET(ESPALIER_AVX512)
namespace espalier::detail::avx512 {
#include <runtime/traverse.inl>
#include <runtime/simd/ray_nodes_avx512.inl>
#include <runtime/float_vertices.inl>
/// Registers hold all of a leaf.
template <unsigned groups>
using SeenVertices = FloatVertices<groups>;
#include <runtime/unpacked_leaf.inl>
#include <runtime/ray_filter.inl>
#include <runtime/ray_visitors.inl>
#include <runtime/ray_in_batch.inl>
#include <runtime/ray_group.inl>
#include <runtime/ray_batch.inl>
}  // namespace espalier::detail::avx512
ESPALIER_END_TARGET
#endif
