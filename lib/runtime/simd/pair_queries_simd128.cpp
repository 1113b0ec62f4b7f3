// Queries of two blobs, simd128.
#include <bit>

#include <runtime/pair_queries.hpp>
#if ESPALIER_SIMD128
#include <runtime/simd/lanes_simd128.hpp>

namespace espalier::detail::simd128 {
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
}  // namespace espalier::detail::simd128
#endif
