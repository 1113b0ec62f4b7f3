// Volumes with one lane. Apart from the other queries of that set: small code inlines more of what has one caller.
#include <runtime/lanes/scalar.hpp>
#include <runtime/overlap/volume.hpp>
#include <runtime/traversal/scalar_walk.hpp>

namespace espalier::detail::scalar {
using scalar_walk::find_each;
#include <runtime/proximity/overlap_candidates.inl>
#include <runtime/overlap/volume_queries.inl>
}  // namespace espalier::detail::scalar
