#include "run.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <espalier/espalier.hpp>

#include "support/base/random.hpp"
#include "support/blobs/measured_blob.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::exercises {

namespace {

Placement some_placement(const Blob& blob, Random& random) {
    Placement placement;
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

}  // namespace

/// The blob against itself.
void exercise_pairs(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const Placement placement = some_placement(blob, run.random);
    // Less for large leaves: each pair of them takes as many tests as they have pairs of triangles.
    const std::uint64_t most = std::min<std::uint64_t>(2'000, 20'000 / (blob.triangle_count() + 1) + 20);
    const WorkLimit limit = {run.random.below(4) == 0 ? run.random.below(50) : most};
    const auto check_pair = [&](const TrianglePair& pair) {
        verdict.require(pair.a.index < blob.triangle_count() && pair.b.index < blob.triangle_count(),
                        "a triangle of a pair does not exist");
        run.hash.add(pair.a.index);
        run.hash.add(pair.b.index);
    };
    bool touching = false, found = false;
    const Blob& other = blob.unmeasured();
    const QueryStatus status = collides(blob.for_pairs(limit.pairs), other, placement, touching, limit);
    run.hash.add(static_cast<std::uint32_t>(status));
    TrianglePair first;
    verdict.require(first_contact(blob.for_pairs(limit.pairs), other, placement, first, found, limit) == status &&
                        found == touching,
                    "collides and first_contact disagree");
    if (found) check_pair(first);
    std::array<TrianglePair, 9> pairs;
    std::size_t count = 0;
    const QueryStatus listed = all_contacts(blob.for_pairs(limit.pairs), other, placement, pairs, count, limit);
    if (blob.copy_count() != 0) {
        verdict.require(listed == QueryStatus::has_copies, "pairs of copies are listed");
    } else {
        verdict.require(count <= pairs.size(), "more pairs than there is room for");
        verdict.require((count > 0) == found && (count == 0 || pairs[0] == first), "the first pair is not the first");
        for (std::size_t i = 0; i < count; ++i) check_pair(pairs[i]);
    }
    std::uint32_t visited = 0;
    const QueryStatus enumerated = for_each_contact(
        blob.for_pairs(limit.pairs), other, placement,
        [&](const TrianglePair& pair) {
            verdict.require(visited >= count || pairs[visited] == pair, "a list and a visitor disagree");
            return ++visited == 64 ? stop : keep_going;
        },
        limit);
    verdict.require(
        visited >= count && (enumerated == QueryStatus::ok || enumerated == QueryStatus::work_limit || visited == 0),
        "a refused query visits pairs");
    PairDistance nearest;
    const float max_distance = some_length(blob, run.random);
    const QueryStatus answered =
        minimum_distance(blob.for_pairs(limit.pairs), other, placement, max_distance, nearest, found, limit);
    run.hash.add(static_cast<std::uint32_t>(answered));
    bool within = false;
    const QueryStatus decided =
        within_distance(blob.for_pairs(limit.pairs), other, placement, max_distance, within, limit);
    if (answered == QueryStatus::ok && decided == QueryStatus::ok)
        verdict.require(found == within, "minimum_distance and within_distance disagree");
    if ((answered == QueryStatus::ok || answered == QueryStatus::work_limit) && found) {
        check_pair(nearest.pair);
        verdict.require(nearest.distance >= 0.0f && nearest.distance <= max_distance,
                        "a distance of two blobs is NaN or out of range");
        verdict.require(!touching || !run.sound || nearest.distance == 0.0f, "blobs that touch are apart");
        run.hash.add(nearest.distance);
        run.hash.add(nearest.on_a);
        run.hash.add(nearest.on_b);
    }
}

}  // namespace espalier::tests::exercises
