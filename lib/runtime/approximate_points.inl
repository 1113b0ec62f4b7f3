// Spheres and closest points that stop at small boxes. Included once per instruction set, inside its namespace, after
// point_queries.inl.

/// Whether anything is within the radius, or a small box is.
template <class Leaf, class OnOverlap>
struct MayOverlap {
    EveryOverlap<Leaf, OnOverlap> exactly;
    std::int32_t steps;
    QueryCounters& counters;
    bool found = false;

    template <class Node>
    unsigned children(const Node& node, float* keys) {
        if (found) return 0;
        counters.count_node();
        const unsigned mask = exactly.children(node, keys);
        found = (mask & children_no_larger(node, steps, exactly.blob.bits)) != 0;
        return found ? 0 : mask;
    }
    Visit visit_leaf(const Leaf& leaf) {
        counters.count_leaf();
        counters.count_triangles(leaf.triangle_count());
        found = exactly.visit_leaf(leaf) == stop;
        return found ? stop : keep_going;
    }
};

/// The least distance of any triangle or small box, and the least of which one can say that something is as near. Both
/// are the same in whatever order they are found: what has one of them is never farther than any upper bound.
template <class Leaf>
struct ClosestBounds {
    const LatticePoint& point;
    const BlobData& blob;
    std::int32_t steps;
    QueryCounters& counters;
    float limit_;
    SquaredBounds bounds = {};

    [[nodiscard]] float limit() const { return limit_; }
    template <class Node>
    unsigned children(const Node& node, float* keys) {
        counters.count_node();
        const unsigned mask = distance_test(node, point, blob, limit_, keys);
        const unsigned small = mask & children_no_larger(node, steps, blob.bits);
        for (unsigned left = small; left != 0; left &= left - 1) {
            const auto child = static_cast<unsigned>(std::countr_zero(left));
            add(keys[child], farthest_squared(node, blob.bits, child, point));
        }
        return mask & ~small;
    }
    Visit visit_leaf(const Leaf& leaf) {
        counters.count_leaf();
        counters.count_triangles(leaf.triangle_count());
        decide_nearest_first(
            leaf, point, [&] { return limit_; },
            [&](unsigned slot) {
                const PointDistance distance = distance_to(point, leaf.triangle(slot));
                if (is_within_radius(point, distance, point.radius)) add(distance.squared, distance.squared);
            });
        return keep_going;
    }
    void add(float lower, float upper) {
        bounds.lower = minimum(lower, bounds.lower);
        bounds.upper = minimum(upper, bounds.upper);
        limit_ = minimum(upper * distance_slack, limit_);
    }
};

bool may_overlap(const BlobData& blob, const LatticePoint& point, std::int32_t steps, QueryCounters& counters) {
    const auto at_once = [](Triangle) { return stop; };
    return with_leaves_of(blob, [&]<class Leaf>() {
        MayOverlap<Leaf, decltype(at_once)> visitor = {{point, blob, 0, at_once}, steps, counters};
        traverse_in_storage_order<Leaf>(blob, visitor);
        return visitor.found;
    });
}

SquaredBounds closest_bounds(const BlobData& blob, const LatticePoint& point, std::int32_t steps,
                             QueryCounters& counters) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        ClosestBounds<Leaf> visitor = {point, blob, steps, counters, point.limit};
        traverse_nearest_first<Leaf>(blob, visitor);
        return visitor.bounds;
    });
}
