// A ray through a hierarchy: in which order the children of a node are visited.
#pragma once

#include "../volumes/volume_tests.hpp"
#include "aabb_tree.hpp"

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

/// A ray through a tree: what it has found so far, and where it enters volumes before that.
template <class Stored>
struct RaySearch {
    RaySearch(const NodesOfTree<Stored>& searched, const Ray& ray, RayWork& counts)
        : tree(searched), prepared(ray), work(&counts) {}

    /// Returns t where the ray enters the volume of a node, or infinity if it misses it or enters it behind the hit.
    [[nodiscard]] float entry(std::uint32_t node) {
        ++work->box_tests;
        const float begin = prepared.entry(tree.nodes[node]);
        if (begin == no_entry || !is_behind_hit(begin)) return begin;
        ++work->skipped;
        return no_entry;
    }
    [[nodiscard]] bool is_behind_hit(float begin) const { return static_cast<double>(begin) > nearest; }

    NodesOfTree<Stored> tree;
    PreparedRay<Stored> prepared;
    RayWork* work;
    double nearest = std::numeric_limits<double>::infinity();
};

/// Walks rays through a tree with volumes of one kind, with a stack: of two children that a ray enters, one waits.
template <class Stored>
class VolumeRayWalk {
public:
    explicit VolumeRayWalk(const NodesOfTree<Stored>& tree) : tree_(tree), stack_(std::size_t{tree.tree->height} + 1) {}

    /// Calls test_leaf(node, nearest), which lowers `nearest`, and visit(index) for each node whose volume is tested.
    /// Returns the last `nearest`.
    template <RayOrder order = RayOrder::nearest_first, class TestLeaf, class Visit>
    double walk(const Ray& ray, RayWork& work, const TestLeaf& test_leaf, const Visit& visit) {
        RaySearch<Stored> search(tree_, ray, work);
        const auto entry = [&](std::uint32_t node) {
            visit(node);
            return search.entry(node);
        };
        std::size_t size = 0;
        std::uint32_t index = 0;
        if (entry(index) == no_entry) return search.nearest;
        for (;;) {
            const VolumeNode<Stored>& node = tree_.nodes[index];
            if (node.is_leaf()) {
                test_leaf(node, search.nearest);
            } else {
                const float first = entry(node.first), second = entry(node.first + 1);
                if (first != no_entry && second != no_entry) {
                    const bool is_exchanged = is_second_first<order>(first, second);
                    stack_[size++] = {node.first + (is_exchanged ? 0u : 1u), is_exchanged ? first : second};
                    index = node.first + (is_exchanged ? 1u : 0u);
                    continue;
                }
                if (first != no_entry || second != no_entry) {
                    index = node.first + (first != no_entry ? 0u : 1u);
                    continue;
                }
            }
            // Back to the volume that waits on top, unless the hit that was found since is nearer.
            while (size > 0 && search.is_behind_hit(stack_[size - 1].entry)) {
                --size;
                ++work.skipped;
            }
            if (size == 0) return search.nearest;
            index = stack_[--size].node;
        }
    }

    /// Returns t of the closest hit, or infinity. A triangle is tested by "Fast, minimum storage ray/triangle
    /// intersection" (Möller, Trumbore 1997) in double.
    template <RayOrder order = RayOrder::nearest_first, class Visit>
    double closest_by(const Ray& ray, RayWork& work, const Visit& visit) {
        const Line line = {point_of(ray.origin), point_of(ray.direction)};
        const auto test_leaf = [&](const VolumeNode<Stored>& leaf, double& nearest) {
            work.triangle_tests += leaf.count;
            for (const FloatTriangle& triangle : tree_.tree->triangles_of(leaf))
                if (const auto at = meets(corners_of(triangle), line)) nearest = std::min(nearest, *at);
        };
        return walk<order>(ray, work, test_leaf, visit);
    }
    template <RayOrder order = RayOrder::nearest_first>
    double closest_by(const Ray& ray, RayWork& work) {
        return closest_by<order>(ray, work, [](std::uint32_t) {});
    }

private:
    /// Returns whether the second child goes first.
    template <RayOrder order>
    static bool is_second_first(float first_entry, float second_entry) {
        if constexpr (order == RayOrder::nearest_first) return second_entry < first_entry;
        else if constexpr (order == RayOrder::farthest_first) return second_entry > first_entry;
        else return false;
    }
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    NodesOfTree<Stored> tree_;
    std::vector<Waiting> stack_;
};

/// Finds the closest hit in a textbook tree. The answer is the same in every order.
class RayWalk : public VolumeRayWalk<StoredAabb> {
public:
    explicit RayWalk(const AabbTree& tree) : VolumeRayWalk({&tree, tree.nodes}), tree_(&tree) {}

    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] double closest(RayOrder order, const Ray& ray, RayWork& work);

private:
    const AabbTree* tree_;
};

/// Counts the triangles that touch something: `touches(triangle)`, of the leaves whose volumes `is_near(volume)`.
template <class Stored, class IsNear, class Touches>
std::uint64_t count_touching(const NodesOfTree<Stored>& tree, std::vector<std::uint32_t>& stack, RayWork& work,
                             const IsNear& is_near, const Touches& touches) {
    std::uint64_t touching = 0;
    stack.assign(1, 0);
    while (!stack.empty()) {
        const VolumeNode<Stored>& node = tree.nodes[stack.back()];
        stack.pop_back();
        ++work.box_tests;
        if (!is_near(node)) continue;
        if (!node.is_leaf()) {
            stack.push_back(node.first + 1);
            stack.push_back(node.first);
            continue;
        }
        work.triangle_tests += node.count;
        for (const FloatTriangle& triangle : tree.tree->triangles_of(node))
            touching += touches(corners_of(triangle)) ? 1u : 0u;
    }
    return touching;
}

// A test of all triangles, without a tree.

/// Returns t of the closest hit, or infinity.
[[nodiscard]] double closest_of_all(std::span<const FloatTriangle> triangles, const Ray& ray);
/// Counts the triangles that touch the box.
[[nodiscard]] std::size_t touching_of_all(std::span<const FloatTriangle> triangles, const Aabb& box);

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

inline void place(const Placement& placement, const float* p, float* to) {
    for (int i = 0; i < 3; ++i) to[i] = dot3(placement.rotation[i], p) + placement.shift[i];
}

/// Tests the 15 axes that can separate two boxes (Gottschalk, Lin, Manocha 1996): three of each, and the cross products
/// of these. `r` turns from the axes of b to those of a, `m` has its magnitudes, and `t` leads to the center of b.
/// Edges that are almost parallel have a cross product that is almost zero; a margin of the boxes, or of `m`, covers
/// what is left of it.
inline bool boxes_touch(const float (&half_a)[3], const float (&half_b)[3], const float (&r)[3][3],
                        const float (&m)[3][3], const float (&t)[3]) {
    for (int i = 0; i < 3; ++i)
        if (std::abs(t[i]) > half_a[i] + dot3(m[i], half_b)) return false;
    for (int j = 0; j < 3; ++j)
        if (std::abs(t[0] * r[0][j] + t[1] * r[1][j] + t[2] * r[2][j]) >
            half_b[j] + m[0][j] * half_a[0] + m[1][j] * half_a[1] + m[2][j] * half_a[2])
            return false;
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            if (std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]) >
                half_a[i1] * m[i2][j] + half_a[i2] * m[i1][j] + half_b[j1] * m[i][j2] + half_b[j2] * m[i][j1])
                return false;
        }
    }
    return true;
}

/// Tests triangles of two trees, of which the second is placed. PairQuestion::any ends at the first pair that touches.
class TrianglePairTest {
public:
    TrianglePairTest(const AabbTree& a, const AabbTree& b, const Placement& placement, PairQuestion question)
        : placement_(&placement), question_(question) {
        const float* t = placement.shift;
        largest_ = static_cast<double>(
            std::max(a.largest, 2.0f * b.largest + std::abs(t[0]) + std::abs(t[1]) + std::abs(t[2])));
    }
    void test(std::span<const FloatTriangle> of_a, std::span<const FloatTriangle> of_b, PairWork& work) const;
    /// Returns whether nothing is left to be tested.
    [[nodiscard]] bool is_over(const PairWork& work) const { return question_ == PairQuestion::any && work.pairs > 0; }

private:
    const Placement* placement_;
    PairQuestion question_;
    double largest_;  ///< no coordinate of both trees exceeds it
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

    const AabbTree* a_;
    const AabbTree* b_;
    std::vector<Entry> stack_;
};

/// Tests all triangles of one against all of the other, without a tree.
[[nodiscard]] PairWork test_all_pairs(const AabbTree& a, const AabbTree& b, const Placement& placement);

}  // namespace espalier::bench
