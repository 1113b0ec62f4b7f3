// Spheres and closest points: the tests of triangles in lanes, and the queries as visitors. Included once per
// instruction set, inside its namespace. Lanes reject what is clearly too far away and accept what is clearly near
// enough; what they leave open is decided by point_triangle.hpp.

/// Calls `on_group(first slot, corners)` for a leaf's triangles.
template <unsigned groups, class Leaf, class OnGroup>
[[gnu::always_inline]] inline void for_each_group_of(const Leaf& leaf, const LatticePoint& point, OnGroup on_group) {
    Table<groups> coordinates[3];
    for (unsigned k = 0; k < 3; ++k) {
        const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
        const Floats from = splat(point.steps[k]);
        for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
            coordinates[k].set(group, subtract(to_floats(add(offsets_of(leaf, k, group), anchor)), from));
        }
    }
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const auto numbers = corners.next();
        const auto look_up = [&](const Numbers& number) {
            return Floats3{coordinates[0].look_up(number), coordinates[1].look_up(number),
                           coordinates[2].look_up(number)};
        };
        on_group(first, CornersFromPoint{look_up(numbers.a), look_up(numbers.b), look_up(numbers.c)});
    }
}

/// Boxes of triangles, seen from the point.
struct BoxesFromPoint {
    Floats low[3], high[3];
    explicit BoxesFromPoint(const CornersFromPoint& t) {
        const auto set = [&](int k, Floats a, Floats b, Floats c) {
            low[k] = smaller(a, smaller(b, c));
            high[k] = larger(a, larger(b, c));
        };
        set(0, t.a.x, t.b.x, t.c.x);
        set(1, t.a.y, t.b.y, t.c.y);
        set(2, t.a.z, t.b.z, t.c.z);
    }
    /// At least the sum of the absolute coordinates of any corner.
    [[nodiscard]] Floats reach() const {
        Floats sum = splat(0.0f);
        for (int k = 0; k < 3; ++k) sum = add(sum, larger(high[k], negate(low[k])));
        return sum;
    }
};

/// The triangles of a leaf that may be within the point's radius, and those with a corner that clearly is.
template <class Slots>
struct OverlapCandidates {
    Slots near = 0;
    Slots inside = 0;
};
template <unsigned groups, class Leaf>
inline OverlapCandidates<typename Leaf::Slots> overlap_candidates_of(const Leaf& leaf, const LatticePoint& point) {
    using Slots = typename Leaf::Slots;
    OverlapCandidates<Slots> candidates;
    for_each_group_of<groups>(leaf, point, [&](unsigned first, const CornersFromPoint& t) {
        const BoxesFromPoint boxes(t);
        candidates.near |= Slots{at_most(squared_distance(boxes.low, boxes.high), splat(point.limit))} << first;
        const Floats nearest_corner = smaller(dot(t.a, t.a), smaller(dot(t.b, t.b), dot(t.c, t.c)));
        candidates.inside |= Slots{at_most(nearest_corner, splat(point.inner_limit))} << first;
    });
    candidates.near &= leaf.used_slots();
    return candidates;
}

/// Overlapping triangles in storage order, from storage index `first` on, handed to a callable.
template <class Leaf, class OnOverlap>
struct EveryOverlap {
    using Slots = typename Leaf::Slots;

    const LatticePoint& point;
    const BlobData& blob;
    std::uint32_t first;
    OnOverlap on_overlap;
    unsigned inside = 0;  ///< the children of the node at hand that are, box and all

    template <class Node>
    unsigned children(const Node& node, float*) {
        return overlap_test(node, point, blob, inside);
    }
    Visit visit_leaf(const Leaf& leaf) {
        // mutant(without 1, != -> true) equivalent: every leaf ends after 0
        if (first != 0 && storage_index(leaf, 0) + leaf.triangle_count() <= first) return keep_going;
        OverlapCandidates<Slots> candidates = {leaf.used_slots(), ~Slots{0}};
        // mutant(== -> true) work: tests each triangle of a box that is wholly inside, with the same result
        if ((inside >> leaf.child() & 1u) == 0)
            candidates = with_table_groups<Leaf::max_vertices>(
                leaf.vertex_count, [&](auto groups) { return overlap_candidates_of<groups>(leaf, point); });
        for (; candidates.near != 0; candidates.near &= candidates.near - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates.near));
            if ((candidates.inside >> slot & 1u) == 0 &&
                !is_within_radius(point, distance_to(point, leaf.triangle(slot)), point.radius))
                continue;
            const std::uint32_t index = storage_index(leaf, slot);
            if (index >= first && on_overlap(Triangle{index}) == stop) return stop;
        }
        return keep_going;
    }
};

/// What lanes tell of the triangles of a leaf that may be within a limit: a lower bound of each squared distance, and
/// about what their sides give.
template <class Leaf>
struct LeafDistances {
    static constexpr unsigned room = (Leaf::max_slots + lanes - 1) / lanes * lanes;
    float lower[room];
    float to_sides[room];

    /// Which triangles these are; the others' places stay as they are.
    template <unsigned groups>
    [[gnu::noinline]] typename Leaf::Slots fill(const Leaf& leaf, const LatticePoint& point, float limit) {
        typename Leaf::Slots near = 0;
        for_each_group_of<groups>(leaf, point, [&](unsigned first, const CornersFromPoint& t) {
            const BoxesFromPoint boxes(t);
            const Floats to_box = squared_distance(boxes.low, boxes.high);
            // mutant(never) work: tests triangles whose boxes are too far, with the same result
            if (at_most(to_box, splat(limit)) == 0) return;
            Floats bound = to_box;
            Floats squared_to_sides;
            if constexpr (lanes == 1)  // a bound costs as much as a decision
                squared_to_sides = smaller(dot(t.a, t.a), smaller(dot(t.b, t.b), dot(t.c, t.c)));
            else bound = larger(lower_bound(t, boxes.reach(), squared_to_sides), to_box);
            store(lower + first, bound);
            store(to_sides + first, squared_to_sides);
            near |= typename Leaf::Slots{at_most(bound, splat(limit))} << first;
        });
        return near & leaf.used_slots();
    }
};

/// Calls `decide(slot)` for the triangles of a leaf that may be within the limit, which the calls may lower; the one
/// with the nearest side comes first, since it lowers it most.
template <class Leaf, class Limit, class Decide>
[[gnu::always_inline]] inline void decide_nearest_first(const Leaf& leaf, const LatticePoint& point, Limit limit,
                                                        Decide decide) {
    LeafDistances<Leaf> distances;
    auto near = with_table_groups<Leaf::max_vertices>(
        leaf.vertex_count, [&](auto groups) { return distances.template fill<groups>(leaf, point, limit()); });
    if (near == 0) return;
    auto first = static_cast<unsigned>(std::countr_zero(near));
    // mutant(- -> right side dropped 1) equivalent: compares the first with itself too
    for (auto others = near & (near - 1); others != 0; others &= others - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(others));
        if (distances.to_sides[slot] < distances.to_sides[first]) first = slot;
    }
    decide(first);
    near &= ~(typename Leaf::Slots{1} << first);
    for (; near != 0; near &= near - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(near));
        if (distances.lower[slot] <= limit()) decide(slot);
    }
}

/// The closest triangle; of equal ones the lowest index.
template <class Leaf>
struct ClosestTriangle {
    const LatticePoint& point;
    const BlobData& blob;
    FoundNearest& best;
    float limit_;
    bool found = false;

    [[nodiscard]] float limit() const { return limit_; }
    template <class Node>
    unsigned children(const Node& node, float* keys) {
        return distance_test(node, point, blob, limit_, keys);
    }
    Visit visit_leaf(const Leaf& leaf) {
        decide_nearest_first(
            leaf, point, [&] { return limit_; }, [&](unsigned slot) { decide(leaf, slot); });
        return keep_going;
    }
    void decide(const Leaf& leaf, unsigned slot) {
        const LatticeTriangle triangle = leaf.triangle(slot);
        const PointDistance distance = distance_to(point, triangle);
        if (found && distance.squared > best.distance.squared) return;
        if (!is_within_radius(point, distance, point.radius)) return;
        const std::uint32_t index = owner_index(leaf, slot);
        // mutant(> -> >=) equivalent: the same triangle, again from a leaf with a copy, gives the same hit
        if (found && distance.squared == best.distance.squared && index > best.index) return;
        best = {distance, index, triangle};
        found = true;
        limit_ = minimum(distance.squared * distance_slack, limit_);
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
    template <class Node>
    unsigned children(const Node& node, float* keys) {
        return distance_test(node, point, blob, limit_, keys);
    }
    Visit visit_leaf(const Leaf& leaf) {
        decide_nearest_first(
            leaf, point, [&] { return limit_; }, [&](unsigned slot) { decide(leaf, slot); });
        return keep_going;
    }
    void decide(const Leaf& leaf, unsigned slot) {
        FoundNearest found;
        found.triangle = leaf.triangle(slot);
        found.distance = distance_to(point, found.triangle);
        // mutant(never) work: offers a triangle farther than all that are kept, which is not taken
        if (few.is_full() && found.distance.squared > few.largest_key()) return;
        if (!is_within_radius(point, found.distance, point.radius)) return;
        found.index = owner_index(leaf, slot);
        if (few.has(blob, found.index)) return;
        offer(blob, found, few);
        if (few.is_full()) limit_ = minimum(few.largest_key() * distance_slack, limit_);
    }
};

/// True when the callable stopped it.
template <class OnOverlap>
inline bool visit_every_overlap(const BlobData& blob, const LatticePoint& point, std::uint32_t first,
                                OnOverlap on_overlap) {
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
