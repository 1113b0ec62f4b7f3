// Rays: the queries. Included once per instruction set, inside its namespace, after traverse.inl and ray_visitors.inl.

namespace {

template <class Node>
using PreparedRayOf = PreparedRayIn<RayLanesOf<Node>>;

/// One function for each kind of leaf, the walk inside of it: one frame on the stack. For a Ray or a RayOnLattice.
template <class Leaf, class Caller, class Counters>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline bool closest_hit_in(const BlobData& blob, const Caller& world, RayHit& hit,
                                                         const TriangleFilter* filter, Counters& counters) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (!prepare(blob, world, prepared)) return false;
    ClosestHit<Leaf, Caller, Counters> visitor = {prepared.ray, prepared.lanes(), filter, counters, hit};
    traverse_nearest_first<PlaceOf<Leaf>>(blob, visitor);
    if (!visitor.found()) return false;
    visitor.finish(world);
    return true;
}

template <class Caller, class Counters>
[[gnu::always_inline]] inline bool closest_hit_counting(const BlobData& blob, const Caller& world, RayHit& hit,
                                                        const TriangleFilter* filter, Counters& counters) {
    return with_leaves_of(
        blob, [&]<class Leaf>()
                  __attribute__((always_inline)) { return closest_hit_in<Leaf>(blob, world, hit, filter, counters); });
}

/// The same. True when the callable, which is told of the ray and the hit, stopped it.
template <class Leaf, class Caller, class OnHit>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline bool every_hit_in(const BlobData& blob, const Caller& world, OnHit on_hit) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (!prepare(blob, world, prepared)) return false;
    EveryHit<Leaf, OnHit> visitor = {prepared.ray, prepared.lanes(), on_hit};
    return walk_in_storage_order<PlaceOf<Leaf>>(blob, visitor) == stop;
}
template <class Caller, class OnHit>
[[gnu::always_inline]] inline bool visit_every_hit(const BlobData& blob, const Caller& world, OnHit on_hit) {
    return with_leaves_of(
        blob, [&]<class Leaf>() __attribute__((always_inline)) { return every_hit_in<Leaf>(blob, world, on_hit); });
}

/// Whether there is any hit, whichever it is.
template <class Leaf, class Caller>
ESPALIER_FOR_ONE_KIND_OF_LEAF inline bool any_hit_in(const BlobData& blob, const Caller& world) {
    PreparedRayOf<typename Leaf::Node> prepared;
    if (!prepare(blob, world, prepared)) return false;
    AnyHit<Leaf> visitor = {prepared.ray, prepared.lanes()};
    return walk_in_storage_order<PlaceOf<Leaf>>(blob, visitor) == stop;
}
template <class Caller>
[[gnu::always_inline]] inline bool find_any_hit(const BlobData& blob, const Caller& world) {
    return with_leaves_of(
        blob, [&]<class Leaf>() __attribute__((always_inline)) { return any_hit_in<Leaf>(blob, world); });
}

}  // namespace

bool closest_hit(const BlobData& blob, const Ray& world, RayHit& hit, const TriangleFilter* filter) {
    return closest_hit_counting(blob, world, hit, filter, no_counters);
}

HitCount first_hits(const BlobData& blob, const Ray& world, std::span<RayHit> hits, const TriangleFilter* filter) {
    return with_leaves_of(blob, [&]<class Leaf>() -> HitCount {
        PreparedRayOf<typename Leaf::Node> prepared;
        if (!prepare(blob, world, prepared)) return {};
        FirstHits first(hits);
        FirstHitsOf<Leaf> visitor = {prepared.ray, prepared.lanes(), filter, first};
        traverse_nearest_first<PlaceOf<Leaf>>(blob, visitor);
        const std::span<RayHit> found = first.sorted();
        for (RayHit& hit : found) hit.t = to_t(prepared.ray, hit.t, world);
        return {found.size(), first.has_overflowed() ? QueryStatus::output_full : QueryStatus::ok};
    });
}

bool any_hit(const BlobData& blob, const Ray& world, const TriangleFilter* filter) {
    if constexpr (decides_by_signs)
        if (filter == nullptr) return find_any_hit(blob, world);
    return visit_every_hit(blob, world, [filter](const LatticeRay&, const FoundHit& found) {
        return filter == nullptr || (*filter)(Triangle{found.index}) ? stop : keep_going;
    });
}

bool every_hit(const BlobData& blob, const Ray& world, FunctionRef<Visit(const RayHit&)> visit) {
    return !visit_every_hit(blob, world, [&](const LatticeRay& ray, const FoundHit& found) {
        return visit(to_ray_hit(ray, world, found.hit, found.index));
    });
}

bool closest_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray, RayHit& hit) {
    return closest_hit_counting(blob, ray, hit, nullptr, no_counters);
}

bool any_hit_on_lattice(const BlobData& blob, const RayOnLattice& ray) { return find_any_hit(blob, ray); }
