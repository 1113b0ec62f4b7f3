#include "aabb_tree.hpp"
#include "walks.hpp"

namespace espalier::bench {
namespace {

/// Visits the nearer child, then the other one. The entry of `index` is before the hit.
void recurse_nearest_first(RaySearch<StoredAabb>& search, const Line& line, std::uint32_t index) {
    const AabbNode& node = search.tree.nodes[index];
    if (node.is_leaf()) {
        search.work->triangle_tests += node.count;
        for (const FloatTriangle& triangle : search.tree.tree->triangles_of(node))
            if (const auto at = meets(corners_of(triangle), line)) search.nearest = std::min(search.nearest, *at);
        return;
    }
    std::uint32_t near = node.first, far = node.first + 1;
    float near_entry = search.entry(near), far_entry = search.entry(far);
    if (far_entry < near_entry) {
        std::swap(near, far);
        std::swap(near_entry, far_entry);
    }
    if (near_entry == no_entry) return;
    recurse_nearest_first(search, line, near);
    if (far_entry == no_entry) return;
    if (search.is_behind_hit(far_entry)) ++search.work->skipped;
    else recurse_nearest_first(search, line, far);
}

}  // namespace

std::string_view name_of(RayOrder order) {
    constexpr const char* names[] = {"nearest_first", "nearest_recursed", "fixed", "farthest_first"};
    return names[static_cast<std::size_t>(order)];
}

double RayWalk::closest(RayOrder order, const Ray& ray, RayWork& work) {
    switch (order) {
        case RayOrder::nearest_recursed: {
            RaySearch<StoredAabb> search({tree_, tree_->nodes}, ray, work);
            const Line line = {point_of(ray.origin), point_of(ray.direction)};
            if (search.entry(0) != no_entry) recurse_nearest_first(search, line, 0);
            return search.nearest;
        }
        case RayOrder::fixed:
            return closest_by<RayOrder::fixed>(ray, work);
        case RayOrder::farthest_first:
            return closest_by<RayOrder::farthest_first>(ray, work);
        case RayOrder::nearest_first:
            break;
    }
    return closest_by(ray, work);
}

double closest_of_all(std::span<const FloatTriangle> triangles, const Ray& ray) {
    const Line line = {point_of(ray.origin), point_of(ray.direction)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const FloatTriangle& triangle : triangles)
        if (const auto at = meets(corners_of(triangle), line)) nearest = std::min(nearest, *at);
    return nearest;
}

std::size_t touching_of_all(std::span<const FloatTriangle> triangles, const Aabb& box) {
    const TriangleBoxTest test(box);
    return static_cast<std::size_t>(
        std::ranges::count_if(triangles, [&](const FloatTriangle& t) { return test.touches(corners_of(t)); }));
}

}  // namespace espalier::bench
