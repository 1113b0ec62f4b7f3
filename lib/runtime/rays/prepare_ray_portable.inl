// prepare_ray as it is defined, for instruction sets without a way of their own.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/traversal/alone.hpp>
#endif

/// Prepares a Ray or a RayOnLattice. Returns ok, or why there is nothing to walk.
template <class Caller, class Lanes>
ESPALIER_ALWAYS_INLINE inline QueryStatus prepare(const BlobData& blob, const Caller& world,
                                                  PreparedRayIn<Lanes>& prepared) {
    return prepare_ray(blob, world, prepared) ? QueryStatus::ok : status_without_walk(blob, world);
}
