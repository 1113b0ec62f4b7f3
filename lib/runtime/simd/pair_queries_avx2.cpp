// Queries of two blobs, avx2.
#include <bit>

#include <runtime/pair_queries.hpp>
#if ESPALIER_X86
#include <runtime/simd/lanes_avx2.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {
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
}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET
#endif
