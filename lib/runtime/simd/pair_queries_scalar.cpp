// Queries of two blobs, scalar.
#include <bit>

#include <runtime/pair_queries.hpp>
#include <runtime/simd/lanes_scalar.hpp>

namespace espalier::detail::scalar {
#include <runtime/traverse.inl>
#include <runtime/pair_nodes.inl>
#include <runtime/traverse_pair.inl>
#include <runtime/pair_beam.inl>
#include <runtime/pair_leaves.inl>
#include <runtime/pair_touching.inl>
#include <runtime/pair_near.inl>
#include <runtime/pair_queries.inl>
}  // namespace espalier::detail::scalar
