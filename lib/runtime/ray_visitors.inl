// Rays: the test of triangles in lanes, and what the queries do at nodes and leaves. Included once per instruction set,
// inside its namespace. Lanes only ever reject; what they let through is decided by ray_triangle.hpp.

/// What a leaf's coordinates count from, seen from the ray's origin.
template <class Leaf>
[[gnu::always_inline]] inline Corner corner_from_origin(const Leaf& leaf, const LatticeRay& ray) {
    Corner corner = load_low_corner(leaf.node, leaf.child(), *leaf.blob, ray.origin_steps);
    if (Leaf::may_have_copies && leaf.blob->copies != nullptr) {
        for (int k = 0; k < 3; ++k)
            if (leaf.counts_from_zero(k)) corner.at[k] = -ray.origin_steps[k];
    }
    return corner;
}

/// A bound on the error of a leaf's edge functions. A hit lies among the leaf's vertices, so the sheared coordinates of
/// a triangle that is hit are at most twice as large as the leaf; each is off by at most the shear error, and so each
/// edge function by at most this (docs/numerics.md).
template <class Leaf>
[[gnu::always_inline]] inline float edge_error(const Leaf& leaf, const LatticeRay& ray) {
    const float reach = 2.0f * static_cast<float>(leaf.size) + ray.shear_error;
    return reach * (4.125f * ray.shear_error + reach * 0x1.2p-21f);
}

/// The triangles, a lane each, that sheared edges do not clearly exclude; `above` and `below` are +error and -error.
template <class Sheared>
[[gnu::always_inline]] inline unsigned edges_allow(const Sheared& xs, const Sheared& ys, const CornerNumbers& corners,
                                                   Floats above, Floats below) {
    const Floats ax = xs.look_up(corners.a), ay = ys.look_up(corners.a);
    const Floats bx = xs.look_up(corners.b), by = ys.look_up(corners.b);
    const Floats cx = xs.look_up(corners.c), cy = ys.look_up(corners.c);
    const Floats u = multiply_subtract(bx, cy, multiply(by, cx));
    const Floats v = multiply_subtract(cx, ay, multiply(cy, ax));
    const Floats w = multiply_subtract(ax, by, multiply(ay, bx));
    return at_most(below, smaller(u, smaller(v, w))) | at_most(larger(u, larger(v, w)), above);
}

/// The triangles of a leaf that the ray may hit: those whose edges, seen along the ray, do not clearly exclude it.
/// Shearing the ray into an axis is from Woop, Benthin and Wald (2013); docs/numerics.md bounds the errors.
template <unsigned groups, class Leaf>
inline typename Leaf::Slots ray_candidates_of(const Leaf& leaf, const LatticeRay& ray) {
    const unsigned kx = ray.axis[0], ky = ray.axis[1], kz = ray.axis[2];
    const Corner corner = corner_from_origin(leaf, ray);
    const Floats offset_x = splat(corner.at[kx]), offset_y = splat(corner.at[ky]), offset_z = splat(corner.at[kz]);
    const Floats shear_x = splat(ray.shear[0]), shear_y = splat(ray.shear[1]);
    Table<groups> xs, ys;
    for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
        const auto coordinate = [&](unsigned k, Floats from) {
            return add(to_floats(unpack(leaf.coordinates[k], leaf.width[k], group * lanes)), from);
        };
        const Floats z = coordinate(kz, offset_z);
        xs.set(group, multiply_add(z, shear_x, coordinate(kx, offset_x)));
        ys.set(group, multiply_add(z, shear_y, coordinate(ky, offset_y)));
    }
    const float error = edge_error(leaf, ray);
    const Floats above = splat(error), below = splat(-error);
    typename Leaf::Slots mask = 0;
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const typename Leaf::Slots hit = edges_allow(xs, ys, corners.next(), above, below);
        mask |= hit << first;
    }
    return mask & leaf.used_slots();
}

template <class Leaf>
inline typename Leaf::Slots ray_candidates(const Leaf& leaf, const LatticeRay& ray) {
    return with_table_groups<Leaf::max_vertices>(leaf.vertex_count,
                                                 [&](auto groups) { return ray_candidates_of<groups>(leaf, ray); });
}

/// The closest hit; of equal ones the lowest index.
template <class Leaf, class Counters>
struct ClosestHit {
    const LatticeRay& ray;
    const RayLanes& lanes_;
    const TriangleFilter* filter;
    Counters& counters;
    float limit_ = ray.tau_max * interval_slack;
    bool found = false;
    FoundHit best = {};

    [[nodiscard]] float limit() const { return limit_; }
    [[gnu::always_inline]] unsigned children(const Node& node, float* keys) {
        counters.count_node();
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit visit_leaf(const Leaf& leaf) {
        auto candidates = ray_candidates(leaf, ray);
        counters.count_leaf();
        counters.count_triangles(leaf.triangle_count());
        counters.count_candidates(static_cast<unsigned>(std::popcount(candidates)));
        for (; candidates != 0; candidates &= candidates - 1)
            decide(leaf, static_cast<unsigned>(std::countr_zero(candidates)));
        return keep_going;
    }
    /// On the triangle in this slot, which lanes did not reject.
    void decide(const Leaf& leaf, unsigned slot) {
        TriangleHit hit;
        if (!intersect(ray, leaf.triangle(slot), hit) || (found && hit.whole_tau > best.hit.whole_tau)) return;
        const std::uint32_t index = owner_index(leaf, slot);
        if (found && hit.whole_tau == best.hit.whole_tau && index >= best.index) return;
        if (filter != nullptr && !(*filter)(Triangle{index})) return;
        best = {hit, index};
        found = true;
        limit_ = hit_limit(ray, hit.whole_tau);
    }
};

/// The first few hits by t, of equal t by index. Boxes are culled by the last of them as soon as it is known that there
/// are more.
template <class Leaf>
struct FirstHitsOf {
    const LatticeRay& ray;
    const RayLanes& lanes_;
    const TriangleFilter* filter;
    FirstHits& hits;
    float limit_ = ray.tau_max * interval_slack;

    [[nodiscard]] float limit() const { return limit_; }
    [[gnu::always_inline]] unsigned children(const Node& node, float* keys) {
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit visit_leaf(const Leaf& leaf) {
        for (auto candidates = ray_candidates(leaf, ray); candidates != 0; candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            TriangleHit hit;
            if (!intersect(ray, leaf.triangle(slot), hit)) continue;
            const std::uint32_t index = owner_index(leaf, slot);
            if (Leaf::may_have_copies && leaf.blob->copies != nullptr && hits.has(index)) continue;
            if (filter != nullptr && !(*filter)(Triangle{index})) continue;
            hits.offer(to_ray_hit(hit, index));
            if (!hits.has_overflowed()) continue;
            if (hits.has_no_places()) return stop;
            limit_ = hit_limit(ray, hits.last_tau());
        }
        return keep_going;
    }
};

/// Hits in storage order, handed to a callable.
template <class Leaf, class OnHit>
struct EveryHit {
    const LatticeRay& ray;
    const RayLanes& lanes_;
    OnHit on_hit;

    [[gnu::always_inline]] unsigned children(const Node& node, float* keys) {
        return slab_test(node, lanes_, ray.tau_max * interval_slack, keys);
    }
    Visit visit_leaf(const Leaf& leaf) {
        for (auto candidates = ray_candidates(leaf, ray); candidates != 0; candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            FoundHit found;
            if (!intersect(ray, leaf.triangle(slot), found.hit)) continue;
            found.index = owner_index(leaf, slot);
            if (on_hit(found) == stop) return stop;
        }
        return keep_going;
    }
};
