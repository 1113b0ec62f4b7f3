// The ray queries, once for each instruction set: rounded, answered in lattice units, translated back. The blob is not
// empty.
#pragma once

#include <espalier/function_ref.hpp>
#include <runtime/copies.hpp>
#include <runtime/found.hpp>
#include <runtime/simd/select.hpp>

#define ESPALIER_DECLARE_RAY_QUERIES(instruction_set)                                                                  \
    namespace instruction_set {                                                                                        \
    bool closest_hit(const BlobData& blob, const Ray& world, RayHit& hit, const TriangleFilter* filter);               \
    HitCount first_hits(const BlobData& blob, const Ray& world, std::span<RayHit> hits, const TriangleFilter* filter); \
    bool any_hit(const BlobData& blob, const Ray& world, const TriangleFilter* filter);                                \
    bool every_hit(const BlobData& blob, const Ray& world, FunctionRef<Visit(const RayHit&)> visit);                   \
    bool may_hit(const BlobData& blob, const Ray& world, std::int32_t steps, QueryCounters& counters);                 \
    bool closest_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray, RayHit& hit);                           \
    bool any_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray);                                            \
    }

namespace espalier::detail {

ESPALIER_DECLARE_RAY_QUERIES(scalar)
ESPALIER_DECLARE_RAY_QUERIES(small)
#if ESPALIER_X86
ESPALIER_DECLARE_RAY_QUERIES(sse42)
ESPALIER_DECLARE_RAY_QUERIES(avx2)
#if defined(__x86_64__)
ESPALIER_DECLARE_RAY_QUERIES(avx512)
#endif
#elif ESPALIER_NEON
ESPALIER_DECLARE_RAY_QUERIES(neon)
#elif ESPALIER_SIMD128
ESPALIER_DECLARE_RAY_QUERIES(simd128)
#endif

namespace scalar {
bool closest_hit_counted(const BlobData& blob, const Ray& world, RayHit& hit, QueryCounters& counters);
}

}  // namespace espalier::detail

#undef ESPALIER_DECLARE_RAY_QUERIES
