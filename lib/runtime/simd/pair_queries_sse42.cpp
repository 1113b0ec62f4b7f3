// Queries of two blobs, sse42.
#include <bit>

#include <runtime/pair_queries.hpp>
#if ESPALIER_X86
#include <runtime/simd/lanes_sse42.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {
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
}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
#endif
