// Queries by distance where code is dearer than time: one visitor for all of them, which decides triangle by triangle.
#include <bit>

#include <runtime/point_queries.hpp>
#include <runtime/scalar_walk.hpp>
#include <runtime/small_boxes.hpp>

#if ESPALIER_SMALL_CODE

namespace espalier::detail::scalar {

#include <runtime/squared_distance.inl>
#include <runtime/node_boxes.inl>
#include <runtime/point_nodes.inl>

namespace {

using OnNear = FunctionRef<Visit(const FoundNearest&)>;
using OnSmallBox = FunctionRef<void(float lower, float upper)>;

/// What of the surface is within the radius, and near enough to matter, handed to a callable that may lower the limit.
struct NearTriangles {
    const LatticePoint& point;
    const BlobData& blob;
    OnNear on_near;
    std::uint32_t first = 0;        ///< storage index
    float limit_ = point.limit;     ///< squared; below 0: nothing more is of interest
    std::int32_t small_steps = -1;  ///< how long the boxes are that are not opened
    const OnSmallBox* on_small_box = nullptr;
    QueryCounters* counters = nullptr;

    [[nodiscard]] float limit() const { return limit_; }
    void lower_limit(float squared) { limit_ = minimum(squared * distance_slack, limit_); }

    template <class Node>
    unsigned children(const Node& node, float* keys) const {
        // mutant(never) work: no box is nearer than a limit below 0
        if (limit_ < 0.0f) return 0;
        if (counters != nullptr) counters->count_node();
        const unsigned mask = distance_test(node, point, blob, limit_, keys);
        // mutant(never) equivalent: no box is small then, since small_steps is -1
        if (on_small_box == nullptr) return mask;
        const unsigned small = mask & children_no_larger(node, small_steps, blob.bits);
        for (unsigned left = small; left != 0; left &= left - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(left));
            (*on_small_box)(keys[child], farthest_squared(node, blob.bits, child, point));
        }
        return limit_ < 0.0f ? 0 : mask & ~small;
    }
    template <class Leaf>
    Visit visit_leaf(const Leaf& leaf) const {
        if (scalar::storage_index(leaf, 0) + leaf.triangle_count() <= first) return keep_going;
        if (counters != nullptr) {
            counters->count_leaf();
            counters->count_triangles(leaf.triangle_count());
        }
        return scalar_walk::for_each_triangle_of(leaf, [&](unsigned slot, const LatticeTriangle& triangle) {
            if (!is_box_near(triangle)) return keep_going;
            const PointDistance distance = distance_to(point, triangle);
            // mutant(without 1) work: offers a triangle beyond the limit, which is not taken
            if (distance.squared > limit_ || !is_within_radius(point, distance, point.radius)) return keep_going;
            const std::uint32_t index = owner_index(leaf, slot);
            return index < first ? keep_going : on_near({distance, index, triangle});
        });
    }

private:
    [[nodiscard]] bool is_box_near(const LatticeTriangle& triangle) const {
        float squared = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const Span span = span_of(triangle, k);
            const float below = static_cast<float>(span.low) - point.steps[k];
            const float above = point.steps[k] - static_cast<float>(span.high);
            const float gap = maximum(maximum(below, above), 0.0f);
            squared += gap * gap;
        }
        return squared <= limit_;
    }
};

Visit walk_in_order(NearTriangles& near) {
    return scalar_walk::with_leaves_of(
        near.blob, [&]<class Leaf>() { return scalar_walk::traverse_in_storage_order<Leaf>(near.blob, near); });
}
void walk_nearest_first(NearTriangles& near) {
    scalar_walk::with_leaves_of(near.blob,
                                [&]<class Leaf>() { scalar_walk::traverse_nearest_first<Leaf>(near.blob, near); });
}

}  // namespace

bool every_overlap(const BlobData& blob, const LatticePoint& point, std::uint32_t first,
                   FunctionRef<Visit(Triangle)> visit) {
    const auto report = [&](const FoundNearest& found) { return visit(Triangle{found.index}); };
    NearTriangles near = {point, blob, report, first};
    return walk_in_order(near) == keep_going;
}

bool any_overlap(const BlobData& blob, const LatticePoint& point) {
    return !every_overlap(blob, point, 0, [](Triangle) { return stop; });
}

bool closest_triangle(const BlobData& blob, const LatticePoint& point, FoundNearest& best) {
    bool is_found = false;
    NearTriangles* visitor = nullptr;
    const auto keep_closest = [&](const FoundNearest& found) {
        // mutant(> -> >= 2) equivalent: the same triangle, again from a leaf with a copy, gives the same hit
        if (is_found && (found.distance.squared > best.distance.squared ||
                         (found.distance.squared == best.distance.squared && found.index > best.index)))
            return keep_going;
        best = found;
        is_found = true;
        visitor->lower_limit(found.distance.squared);
        return keep_going;
    };
    NearTriangles near = {point, blob, keep_closest};
    visitor = &near;
    walk_nearest_first(near);
    return is_found;
}

void closest_triangles(const BlobData& blob, const LatticePoint& point, ClosestFew& few) {
    NearTriangles* visitor = nullptr;
    const auto keep_few = [&](const FoundNearest& found) {
        // mutant(without 1) work: offers a triangle farther than all that are kept, which is not taken
        if ((few.is_full() && found.distance.squared > few.largest_key()) || few.has(blob, found.index))
            return keep_going;
        offer(blob, found, few);
        if (few.is_full()) visitor->lower_limit(few.largest_key());
        return keep_going;
    };
    NearTriangles near = {point, blob, keep_few};
    visitor = &near;
    walk_nearest_first(near);
}

bool may_overlap(const BlobData& blob, const LatticePoint& point, std::int32_t steps, QueryCounters& counters) {
    NearTriangles* visitor = nullptr;
    bool is_found = false;
    const auto stop_at_box = [&](float, float) {
        is_found = true;
        visitor->limit_ = -1.0f;
    };
    const OnSmallBox found_small_box = stop_at_box;
    const auto found_triangle = [&](const FoundNearest&) {
        is_found = true;
        return stop;
    };
    NearTriangles near = {point, blob, found_triangle, 0, point.limit, steps, &found_small_box, &counters};
    visitor = &near;
    walk_in_order(near);
    return is_found;
}

SquaredBounds closest_bounds(const BlobData& blob, const LatticePoint& point, std::int32_t steps,
                             QueryCounters& counters) {
    SquaredBounds bounds;
    NearTriangles* visitor = nullptr;
    const auto add = [&](float lower, float upper) {
        bounds.lower = minimum(lower, bounds.lower);
        bounds.upper = minimum(upper, bounds.upper);
        visitor->lower_limit(upper);
    };
    const OnSmallBox add_box = add;
    const auto add_triangle = [&](const FoundNearest& found) {
        add(found.distance.squared, found.distance.squared);
        return keep_going;
    };
    NearTriangles near = {point, blob, add_triangle, 0, point.limit, steps, &add_box, &counters};
    visitor = &near;
    walk_nearest_first(near);
    return bounds;
}

}  // namespace espalier::detail::scalar

#endif
