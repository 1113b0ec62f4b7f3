// The search through two blobs on their common grid, once for each instruction set.
#pragma once

#include <espalier/advanced/statistics.hpp>
#include <runtime/kernels/triangle_distance.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/pairs/frame.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier::detail {

/// The least distance so far, on the common grid.
struct FoundTriangles {
    TriangleDistance distance;
    LatticeTriangle a;
    LatticeTriangle b;
    TrianglePair pair;
};

/// Three perpendicular directions in one tree's frame, a hair less than 1 long, of which the first is the one in which
/// the meshes are near each other: along these, pairs that are no nearer than others show it. All 0: nothing yet.
struct PairAxes {
    float at[3][3] = {};
};

/// The squared distance of two triangles' boxes.
float gap_between(const LatticeTriangle& a, const LatticeTriangle& b);

/// The pair that is least apart; of equal ones the lowest, but the first that touches. Or any pair within the radius.
struct LeastDistance {
    const PairFrame& frame;
    float radius;  ///< steps of the grid
    bool any;      ///< whether any pair within the radius is as good
    bool found = false;
    FoundTriangles best = {};
    /// While looking first where the meshes may be near each other: of two leaves only the most promising pair is
    /// visited, which need not be within the radius to tell the direction.
    bool surveys = true;
    float limit_of_boxes = radius * radius * distance_slack;
    float limit_of_survey = infinity;
    PairAxes axes[2] = {};  ///< in either tree's frame

    void set_radius(float steps) {
        radius = steps;
        limit_of_boxes = steps * steps * distance_slack;
    }
    [[nodiscard]] bool is_done() const { return found && (any || best.distance.squared == 0.0f); }
    /// For triangles.
    [[nodiscard]] float limit() const { return surveys ? limit_of_survey : limit_of_boxes; }
    void lower_limit(float limit) {
        limit_of_survey = minimum(limit, limit_of_survey);
        limit_of_boxes = minimum(limit, limit_of_boxes);
    }
    /// Takes a pair by the triangles' places on the grid and their storage indices, which may be those of copies.
    Visit take(const LatticeTriangle& a, const LatticeTriangle& b, const TrianglePair& references);

private:
    void set_axes(const LatticeTriangle& a, const LatticeTriangle& b, const TriangleDistance& distance);
};

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
