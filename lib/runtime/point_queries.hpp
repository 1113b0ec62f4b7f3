// The queries by distance in lattice units, once for each instruction set.
#pragma once

#include <espalier/function_ref.hpp>
#include <runtime/best_k.hpp>
#include <runtime/copies.hpp>
#include <runtime/found.hpp>
#include <runtime/simd/select.hpp>

namespace espalier::detail {

/// Of squared distances, in lattice steps, as floats that may be off by 2^-18; infinite when there is nothing.
struct SquaredBounds {
    float lower = infinity;
    float upper = infinity;
};

/// Offers a triangle to the closest ones. Out of line: every instruction set would have a copy.
void offer(const BlobData& blob, const FoundNearest& found, ClosestFew& few);
/// Sorts the closest triangles and converts their distances to the caller's units. Returns how many there are.
std::size_t finish(const BlobData& blob, ClosestFew& few, float distance_offset, float max_distance);

}  // namespace espalier::detail

#define ESPALIER_DECLARE_POINT_QUERIES(instruction_set)                                                             \
    namespace instruction_set {                                                                                     \
    bool any_overlap(const BlobData& blob, const LatticePoint& point);                                              \
    bool every_overlap(const BlobData& blob, const LatticePoint& point, std::uint32_t first,                        \
                       FunctionRef<Visit(Triangle)> visit);                                                         \
    bool closest_triangle(const BlobData& blob, const LatticePoint& point, FoundNearest& best);                     \
    void closest_triangles(const BlobData& blob, const LatticePoint& point, ClosestFew& few);                       \
    bool may_overlap(const BlobData& blob, const LatticePoint& point, std::int32_t steps, QueryCounters& counters); \
    SquaredBounds closest_bounds(const BlobData& blob, const LatticePoint& point, std::int32_t steps,               \
                                 QueryCounters& counters);                                                          \
    }

namespace espalier::detail {

ESPALIER_DECLARE_POINT_QUERIES(scalar)
#if ESPALIER_X86
ESPALIER_DECLARE_POINT_QUERIES(sse42)
ESPALIER_DECLARE_POINT_QUERIES(avx2)
#if defined(__x86_64__)
ESPALIER_DECLARE_POINT_QUERIES(avx512)
#endif
#elif ESPALIER_NEON
ESPALIER_DECLARE_POINT_QUERIES(neon)
#elif ESPALIER_SIMD128
ESPALIER_DECLARE_POINT_QUERIES(simd128)
#endif

}  // namespace espalier::detail

#undef ESPALIER_DECLARE_POINT_QUERIES
