// Rays that stop at small boxes. Included once per instruction set, inside its namespace, after ray_queries.inl.

namespace {

template <class Leaf>
struct MayHit {
    const BlobData& blob;
    const LatticeRay& ray;
    const RayLanesOf<typename Leaf::Node>& lanes_;
    std::int32_t steps;
    QueryCounters& counters;
    Limit limit_ = window_limit(ray);
    bool found = false;

    template <class Node>
    [[gnu::always_inline]] unsigned children(const Node& node, Keys keys) {
        if (found) return 0;
        counters.count_node();
        const unsigned mask = slab_test(node, lanes_, limit_, keys);
        const unsigned small = mask & children_no_larger(node, steps, blob.bits);
        bool passes = false;
        for (unsigned left = small; left != 0 && !passes; left &= left - 1)
            passes = passes_through(ray, node, blob.bits, static_cast<unsigned>(std::countr_zero(left)));
        found = passes && passes_down_to(ray, blob, node);
        return found ? 0 : mask & ~small;
    }
    Visit visit_leaf(const PlaceOf<Leaf>& place) {
        RayLeaf<Leaf> leaf;
        auto candidates = ray_candidates(place, ray, leaf);
        counters.count_leaf();
        counters.count_triangles(leaf.triangle_count());
        for (; candidates != 0; candidates &= candidates - 1) {
            found = is_hit(leaf, static_cast<unsigned>(std::countr_zero(candidates)), ray);
            if (found) return stop;
        }
        return keep_going;
    }
};

}  // namespace

bool may_hit(const BlobData& blob, const Ray& world, std::int32_t steps, QueryCounters& counters) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (!prepare(blob, world, prepared)) return false;
        MayHit<Leaf> visitor = {blob, prepared.ray, prepared.lanes(), steps, counters};
        (void)walk_in_storage_order<PlaceOf<Leaf>>(blob, visitor);
        return visitor.found;
    });
}
