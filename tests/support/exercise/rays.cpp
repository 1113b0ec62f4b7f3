#include "run.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include <espalier/espalier.hpp>

#include "support/base/answer_hash.hpp"
#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"
#include "support/blobs/measured_blob.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::exercises {

namespace {

void check_hit(Exercise& run, const RayHit& hit) {
    const MeasuredBlob& blob = run.blob;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    verdict.require(hit.triangle.index < blob.triangle_count(), "a ray hit a triangle that does not exist");
    verdict.require(is_number(hit.t) && hit.t >= 0.0f, "a hit's t is negative or NaN");
    verdict.require(is_number(hit.u) && is_number(hit.v), "a hit's barycentrics are NaN");
    verdict.require(is_number(hit.normal.x) && is_number(hit.normal.y) && is_number(hit.normal.z),
                    "a hit's normal is NaN");
    hash.add(hit.triangle.index);
    hash.add(hit.t);
    hash.add(hit.u);
    hash.add(hit.v);
    hash.add(hit.normal);
    const OriginalHit original = original_hit(blob, hit);
    verdict.require(original || original.status == QueryStatus::no_data, "a hit does not lead back");
    hash.add(original.triangle);
    hash.add(original.u);
    hash.add(original.v);
}

}  // namespace

void exercise_rays(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    Ray ray;
    ray.origin = some_point(blob, random);
    if (random.coin()) {
        const Vec3 target = some_point(blob, random);
        ray.direction = difference(target, ray.origin);
    } else {
        ray.direction = some_point(blob, random);
    }
    if (random.below(3) == 0) ray.t_min = hostile_values[random.below(hostile_values.size())];
    if (random.below(3) == 0) ray.t_max = hostile_values[random.below(hostile_values.size())];
    ray.faces = static_cast<Faces>(random.below(4));  // one value more than the type names
    const std::uint32_t parity = random.below(2);
    const auto filter = [&](Triangle triangle) {
        verdict.require(triangle.index < blob.triangle_count(),
                        "a filter was asked about a triangle that does not exist");
        return triangle.index % 2 == parity;
    };

    RayHit hit;
    const bool found = raycast(blob, ray, hit);
    if (found) check_hit(run, hit);
    verdict.require(occluded(blob, ray) == found, "occluded and raycast disagree");
    QueryCounters counters;
    RayHit counted;
    verdict.require(raycast_counted(blob, ray, counted, counters) == found || !run.sound,
                    "the counted query and raycast disagree");
    verdict.require(!found || !run.sound || counted.triangle == hit.triangle, "the counted query hit something else");
    RayHit rounded_hit;
    bool rounded_any = false;
    const RoundedRay rounded = round_ray(lattice_of(blob.for_walks(2)), ray);
    const QueryStatus refused = raycast(blob, rounded, rounded_hit);
    verdict.require(occluded(blob, rounded, rounded_any) == refused, "occluded and raycast refuse differently");
    verdict.require(refused != QueryStatus::ok || rounded_any == found || !run.sound,
                    "a ray and the same one rounded before disagree");
    if (refused == QueryStatus::ok && rounded_any) check_hit(run, rounded_hit);
    if (parity != 0) {
        std::array<Ray, 20> rays;  // a group, and strangers
        rays.fill(ray);
        rays.back().direction = ray.origin;
        std::array<RayHit, 20> hits;
        std::array<std::uint8_t, 20> answers;
        const Blob& twenty = blob.for_walks(rays.size());
        const std::size_t count = raycast(twenty, rays, hits);
        verdict.require(occluded(blob.for_walks(rays.size()), rays, answers) == count,
                        "occluded and raycast disagree about a batch");
        for (std::size_t i = 0; i < rays.size(); ++i)
            verdict.require((hits[i].triangle != no_triangle) == (answers[i] != 0), "answers of a batch disagree");
        verdict.require(!found || !run.sound || hits[0].triangle == hit.triangle, "a ray alone and a batch disagree");
    }
    std::array<RayHit, 4> first;
    const HitCount count = closest_hits(blob, ray, first);
    verdict.require((count.count > 0) == found && count.count <= first.size(), "closest_hits and raycast disagree");
    verdict.require(count.status == QueryStatus::ok || count.count == first.size(),
                    "an array that is not full is reported as full");
    for (std::size_t i = 0; i < count.count; ++i) {
        check_hit(run, first[i]);
        verdict.require(i == 0 || first[i - 1].t <= first[i].t, "closest_hits are not sorted");
    }
    const Segment segment = {ray.origin, ray.direction};
    RayHit on_segment;
    const bool segment_hits = raycast(blob, segment, on_segment);
    if (segment_hits) check_hit(run, on_segment);
    verdict.require(!segment_hits || on_segment.t <= 1.0f, "a segment is hit beyond its end");
    verdict.require(occluded(blob, segment) == segment_hits, "occluded and raycast disagree about a segment");
    RayHit filtered;
    const bool found_filtered = raycast(blob, ray, filtered, filter);
    if (found_filtered) check_hit(run, filtered);
    verdict.require(occluded(blob, ray, filter) == found_filtered, "occluded and raycast disagree under a filter");
    std::uint32_t visited = 0;
    std::uint32_t last = 0;
    const bool saw_all = for_each_hit(blob, ray, [&](const RayHit& each) {
        check_hit(run, each);
        verdict.require(visited == 0 || each.triangle.index > last, "hits are not in storage order");
        last = each.triangle.index;
        return ++visited == 64 ? stop : keep_going;
    });
    const bool enumerates = blob.copy_count() == 0;  // copies are refused
    verdict.require((visited > 0) == (found && enumerates), "for_each_hit and raycast disagree");
    verdict.require(saw_all == (visited < 64 && enumerates), "for_each_hit says wrongly whether it saw all");
}

}  // namespace espalier::tests::exercises
