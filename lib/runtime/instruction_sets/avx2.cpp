// AVX2: eight lanes.
#include <runtime/instruction_sets/queries.hpp>
#if ESPALIER_HAS_AVX2
#include <runtime/lanes/avx2.hpp>

ESPALIER_BEGIN_TARGET(ESPALIER_AVX2)
namespace espalier::detail::avx2 {
#include <runtime/rays/prepare_ray.inl>
#include <runtime/rays/slab_test_avx2.inl>
#include <runtime/instruction_sets/all.inl>
#include <runtime/rays/batch/batch.inl>
}  // namespace espalier::detail::avx2
ESPALIER_END_TARGET
#endif
