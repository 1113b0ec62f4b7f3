// WebAssembly's SIMD128: four lanes.
#include <runtime/instruction_sets/queries.hpp>
#if ESPALIER_SIMD128
#include <runtime/lanes/simd128.hpp>

namespace espalier::detail::simd128 {
#include <runtime/rays/prepare_ray.inl>
#include <runtime/rays/slab_test.inl>
#include <runtime/instruction_sets/all.inl>
#include <runtime/rays/batch/batch.inl>
}  // namespace espalier::detail::simd128
#endif
