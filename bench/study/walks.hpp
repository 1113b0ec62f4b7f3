// A ray through a hierarchy: in which order the children of a node are visited.
#pragma once

#include "aabb_tree.hpp"
#include "shapes.hpp"

namespace espalier::bench {

enum class RayOrder : std::uint8_t {
    nearest_first,     ///< the child whose box the ray enters first; the other waits on a stack
    nearest_recursed,  ///< the same, with a function that calls itself instead of a stack
    fixed,             ///< the first child of the tree
    farthest_first,    ///< the child whose box the ray enters last
};
inline constexpr std::array all_ray_orders = {RayOrder::nearest_first, RayOrder::nearest_recursed, RayOrder::fixed,
                                              RayOrder::farthest_first};
/// Returns the name in rows.
[[nodiscard]] std::string_view name_of(RayOrder order);

/// What walks of rays count, added up.
struct RayWork {
    std::uint64_t box_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t skipped = 0;  ///< boxes that the ray meets, but that begin behind the hit that was found
};

/// Finds the closest hit. The answer is the same in every order.
///
/// A box is tested by its slabs (Kay, Kajiya 1986), a triangle by "Fast, minimum storage ray/triangle intersection"
/// (Möller, Trumbore 1997) in double.
class RayWalk {
public:
    explicit RayWalk(const AabbTree& tree);

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] double closest(RayOrder order, const Ray& ray, RayWork& work);

private:
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    const AabbTree* tree_;
    std::vector<Waiting> stack_;
};

/// Returns t of the closest hit by a test of all triangles, without a tree.
[[nodiscard]] double closest_of_all(const AabbTree& tree, const Ray& ray);

// Two hierarchies against each other: which node of a pair is replaced by its children.

/// The rules of "Real-Time Collision Detection" (Ericson 2005), section 6.3.
enum class PairRule : std::uint8_t {
    first_until_leaf,  ///< the first tree's node down to a leaf, then the second one's
    alternating,       ///< the node of the tree that was not descended last
    larger_volume,     ///< the node with the larger box by volume
    larger_area,       ///< the node with the larger box by surface area
    all_children,      ///< both at once: each child of one against each child of the other, four tests
};
inline constexpr std::array all_pair_rules = {PairRule::first_until_leaf, PairRule::alternating,
                                              PairRule::larger_volume, PairRule::larger_area, PairRule::all_children};
/// Returns the name in rows.
[[nodiscard]] std::string_view name_of(PairRule rule);

enum class PairQuestion : std::uint8_t {
    any,  ///< whether a pair of triangles touches; the walk ends at the first
    all,  ///< how many pairs of triangles touch
};

/// What a walk counts.
struct PairWork {
    std::uint64_t box_tests = 0;
    std::uint64_t triangle_tests = 0;
    std::uint64_t pairs = 0;  ///< of triangles that touch; 0 or 1 for PairQuestion::any

    PairWork& operator+=(const PairWork& more) {
        box_tests += more.box_tests;
        triangle_tests += more.triangle_tests;
        pairs += more.pairs;
        return *this;
    }
    friend bool operator==(const PairWork&, const PairWork&) = default;
};

/// Where the second tree is, seen from the first: computed once for a walk.
struct Placement {
    explicit Placement(const Transform& transform);

    float rotation[3][3];
    float magnitude[3][3];  ///< of the rotation's entries
    float shift[3];
    Pose exact;  ///< for triangles
};

/// A walk through two trees with a stack of pairs of nodes. Both answers are the same by every rule.
///
/// A pair of boxes is tested by the 15 axes of oriented boxes (Gottschalk, Lin, Manocha 1996).
class PairWalk {
public:
    PairWalk(const AabbTree& a, const AabbTree& b);

    [[nodiscard]] PairWork run(PairRule rule, PairQuestion question, const Placement& placement);

private:
    struct Entry {
        std::uint32_t a;
        std::uint32_t b;
        bool is_first_last;  ///< the first tree was the last to be descended
    };
    template <PairRule rule>
    PairWork walk(PairQuestion question, const Placement& placement);
    template <PairRule rule>
    std::size_t push_children(Entry at, const Placement& placement, std::size_t size, PairWork& work);
    void test_leaves(Entry at, PairQuestion question, const Placement& placement, PairWork& work) const;

    const AabbTree* a_;
    const AabbTree* b_;
    std::vector<Entry> stack_;
};

/// Tests all triangles of one against all of the other, without a tree.
[[nodiscard]] PairWork test_all_pairs(const AabbTree& a, const AabbTree& b, const Placement& placement);

}  // namespace espalier::bench
