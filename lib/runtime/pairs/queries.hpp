// The search through two blobs on their common grid, once for each instruction set.
#pragma once

#include <espalier/base/function_ref.hpp>
#include <espalier/advanced/statistics.hpp>
#include <runtime/base/options.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/pairs/frame.hpp>
#include <runtime/pairs/least_distance.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier::detail {

/// Writes the triangles of a pair, on the common grid.
using PlaceTriangles = FunctionRef<void(LatticeTriangle& a, LatticeTriangle& b)>;
/// Takes a pair that touches: storage indices, which may be those of copies, and what places the two.
using OnTouching = FunctionRef<Visit(const TrianglePair&, PlaceTriangles)>;

/// Two triangles, of which a blob with copies may hold several references each.
struct ReferredTriangles {
    TrianglePair triangles;
    IntegerBounds bounds[2];
};

/// What a walk through two trees looks for: the pair that is least apart, or else all pairs that touch.
struct PairSearch {
    LeastDistance* least = nullptr;
    OnTouching on_touching = {};
    const TrianglePair* from = nullptr;       ///< begins at the two leaves that hold this pair
    const ReferredTriangles* only = nullptr;  ///< visits only leaves with references to both
    PairCounters* counters = nullptr;         ///< counts the leaves
};

/// At each pair of boxes `work` goes down; at 0 the search ends. invalid_argument if no way leads to `from`.
ESPALIER_IN_EACH_SET(QueryStatus search_pairs(const PairFrame& frame, const PairSearch& search,
                                              std::uint64_t& work) noexcept;)

}  // namespace espalier::detail
