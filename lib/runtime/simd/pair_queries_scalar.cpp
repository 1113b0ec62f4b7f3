// Queries of two blobs, scalar.
#include <bit>

#include <runtime/pair_queries.hpp>
#include <runtime/simd/lanes_scalar.hpp>
#include <runtime/small_code.hpp>

#if !ESPALIER_SMALL_CODE  // else pair_queries_small.cpp has them

namespace espalier::detail::scalar {
#include <runtime/traverse.inl>
#include <runtime/pair_nodes.inl>
#include <runtime/pair_trees.inl>
#include <runtime/traverse_pair.inl>
#include <runtime/pair_beam.inl>
#include <runtime/least_distance.inl>
#include <runtime/pair_leaves.inl>
#include <runtime/pair_touching.inl>
#include <runtime/pair_near.inl>
#include <runtime/pair_queries.inl>
}  // namespace espalier::detail::scalar

#endif
