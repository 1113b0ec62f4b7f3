// NEON of AArch64: four lanes.
#include <runtime/instruction_sets/queries.hpp>
#if ESPALIER_NEON
#include <runtime/lanes/neon.hpp>

namespace espalier::detail::neon {
#include <runtime/rays/prepare_ray.inl>
#include <runtime/rays/slab_test.inl>
#include <runtime/instruction_sets/all.inl>
#include <runtime/rays/batch/batch.inl>
}  // namespace espalier::detail::neon
#endif
