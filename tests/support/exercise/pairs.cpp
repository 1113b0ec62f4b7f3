#include "run.hpp"

#include <algorithm>

namespace espalier::tests::exercises {

namespace {

Transform some_placement(const Blob& blob, Random& random) {
    Transform placement;
    if (random.coin()) {
        const Vec3 axis = random.below(4) == 0 ? some_point(blob, random) : random.in_cube(1.0f);
        placement.rotation = {axis.x, axis.y, axis.z, random.signed_unit()};
    }
    if (random.below(8) == 0) {
        placement.translation = some_point(blob, random);
    } else {
        const float length = some_length(blob, random);
        placement.translation = scaled_by(random.in_cube(1.0f), length);
    }
    if (random.below(3) == 0) placement.scale = random.coin() ? random.unit() * 4.0f : some_length(blob, random);
    return placement;
}

/// Where pairs touch: those of the list, one by one, in a list and for a visitor; and a pair that may not exist.
void exercise_touches(Exercise& run, const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit,
                      std::span<const PairContact> pairs) {
    Verdict& verdict = run.verdict;
    std::array<PairTouch, 9> touches;
    const Filled listed = collect_touches(a, b, touches, limit);
    verdict.require(listed.count == pairs.size(), "other pairs have a place than touch");
    std::array<Contact, 9> contacts;
    for (std::size_t i = 0; i < listed.count; ++i) {
        const PairTouch& touch = touches[i];
        verdict.require(touch.a == pairs[i].a && touch.b == pairs[i].b, "the places of a pair are those of another");
        verdict.require(touch.count >= 1 && touch.count <= max_touch_points, "a pair touches at no place");
        verdict.require(touch.depth >= 0.0f, "a depth is negative or NaN");
        for (unsigned k = 0; k < touch.count; ++k) run.hash.add(touch.points[k]);
        run.hash.add(touch.normal);
        run.hash.add(touch.depth);
        contacts[i] = touch.contact(0);
    }
    for (const Contact& contact : std::span(contacts).first(reduce_contacts(std::span(contacts).first(listed.count))))
        run.hash.add(contact.triangle.index);
    std::size_t visited = 0;
    const auto visit = [&](const PairTouch& touch) {
        verdict.require(visited >= listed.count || touch.depth == touches[visited].depth, "a visitor has other depths");
        return ++visited == touches.size() ? Visit::stop : Visit::next;
    };
    (void)for_each_touch(PlacedBlob(run.blob.for_pairs(limit.visits()), a.transform()), b, visit, limit);
    verdict.require(visited >= listed.count, "a list has more places than a visitor");
    const std::uint32_t end = run.blob.triangle_count() + 1;
    const PairContact some = listed.count != 0 && run.random.coin()
                                 ? pairs[0]
                                 : PairContact{{run.random.below(end)}, {run.random.below(end)}, QueryStatus::ok};
    const PairTouch one = pair_touch(PlacedBlob(run.blob.for_walks(0, 2), a.transform()), b, some);
    run.hash.add(static_cast<std::uint32_t>(one.status));
    if (one) run.hash.add(one.points[0]);
}

}  // namespace

/// The blob against itself.
void exercise_pairs(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const Transform placement = some_placement(blob, run.random);
    // By turns a stands at the origin.
    const Transform own_placement = run.random.coin() ? Transform{} : some_placement(blob, run.random);
    // Less for large leaves: each pair of them takes as many tests as they have pairs of triangles.
    const std::uint64_t most = std::min<std::uint64_t>(2'000, 20'000 / (blob.triangle_count() + 1) + 20);
    const WorkLimit limit(run.random.below(4) == 0 ? run.random.below(50) : most);
    const auto placed = [&] { return PlacedBlob(blob.for_pairs(limit.visits()), own_placement); };
    const PlacedBlob other(blob.unmeasured(), placement);
    const auto check_pair = [&](TriangleId a, TriangleId b) {
        verdict.require(a.index < blob.triangle_count() && b.index < blob.triangle_count(),
                        "a triangle of a pair does not exist");
        run.hash.add(a.index, b.index);
    };
    const YesNo touching = overlaps(placed(), other, limit);
    run.hash.add(static_cast<std::uint32_t>(touching.status()));
    const PairContact first = first_contact(placed(), other, limit);
    verdict.require(first.status == touching.status(), "overlaps and first_contact disagree");
    if (first) check_pair(first.a, first.b);
    std::array<PairContact, 9> pairs;
    const Filled listed = collect_contacts(placed(), other, pairs, limit);
    verdict.require(listed.count <= pairs.size(), "more pairs than there is room for");
    // With duplicate references the first pair may come later.
    const bool is_in_order = blob.duplicate_reference_count() == 0;
    verdict.require(listed.count == 0 || bool(first), "a list has pairs without a first one");
    verdict.require(!is_in_order || ((listed.count > 0) == bool(first) && (listed.count == 0 || pairs[0] == first)),
                    "the first pair is not the first");
    for (const PairContact& pair : listed.in(pairs)) check_pair(pair.a, pair.b);
    std::size_t visited = 0;
    const auto visit = [&](const PairContact& pair) {
        verdict.require(visited >= listed.count || pairs[visited] == pair, "a list and a visitor disagree");
        return ++visited == 64 ? Visit::stop : Visit::next;
    };
    const QueryStatus enumerated = for_each_contact(placed(), other, visit, limit);
    verdict.require(visited >= listed.count && (visited == 0 || !is_refused(enumerated)),
                    "a refused query visits pairs");
    if (run.random.coin()) exercise_touches(run, placed(), other, limit, listed.in(pairs));
    // A page resumes within its limit, also from a cursor that no query returned.
    const Cursor from = run.random.below(4) != 0
                            ? listed.next
                            : Cursor{{run.random.below(blob.triangle_count() + 2),
                                      run.random.below(blob.triangle_count() + 2), run.random.below(3)}};
    const PlacedBlob resumed(blob.for_pairs(2 * limit.visits()), own_placement);
    const Filled page = collect_contacts(resumed, other, pairs, limit, from);
    run.hash.add(static_cast<std::uint32_t>(page.status));
    verdict.require(page.count <= pairs.size(), "more pairs than there is room for");
    for (const PairContact& pair : page.in(pairs)) check_pair(pair.a, pair.b);
    const float max_distance = some_length(blob, run.random);
    const BlobDistance nearest = distance(placed(), other, limit, max_distance);
    run.hash.add(static_cast<std::uint32_t>(nearest.status));
    const YesNo within = within_distance(placed(), other, max_distance, limit);
    if (nearest.status != QueryStatus::work_limit && within.status() != QueryStatus::work_limit)
        verdict.require(nearest.status == within.status(), "distance and within_distance disagree");
    if (nearest.a != no_triangle) {
        verdict.require(nearest || nearest.status == QueryStatus::work_limit, "a refused query finds a distance");
        check_pair(nearest.a, nearest.b);
        verdict.require(nearest.distance >= 0.0f && nearest.distance <= max_distance,
                        "a distance of two blobs is NaN or out of range");
        verdict.require(!touching.yes() || !run.sound || nearest.distance == 0.0f, "blobs that touch are apart");
        run.hash.add(nearest.distance, nearest.on_a, nearest.on_b);
    }
}

}  // namespace espalier::tests::exercises
