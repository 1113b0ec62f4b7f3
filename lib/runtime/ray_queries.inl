// Rays: the tests of boxes and triangles in lanes, and the queries as visitors. Included once per instruction set, inside
// its namespace. Lanes only ever reject; what they let through is decided by ray_triangle.hpp.

/// A ray spread over lanes.
struct RayLanes {
    explicit RayLanes(const BlobData& blob, const LatticeRay& ray_)
        : ray(ray_), origin(ray_.origin_steps, blob.bits), tau_min(splat(ray_.tau_min)) {
        for (int k = 0; k < 3; ++k) {
            inverse[k] = splat(ray_.inverse[k]);
            const bool negative = ray_.direction[k] < 0;
            near_at[k] = (negative ? format::fast_node::hi_at : format::fast_node::lo_at) + 8 * static_cast<std::size_t>(k);
            far_at[k] = (negative ? format::fast_node::lo_at : format::fast_node::hi_at) + 8 * static_cast<std::size_t>(k);
        }
    }
    const LatticeRay& ray;
    FrameOrigin origin;
    Floats inverse[3];
    Floats tau_min;
    std::size_t near_at[3];  ///< of the planes through which the ray enters, within a node
    std::size_t far_at[3];
};

/// The children whose widened slab interval meets [tau_min, limit], and where each begins (Kay and Kajiya 1986).
inline unsigned slab_test(const FastNode& node, const RayLanes& ray, float limit, float* near) {
    const Frame frame = load_frame(node, ray.origin);
    const Floats slack = splat(interval_slack);
    const Floats limits = splat(limit);
    unsigned mask = 0;
    for (unsigned first = 0; first < format::max_children; first += lanes) {
        // base - origin is exact, so this rounds each plane once, fused or not, and the product once more.
        const auto plane = [&](std::size_t at, int k) {
            return multiply(multiply_add(bytes_to_floats(node.bytes + at + first), frame.scale[k], frame.offset[k]),
                            ray.inverse[k]);
        };
        // An axis along which the ray does not move gives -inf, +inf or, on the plane, no number: then the other operand.
        const Floats enter = larger(plane(ray.near_at[0], 0),
                                    larger(plane(ray.near_at[1], 1), larger(plane(ray.near_at[2], 2), ray.tau_min)));
        const Floats leave = smaller(plane(ray.far_at[0], 0),
                                     smaller(plane(ray.far_at[1], 1), smaller(plane(ray.far_at[2], 2), splat(infinity))));
        mask |= at_most(enter, smaller(multiply(leave, slack), limits)) << first;
        store(near + first, enter);
    }
    return mask & ((1u << (node.node_children() + node.leaf_children())) - 1u);
}

/// The triangles of a leaf that the ray may hit: those whose edges, seen along the ray, do not clearly exclude it.
/// Shearing the ray into an axis is from Woop, Benthin and Wald (2013); docs/numerics.md bounds the errors.
template <unsigned groups>
inline unsigned ray_candidates_of(const FastLeaf& leaf, const LatticeRay& ray) {
    const auto offset = [&](unsigned k) { return splat(static_cast<float>(leaf.anchor[k]) - ray.origin_steps[k]); };
    const unsigned kx = ray.axis[0], ky = ray.axis[1], kz = ray.axis[2];
    const Floats offset_x = offset(kx), offset_y = offset(ky), offset_z = offset(kz);
    const Floats shear_x = splat(ray.shear[0]), shear_y = splat(ray.shear[1]);
    Table<groups> xs, ys;
    Floats radius = splat(0.0f);
    for (unsigned group = 0; group < groups; ++group) {
        if (group * lanes >= leaf.vertex_count) break;
        const auto coordinate = [&](unsigned k, Floats from) {
            return add(to_floats(unpack(leaf.coordinates[k], leaf.width[k], group * lanes)), from);
        };
        const Floats z = coordinate(kz, offset_z);
        const Floats x = multiply_add(z, shear_x, coordinate(kx, offset_x));
        const Floats y = multiply_add(z, shear_y, coordinate(ky, offset_y));
        xs.set(group, x);
        ys.set(group, y);
        radius = larger(larger(magnitude(x), magnitude(y)), radius);
    }
    // Each sheared coordinate is off by at most the shear error, so each edge function by at most this.
    const float reach = largest(radius) + ray.shear_error;
    const float error = reach * (4.125f * ray.shear_error + reach * 0x1.2p-21f);
    const Floats above = splat(error), below = splat(-error);
    unsigned mask = 0;
    for (unsigned first = 0; first < leaf.triangle_count; first += lanes) {
        const Ints corners = unpack(leaf.triangles, 3 * leaf.corner_width, first);
        const Ints a = corner_of(corners, 0, leaf.corner_width);
        const Ints b = corner_of(corners, 1, leaf.corner_width);
        const Ints c = corner_of(corners, 2, leaf.corner_width);
        const Floats ax = xs.look_up(a), ay = ys.look_up(a);
        const Floats bx = xs.look_up(b), by = ys.look_up(b);
        const Floats cx = xs.look_up(c), cy = ys.look_up(c);
        const Floats u = multiply_subtract(bx, cy, multiply(by, cx));
        const Floats v = multiply_subtract(cx, ay, multiply(cy, ax));
        const Floats w = multiply_subtract(ax, by, multiply(ay, bx));
        mask |= (at_most(below, smaller(u, smaller(v, w))) | at_most(larger(u, larger(v, w)), above)) << first;
    }
    return mask & ((1u << leaf.triangle_count) - 1u);
}

inline unsigned ray_candidates(const FastLeaf& leaf, const LatticeRay& ray) {
    return with_table_groups(leaf.vertex_count, [&](auto groups) { return ray_candidates_of<groups>(leaf, ray); });
}

/// The closest hit; of equal ones the lowest index.
template <class Counters>
struct ClosestHit {
    RayLanes lanes_;
    const TriangleFilter* filter;
    FoundHit& best;
    Counters& counters;
    float limit_;
    bool found = false;

    [[nodiscard]] float limit() const { return limit_; }
    unsigned children(const FastNode& node, float* keys) {
        counters.count_node();
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit leaf(const FastLeaf& leaf) {
        unsigned candidates = ray_candidates(leaf, lanes_.ray);
        counters.count_leaf();
        counters.count_triangles(leaf.triangle_count);
        counters.count_candidates(static_cast<unsigned>(std::popcount(candidates)));
        for (; candidates != 0; candidates &= candidates - 1) {
            const auto number = static_cast<unsigned>(std::countr_zero(candidates));
            const LatticeTriangle triangle = leaf.triangle(number);
            float tau = 0.0f;
            if (!intersect(lanes_.ray, triangle, tau) || (found && tau > best.tau)) continue;
            const std::uint32_t index = leaf.first_triangle() + number;
            if (found && tau == best.tau && index > best.index) continue;
            if (filter != nullptr && !(*filter)(Triangle{index})) continue;
            best = {tau, index, triangle};
            found = true;
            // A hit at least as good has its box's interval begin at or before this (docs/numerics.md).
            limit_ = tau * interval_slack;
        }
        return keep_going;
    }
};

/// Hits in storage order, handed to a callable.
template <class OnHit>
struct EveryHit {
    RayLanes lanes_;
    OnHit on_hit;

    unsigned children(const FastNode& node, float* keys) {
        return slab_test(node, lanes_, lanes_.ray.tau_max * interval_slack, keys);
    }
    Visit leaf(const FastLeaf& leaf) {
        for (unsigned candidates = ray_candidates(leaf, lanes_.ray); candidates != 0; candidates &= candidates - 1) {
            const auto number = static_cast<unsigned>(std::countr_zero(candidates));
            FoundHit hit;
            hit.triangle = leaf.triangle(number);
            if (!intersect(lanes_.ray, hit.triangle, hit.tau)) continue;
            hit.index = leaf.first_triangle() + number;
            if (on_hit(hit) == stop) return stop;
        }
        return keep_going;
    }
};

template <class Counters>
inline bool closest_hit_counting(const BlobData& blob, const LatticeRay& ray, const TriangleFilter* filter, FoundHit& best,
                                 Counters& counters) {
    ClosestHit<Counters> visitor = {RayLanes(blob, ray), filter, best, counters, ray.tau_max * interval_slack};
    traverse_nearest_first(blob, visitor);
    return visitor.found;
}

bool closest_hit(const BlobData& blob, const LatticeRay& ray, const TriangleFilter* filter, FoundHit& best) {
    NoCounters counters;
    return closest_hit_counting(blob, ray, filter, best, counters);
}

bool any_hit(const BlobData& blob, const LatticeRay& ray, const TriangleFilter* filter) {
    const auto on_hit = [&](const FoundHit& hit) {
        return filter == nullptr || (*filter)(Triangle{hit.index}) ? stop : keep_going;
    };
    EveryHit<decltype(on_hit)> visitor = {RayLanes(blob, ray), on_hit};
    return !traverse_in_storage_order(blob, visitor);
}

bool every_hit(const BlobData& blob, const LatticeRay& ray, FunctionRef<Visit(const FoundHit&)> visit) {
    EveryHit<decltype(visit)> visitor = {RayLanes(blob, ray), visit};
    return traverse_in_storage_order(blob, visitor);
}
