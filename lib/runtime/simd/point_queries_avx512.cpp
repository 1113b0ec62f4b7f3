// Queries by distance, AVX-512: leaves sixteen lanes at a time, nodes as with AVX2.
#include <bit>

#include <runtime/point_queries.hpp>
#include <runtime/small_boxes.hpp>
#if ESPALIER_X86 && defined(__x86_64__)
#include <runtime/simd/lanes_avx512.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {
#include <runtime/squared_distance.inl>
#include <runtime/node_boxes.inl>
#include <runtime/point_nodes.inl>
}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET

ESPALIER_BEGIN_TARGET(ESPALIER_AVX512)
namespace espalier::detail::avx512 {
using avx2::distance_test;
using avx2::overlap_test;
#include <runtime/traverse.inl>
#include <runtime/squared_distance.inl>
#include <runtime/point_bounds.inl>
#include <runtime/point_queries.inl>
#include <runtime/approximate_points.inl>
}  // namespace espalier::detail::avx512
ESPALIER_END_TARGET
#endif
