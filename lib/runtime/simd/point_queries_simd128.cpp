// Queries by distance, simd128.
#include <bit>

#include <runtime/point_queries.hpp>
#include <runtime/small_boxes.hpp>
#if ESPALIER_SIMD128
#include <runtime/simd/lanes_simd128.hpp>

namespace espalier::detail::simd128 {
#include <runtime/traverse.inl>
#include <runtime/squared_distance.inl>
#include <runtime/node_boxes.inl>
#include <runtime/point_nodes.inl>
#include <runtime/point_bounds.inl>
#include <runtime/point_queries.inl>
#include <runtime/approximate_points.inl>
}  // namespace espalier::detail::simd128
#endif
