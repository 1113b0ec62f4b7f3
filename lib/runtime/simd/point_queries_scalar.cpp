// Queries by distance, scalar.
#include <bit>

#include <runtime/point_queries.hpp>
#include <runtime/small_code.hpp>
#include <runtime/small_boxes.hpp>
#include <runtime/simd/lanes_scalar.hpp>

#if !ESPALIER_SMALL_CODE  // else point_queries_small.cpp has them

namespace espalier::detail::scalar {
#include <runtime/traverse.inl>
#include <runtime/squared_distance.inl>
#include <runtime/node_boxes.inl>
#include <runtime/point_nodes.inl>
#include <runtime/point_bounds.inl>
#include <runtime/point_queries.inl>
#include <runtime/approximate_points.inl>
}  // namespace espalier::detail::scalar

#endif
