// The queries of two blobs on their common grid, once for each instruction set.
#pragma once

#include <espalier/function_ref.hpp>
#include <runtime/copies.hpp>
#include <runtime/pair_frame.hpp>
#include <runtime/square_root.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/simd/select.hpp>
#include <runtime/small_code.hpp>
#include <runtime/triangle_distance.hpp>

namespace espalier::detail {

/// The least distance so far, on the common grid.
struct FoundTriangles {
    TriangleDistance distance;
    LatticeTriangle a;
    LatticeTriangle b;
    TrianglePair pair;
};

/// Takes a pair that touches: storage indices, which may be those of copies.
using OnTouching = FunctionRef<Visit(const TrianglePair&)>;

}  // namespace espalier::detail

#define ESPALIER_DECLARE_PAIR_QUERIES(instruction_set)                                                          \
    namespace instruction_set {                                                                                 \
    QueryStatus touching_pairs(const PairFrame& frame, OnTouching visit, std::uint64_t& work);                  \
    QueryStatus nearest_pair(const PairFrame& frame, float radius, bool any, FoundTriangles& best, bool& found, \
                             std::uint64_t& work);                                                              \
    }

namespace espalier::detail {

ESPALIER_DECLARE_PAIR_QUERIES(scalar)
#if ESPALIER_X86
ESPALIER_DECLARE_PAIR_QUERIES(sse42)
ESPALIER_DECLARE_PAIR_QUERIES(avx2)
#if defined(__x86_64__)
namespace avx512 {
using avx2::nearest_pair;
using avx2::touching_pairs;
}  // namespace avx512
#endif
#elif ESPALIER_NEON
ESPALIER_DECLARE_PAIR_QUERIES(neon)
#elif ESPALIER_SIMD128
ESPALIER_DECLARE_PAIR_QUERIES(simd128)
#endif

}  // namespace espalier::detail

#undef ESPALIER_DECLARE_PAIR_QUERIES
