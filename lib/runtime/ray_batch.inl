// Batches of rays. Included once per instruction set with lanes, inside its namespace, after ray_in_batch.inl and
// ray_group.inl. A ray's answer does not depend on the order of visits (docs/numerics.md), so rays may be answered in
// any company: neighbours that look alike walk the tree as a group, the others take turns, a node each.

/// Rays that have nothing in common, several on their way at once: first the nodes of all are tested, which the
/// processor does side by side, then each decides where to go on, which is where branches are mispredicted. How many
/// hit something.
template <class Leaf>
[[gnu::noinline]] inline std::size_t answer_in_turns(const BlobData& blob, const Ray* rays, const BatchAnswers& answers,
                                                     std::size_t count) {
    constexpr unsigned most_under_way = 6;
    struct UnderWay {
        RayInBatch<Leaf> ray;
        NearestFirst<PlaceOf<Leaf>, BatchHit<Leaf>> walk;
        std::size_t number;  // of the ray
        unsigned mask;       // of the node's children
    };
    UnderWay places[most_under_way];
    UnderWay* under_way[most_under_way];
    unsigned size = 0;
    std::size_t next = 0;
    std::size_t hits = 0;
    const auto set_out = [&](UnderWay& place) {
        for (; next < count; ++next) {
            if (place.ray.begin(blob, rays[next], answers.any_will_do())) {
                place.walk.begin(0);
                place.number = next++;
                return true;
            }
            answers.miss(next);
        }
        return false;
    };
    for (UnderWay& place : places)
        if (set_out(place)) under_way[size++] = &place;
    while (size != 0) {
        for (unsigned i = 0; i < size; ++i)
            under_way[i]->mask = under_way[i]->walk.test(blob, under_way[i]->ray.visitor);
        unsigned stay = 0;
        for (unsigned i = 0; i < size; ++i) {
            UnderWay& place = *under_way[i];
            bool goes_on = place.walk.advance(blob, place.ray.visitor, place.mask);
            if (!goes_on) {
                hits += place.ray.answer(rays[place.number], answers, place.number);
                goes_on = set_out(place);
            }
            if (goes_on) under_way[stay++] = &place;
        }
        size = stay;
    }
    return hits;
}

/// Whether the next rays are a group: a few of them are compared with the first, origins by a sixteenth of the asset
/// and directions by a quarter. Only time depends on it.
inline bool look_alike(const BlobData& blob, const Ray* rays, std::size_t count) {
    if (count < rays_in_group) return false;
    const auto longest = [](Vec3 v) { return maximum(maximum(absolute(v.x), absolute(v.y)), absolute(v.z)); };
    const auto distance = [&](Vec3 a, Vec3 b) { return longest({a.x - b.x, a.y - b.y, a.z - b.z}); };
    const float* extent = blob.extent_steps;
    const float near = longest({extent[0], extent[1], extent[2]}) * 0x1p-4f;
    const float similar = longest(rays[0].direction) * 0x1p-2f;
    // mutant(< -> <=) equivalent: the loop takes 5, 10, 15 and then 20
    for (std::size_t i = rays_in_group / 3; i < rays_in_group; i += rays_in_group / 3)
        if (!(distance(rays[i].origin, rays[0].origin) * blob.steps_per_unit <= near) ||
            !(distance(rays[i].direction, rays[0].direction) <= similar))
            return false;
    return true;
}

/// How many hit something.
inline std::size_t answer_batch(const BlobData& blob, const Ray* rays, const BatchAnswers& answers, std::size_t count) {
    // What was looked at is still in the cache when it is its turn.
    constexpr std::size_t longest_look_ahead = 32 * rays_in_group;
    return with_leaves_of(blob, [&]<class Leaf>() {
        std::size_t hits = 0;
        bool alike = look_alike(blob, rays, count);
        for (std::size_t first = 0; first < count;) {
            const bool grouped = alike;
            std::size_t end = first;
            do {
                // mutant(< -> <=) equivalent: both branches give the end where exactly one group is left
                end = count - end < rays_in_group ? count : end + rays_in_group;
                alike = look_alike(blob, rays + end, count - end);
                // mutant(without 4, - -> +, - -> right side dropped, < -> <= 2, < -> >= 2) work: how far the loop looks
                // ahead changes only what is in the cache
            } while (end < count && alike == grouped && end - first < longest_look_ahead);
            hits += grouped ? answer_in_groups<Leaf>(blob, rays + first, answers.from(first), end - first)
                            : answer_in_turns<Leaf>(blob, rays + first, answers.from(first), end - first);
            first = end;
        }
        return hits;
    });
}

std::size_t closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    return answer_batch(blob, rays, {hits, nullptr}, count);
}

std::size_t any_hits(const BlobData& blob, const Ray* rays, std::uint8_t* occluded, std::size_t count) {
    return answer_batch(blob, rays, {nullptr, occluded}, count);
}
