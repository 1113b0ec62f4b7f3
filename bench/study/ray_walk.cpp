#include "aabb_tree.hpp"
#include "walks.hpp"

namespace espalier::bench {
namespace {

constexpr float no_entry = std::numeric_limits<float>::infinity();

/// One ray through a tree.
struct Search {
    Search(const AabbTree& searched, const Ray& ray, RayWork& counts) : tree(&searched), work(&counts) {
        const float from[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
        const float along[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
        for (int k = 0; k < 3; ++k) {
            // A direction of 0 along an axis becomes a very small one: 1 / 0 would lead to 0 times infinity.
            inverse[k] = 1.0f / std::copysign(std::max(std::abs(along[k]), 1e-18f), along[k]);
            origin[k] = from[k];
            magnitude[k] = std::abs(inverse[k]);
        }
        line = {point_of(ray.origin), point_of(ray.direction)};
    }
    /// Returns t where the ray enters the box, or infinity if it misses the box or enters it behind the hit.
    [[nodiscard]] float entry(const AabbNode& node) {
        ++work->box_tests;
        float begin = 0.0f, end = no_entry;
        for (int k = 0; k < 3; ++k) {
            const float middle = (node.center[k] - origin[k]) * inverse[k], reach = node.half[k] * magnitude[k];
            begin = std::max(begin, middle - reach);
            end = std::min(end, middle + reach);
        }
        if (begin > end) return no_entry;
        if (is_behind_hit(begin)) {
            ++work->skipped;
            return no_entry;
        }
        return begin;
    }
    [[nodiscard]] bool is_behind_hit(float begin) const { return static_cast<double>(begin) > nearest; }
    void test_leaf(const AabbNode& leaf) {
        work->triangle_tests += leaf.count;
        for (const FloatTriangle& triangle : tree->triangles_of(leaf))
            if (const auto at = meets(corners_of(triangle), line)) nearest = std::min(nearest, *at);
    }

    const AabbTree* tree;
    RayWork* work;
    float origin[3], inverse[3], magnitude[3];
    Line line;
    double nearest = std::numeric_limits<double>::infinity();
};

/// Visits the nearer child, then the other one. The entry of `index` is before the hit.
void recurse_nearest_first(Search& search, std::uint32_t index) {
    const AabbNode& node = search.tree->nodes[index];
    if (node.is_leaf()) {
        search.test_leaf(node);
        return;
    }
    std::uint32_t near = node.first, far = node.first + 1;
    float near_entry = search.entry(search.tree->nodes[near]), far_entry = search.entry(search.tree->nodes[far]);
    if (far_entry < near_entry) {
        std::swap(near, far);
        std::swap(near_entry, far_entry);
    }
    if (near_entry == no_entry) return;
    recurse_nearest_first(search, near);
    if (far_entry == no_entry) return;
    if (search.is_behind_hit(far_entry)) ++search.work->skipped;
    else recurse_nearest_first(search, far);
}

/// Returns whether the second child goes first.
template <RayOrder order>
bool is_second_first(float first_entry, float second_entry) {
    if constexpr (order == RayOrder::nearest_first) return second_entry < first_entry;
    else if constexpr (order == RayOrder::farthest_first) return second_entry > first_entry;
    else return false;
}

/// Visits nodes from the root on; of two children that the ray enters, one waits on the stack.
template <RayOrder order, class Stack>
void walk(Search& search, Stack& stack) {
    std::size_t size = 0;
    std::uint32_t index = 0;
    for (;;) {
        const AabbNode& node = search.tree->nodes[index];
        if (node.is_leaf()) {
            search.test_leaf(node);
        } else {
            const float first = search.entry(search.tree->nodes[node.first]);
            const float second = search.entry(search.tree->nodes[node.first + 1]);
            if (first != no_entry && second != no_entry) {
                const bool is_exchanged = is_second_first<order>(first, second);
                stack[size++] = {node.first + (is_exchanged ? 0u : 1u), is_exchanged ? first : second};
                index = node.first + (is_exchanged ? 1u : 0u);
                continue;
            }
            if (first != no_entry || second != no_entry) {
                index = node.first + (first != no_entry ? 0u : 1u);
                continue;
            }
        }
        // Back to the box that waits on top, unless the hit that was found since is nearer.
        while (size > 0 && search.is_behind_hit(stack[size - 1].entry)) {
            --size;
            ++search.work->skipped;
        }
        if (size == 0) return;
        index = stack[--size].node;
    }
}

}  // namespace

std::string_view name_of(RayOrder order) {
    constexpr const char* names[] = {"nearest_first", "nearest_recursed", "fixed", "farthest_first"};
    return names[static_cast<std::size_t>(order)];
}

RayWalk::RayWalk(const AabbTree& tree) : tree_(&tree), stack_(std::size_t{tree.height} + 1) {}

double RayWalk::closest(RayOrder order, const Ray& ray, RayWork& work) {
    Search search(*tree_, ray, work);
    if (search.entry(tree_->nodes[0]) == no_entry) return search.nearest;
    switch (order) {
        case RayOrder::nearest_first:
            walk<RayOrder::nearest_first>(search, stack_);
            break;
        case RayOrder::nearest_recursed:
            recurse_nearest_first(search, 0);
            break;
        case RayOrder::fixed:
            walk<RayOrder::fixed>(search, stack_);
            break;
        case RayOrder::farthest_first:
            walk<RayOrder::farthest_first>(search, stack_);
            break;
    }
    return search.nearest;
}

double closest_of_all(const AabbTree& tree, const Ray& ray) {
    const Line line = {point_of(ray.origin), point_of(ray.direction)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const FloatTriangle& triangle : tree.triangles)
        if (const auto at = meets(corners_of(triangle), line)) nearest = std::min(nearest, *at);
    return nearest;
}

}  // namespace espalier::bench
