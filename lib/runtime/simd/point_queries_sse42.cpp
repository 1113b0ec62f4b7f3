// Queries by distance, sse42.
#include <bit>

#include <runtime/point_queries.hpp>
#include <runtime/small_boxes.hpp>
#if ESPALIER_X86
#include <runtime/simd/lanes_sse42.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {
#include <runtime/traverse.inl>
#include <runtime/squared_distance.inl>
#include <runtime/node_boxes.inl>
#include <runtime/point_nodes.inl>
#include <runtime/point_bounds.inl>
#include <runtime/point_queries.inl>
#include <runtime/approximate_points.inl>
}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
#endif
