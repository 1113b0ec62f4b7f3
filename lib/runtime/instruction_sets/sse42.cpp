// SSE4.2: four lanes, for processors from before 2013 and some of the cheapest since.
#include <runtime/instruction_sets/queries.hpp>
#if ESPALIER_HAS_SSE42
#include <runtime/lanes/sse42.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_SSE42)
namespace espalier::detail::sse42 {
#include <runtime/rays/prepare_ray.inl>
#include <runtime/rays/slab_test.inl>
#include <runtime/instruction_sets/all.inl>
#include <runtime/rays/batch/batch.inl>
}  // namespace espalier::detail::sse42
ESPALIER_END_TARGET
#endif
