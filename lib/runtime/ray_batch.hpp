// Batches of rays, once for each instruction set; the answers are those of one call for each ray. The blob is not
// empty.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/ray.hpp>
#include <runtime/found.hpp>
#include <runtime/simd/select.hpp>

#define ESPALIER_DECLARE_RAY_BATCHES(instruction_set)                                                       \
    namespace instruction_set {                                                                             \
    std::size_t closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count);       \
    std::size_t any_hits(const BlobData& blob, const Ray* rays, std::uint8_t* occluded, std::size_t count); \
    }

namespace espalier::detail {

/// What a batch says of a ray without a hit.
inline constexpr RayHit no_hit = {__builtin_inff(), 0.0f, 0.0f, {}, no_triangle};

/// One ray after the other, by a query for single rays. How many hit something.
template <bool (*closest_hit)(const BlobData&, const Ray&, RayHit&, const TriangleFilter*)>
std::size_t closest_hits_one_by_one(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (closest_hit(blob, rays[i], hits[i], nullptr)) ++found;
        else hits[i] = no_hit;
    }
    return found;
}
template <bool (*any_hit)(const BlobData&, const Ray&, const TriangleFilter*)>
std::size_t any_hits_one_by_one(const BlobData& blob, const Ray* rays, std::uint8_t* occluded, std::size_t count) {
    std::size_t found = 0;
    for (std::size_t i = 0; i < count; ++i) {
        occluded[i] = any_hit(blob, rays[i], nullptr) ? 1 : 0;
        found += occluded[i];
    }
    return found;
}

ESPALIER_DECLARE_RAY_BATCHES(scalar)
#if ESPALIER_X86
ESPALIER_DECLARE_RAY_BATCHES(sse42)
ESPALIER_DECLARE_RAY_BATCHES(avx2)
#if defined(__x86_64__)
ESPALIER_DECLARE_RAY_BATCHES(avx512)
#endif
#elif ESPALIER_NEON
ESPALIER_DECLARE_RAY_BATCHES(neon)
#elif ESPALIER_SIMD128
ESPALIER_DECLARE_RAY_BATCHES(simd128)
#endif

}  // namespace espalier::detail

#undef ESPALIER_DECLARE_RAY_BATCHES
