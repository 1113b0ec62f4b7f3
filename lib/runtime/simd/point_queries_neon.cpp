// Queries by distance, neon.
#include <bit>

#include <runtime/point_queries.hpp>
#include <runtime/small_boxes.hpp>
#if ESPALIER_NEON
#include <runtime/simd/lanes_neon.hpp>

namespace espalier::detail::neon {
#include <runtime/traverse.inl>
#include <runtime/squared_distance.inl>
#include <runtime/node_boxes.inl>
#include <runtime/point_nodes.inl>
#include <runtime/point_bounds.inl>
#include <runtime/point_queries.inl>
#include <runtime/approximate_points.inl>
}  // namespace espalier::detail::neon
#endif
