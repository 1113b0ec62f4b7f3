// Spheres and closest points: the test of triangles' boxes in lanes, and the queries as visitors. Included once per
// instruction set, inside its namespace. Lanes only ever reject; what they let through is decided by point_triangle.hpp.

/// The triangles of a leaf whose box is within the limit.
template <unsigned groups, class Leaf>
inline typename Leaf::Slots point_candidates_of(const Leaf& leaf, const LatticePoint& point, float limit) {
    Table<groups> coordinates[3];
    for (unsigned k = 0; k < 3; ++k) {
        const Floats anchor = splat(static_cast<float>(leaf.anchor(static_cast<int>(k))));
        const Floats from = splat(point.steps[k]);
        for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
            const Floats offset = to_floats(unpack(leaf.coordinates[k], leaf.width[k], group * lanes));
            coordinates[k].set(group, subtract(add(offset, anchor), from));
        }
    }
    typename Leaf::Slots mask = 0;
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const auto [a, b, c] = corners.next();
        Floats low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            const Floats at_a = coordinates[k].look_up(a), at_b = coordinates[k].look_up(b),
                         at_c = coordinates[k].look_up(c);
            low[k] = smaller(at_a, smaller(at_b, at_c));
            high[k] = larger(at_a, larger(at_b, at_c));
        }
        mask |= typename Leaf::Slots{at_most(squared_distance(low, high), splat(limit))} << first;
    }
    return mask & leaf.used_slots();
}

template <class Leaf>
inline typename Leaf::Slots point_candidates(const Leaf& leaf, const LatticePoint& point, float limit) {
    return with_table_groups<Leaf::max_vertices>(
        leaf.vertex_count, [&](auto groups) { return point_candidates_of<groups>(leaf, point, limit); });
}

/// Overlapping triangles in storage order, from storage index `first` on, handed to a callable.
template <class Leaf, class OnOverlap>
struct EveryOverlap {
    const LatticePoint& point;
    const BlobData& blob;
    std::uint32_t first;
    OnOverlap on_overlap;

    unsigned children(const Node& node, float* keys) { return distance_test(node, point, blob, point.limit, keys); }
    Visit visit_leaf(const Leaf& leaf) {
        if (first != 0 && storage_index(leaf, 0) + leaf.triangle_count() <= first) return keep_going;
        for (auto candidates = point_candidates(leaf, point, point.limit); candidates != 0;
             candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            if (!is_within_radius(point, distance_to(point, leaf.triangle(slot)), point.radius)) continue;
            const std::uint32_t index = storage_index(leaf, slot);
            if (index >= first && on_overlap(Triangle{index}) == stop) return stop;
        }
        return keep_going;
    }
};

/// The closest triangle; of equal ones the lowest index.
template <class Leaf>
struct ClosestTriangle {
    const LatticePoint& point;
    const BlobData& blob;
    FoundNearest& best;
    float limit_;
    bool found = false;

    [[nodiscard]] float limit() const { return limit_; }
    unsigned children(const Node& node, float* keys) { return distance_test(node, point, blob, limit_, keys); }
    Visit visit_leaf(const Leaf& leaf) {
        for (auto candidates = point_candidates(leaf, point, limit_); candidates != 0;
             candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            const LatticeTriangle triangle = leaf.triangle(slot);
            const PointDistance distance = distance_to(point, triangle);
            if (found && distance.squared > best.distance.squared) continue;
            if (!is_within_radius(point, distance, point.radius)) continue;
            const std::uint32_t index = owner_index(leaf, slot);
            if (found && distance.squared == best.distance.squared && index > best.index) continue;
            best = {distance, index, triangle};
            found = true;
            limit_ = minimum(distance.squared * distance_slack, limit_);
        }
        return keep_going;
    }
};

/// The few closest triangles.
template <class Leaf>
struct ClosestTriangles {
    const LatticePoint& point;
    const BlobData& blob;
    ClosestFew& few;
    float limit_;

    [[nodiscard]] float limit() const { return limit_; }
    unsigned children(const Node& node, float* keys) { return distance_test(node, point, blob, limit_, keys); }
    Visit visit_leaf(const Leaf& leaf) {
        for (auto candidates = point_candidates(leaf, point, limit_); candidates != 0;
             candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            FoundNearest found;
            found.triangle = leaf.triangle(slot);
            found.distance = distance_to(point, found.triangle);
            if (few.is_full() && found.distance.squared > few.last()) continue;
            if (!is_within_radius(point, found.distance, point.radius)) continue;
            found.index = owner_index(leaf, slot);
            if (few.has(found.index)) continue;
            few.offer(found);
            if (few.is_full()) limit_ = minimum(few.last() * distance_slack, limit_);
        }
        return keep_going;
    }
};

/// True when the callable stopped it.
template <class OnOverlap>
inline bool visit_every_overlap(const BlobData& blob, const LatticePoint& point, std::uint32_t first, OnOverlap on_overlap) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        EveryOverlap<Leaf, OnOverlap> visitor = {point, blob, first, on_overlap};
        return traverse_in_storage_order<Leaf>(blob, visitor) == stop;
    });
}

bool any_overlap(const BlobData& blob, const LatticePoint& point) {
    return visit_every_overlap(blob, point, 0, [](Triangle) { return stop; });
}

bool every_overlap(const BlobData& blob, const LatticePoint& point, std::uint32_t first,
                   FunctionRef<Visit(Triangle)> visit) {
    return !visit_every_overlap(blob, point, first, visit);
}

bool closest_triangle(const BlobData& blob, const LatticePoint& point, FoundNearest& best) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        ClosestTriangle<Leaf> visitor = {point, blob, best, point.limit};
        traverse_nearest_first<Leaf>(blob, visitor);
        return visitor.found;
    });
}

void closest_triangles(const BlobData& blob, const LatticePoint& point, ClosestFew& few) {
    with_leaves_of(blob, [&]<class Leaf>() {
        ClosestTriangles<Leaf> visitor = {point, blob, few, point.limit};
        traverse_nearest_first<Leaf>(blob, visitor);
    });
}
