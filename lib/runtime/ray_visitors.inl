// Rays: what the queries do at nodes and leaves. Included once per instruction set, inside its namespace, after
// ray_filter.inl.

/// The closest hit; of equal ones the lowest index. One type for each type of ray that callers give: each is then used
/// by one query, and a program that never calls that query does not pay for it.
template <class Leaf, class Caller, class Counters>
struct ClosestHit {
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& lanes_;
    const TriangleFilter* filter;
    Counters& counters;
    RayHit& best;  ///< the caller's, undivided
    Limit limit_ = window_limit(ray);
    std::uint32_t volume_bits = 0;  ///< of the best, a float; 0 while there is none

    [[nodiscard]] bool found() const { return volume_bits != 0; }
    [[nodiscard]] Limit limit() const { return limit_; }
    template <class Node>
    [[gnu::always_inline]] unsigned children(const Node& node, Keys keys) {
        counters.count_node();
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit visit_leaf(const PlaceOf<Leaf>& place) {
        RayLeaf<Leaf> leaf;
        auto candidates = ray_candidates(place, ray, leaf);
        counters.count_leaf();
        counters.count_triangles(leaf.triangle_count());
        counters.count_candidates(static_cast<unsigned>(std::popcount(candidates)));
        for (; candidates != 0; candidates &= candidates - 1)
            decide(leaf, static_cast<unsigned>(std::countr_zero(candidates)));
        return keep_going;
    }
    /// On the triangle in this slot, which lanes did not reject.
    template <class SomeLeaf>
    void decide(const SomeLeaf& leaf, unsigned slot) {
        TriangleHit hit;
        if (!hits_slot(leaf, slot, ray, hit)) return;
        // By their bits: neither is negative.
        const auto bits = [](float tau) { return std::bit_cast<std::int32_t>(tau); };
        const std::int32_t later = bits(hit.whole_tau) - bits(found() ? best.t : infinity);
        if (later > 0) return;
        const std::uint32_t index = owner_index(leaf, slot);
        // mutant(>= -> >) equivalent: the same triangle, again from a leaf with a copy, gives the same hit
        if (later == 0 && index >= best.triangle.index) return;
        if (filter != nullptr && !(*filter)(Triangle{index})) return;
        // Small cores load it again: what GCC keeps of it in registers takes 8 bytes of their stack.
        const TriangleHit& kept = small_code ? *as_if_changed(&hit) : hit;
        best = undivided(kept, index);
        volume_bits = std::bit_cast<std::uint32_t>(kept.volume);
        limit_ = hit_limit(ray, kept.whole_tau);
    }
    /// Once all of them are found.
    void finish(const Caller& world) const {
        divide_hit(best, std::bit_cast<float>(volume_bits));
        best.t = to_t(ray, best.t, world);
    }
};

/// The first few hits by t, of equal t by index. Boxes are culled by the last of them as soon as it is known that there
/// are more.
template <class Leaf>
struct FirstHitsOf {
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& lanes_;
    const TriangleFilter* filter;
    FirstHits& hits;
    Limit limit_ = window_limit(ray);

    [[nodiscard]] Limit limit() const { return limit_; }
    template <class Node>
    [[gnu::always_inline]] unsigned children(const Node& node, Keys keys) {
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit visit_leaf(const PlaceOf<Leaf>& place) {
        RayLeaf<Leaf> leaf;
        for (auto candidates = ray_candidates(place, ray, leaf); candidates != 0; candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            TriangleHit hit;
            if (!hits_slot(leaf, slot, ray, hit)) continue;
            const std::uint32_t index = owner_index(leaf, slot);
            if constexpr (Leaf::may_have_copies)
                if (hits.has(*leaf.blob, index)) continue;
            if (filter != nullptr && !(*filter)(Triangle{index})) continue;
            hits.offer(to_ray_hit(hit, index));
            if (!hits.has_overflowed()) continue;
            if (hits.is_empty()) return stop;
            limit_ = hit_limit(ray, hits.largest_key());
        }
        return keep_going;
    }
};

/// Whether there is any hit.
template <class Leaf>
struct AnyHit {
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& lanes_;
    Limit limit_ = window_limit(ray);

    template <class Node>
    [[gnu::always_inline]] unsigned children(const Node& node, Keys keys) {
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit visit_leaf(const PlaceOf<Leaf>& place) {
        RayLeaf<Leaf> leaf;
        for (auto candidates = ray_candidates(place, ray, leaf); candidates != 0; candidates &= candidates - 1)
            if (is_hit(leaf, static_cast<unsigned>(std::countr_zero(candidates)), ray)) return stop;
        return keep_going;
    }
};

/// Hits in storage order, handed to a callable.
template <class Leaf, class OnHit>
struct EveryHit {
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& lanes_;
    OnHit on_hit;
    Limit limit_ = window_limit(ray);

    template <class Node>
    [[gnu::always_inline]] unsigned children(const Node& node, Keys keys) {
        return slab_test(node, lanes_, limit_, keys);
    }
    Visit visit_leaf(const PlaceOf<Leaf>& place) {
        RayLeaf<Leaf> leaf;
        for (auto candidates = ray_candidates(place, ray, leaf); candidates != 0; candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            FoundHit found;
            if (!hits_slot(leaf, slot, ray, found.hit)) continue;
            found.index = owner_index(leaf, slot);
            if (on_hit(ray, found) == stop) return stop;
        }
        return keep_going;
    }
};
