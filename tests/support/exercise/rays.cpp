#include "run.hpp"

namespace espalier::tests::exercises {

namespace {

void check_hit(Exercise& run, const RayHit& hit) {
    const MeasuredBlob& blob = run.blob;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    verdict.require(hit.triangle.index < blob.triangle_count(), "a ray hit a triangle that does not exist");
    verdict.require(is_number(hit.t) && hit.t >= 0.0f, "a hit's t is negative or NaN");
    verdict.require(is_number(hit.u) && is_number(hit.v), "a hit's barycentrics are NaN");
    verdict.require(hit.status == QueryStatus::ok && (hit.side == Side::front || hit.side == Side::back),
                    "a hit has no side");
    verdict.require(is_number(hit.normal.x) && is_number(hit.normal.y) && is_number(hit.normal.z),
                    "a hit's normal is NaN");
    hash.add(hit.triangle.index, hit.t, hit.u, hit.v, hit.normal);
    const OriginalHit original = original_hit(blob, hit);
    verdict.require(original || original.status == QueryStatus::no_data, "a hit does not lead back");
    hash.add(original.triangle, original.u, original.v);
}

/// A hit, a miss or a refusal.
void check_result(Exercise& run, const RayHit& hit) {
    if (hit) return check_hit(run, hit);
    run.verdict.require(hit.status == QueryStatus::not_found || is_refused(hit.status), "a query without a hit is ok");
    run.verdict.require(hit.triangle == no_triangle && hit.t == infinity, "what is no hit looks like one");
}

}  // namespace

void exercise_rays(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    Ray ray = {.origin = some_point(blob, random), .direction = {}};
    if (random.coin()) {
        const Vec3 target = some_point(blob, random);
        ray.direction = plain_difference(target, ray.origin);
    } else {
        ray.direction = some_point(blob, random);
    }
    if (random.below(3) == 0) ray.t_min = hostile_values[random.below(hostile_values.size())];
    if (random.below(3) == 0) ray.t_max = hostile_values[random.below(hostile_values.size())];
    ray.culling = static_cast<FaceCulling>(random.below(4));  // one value more than the type names
    const std::uint32_t parity = random.below(2);
    const auto filter = [&](TriangleId triangle) {
        verdict.require(triangle.index < blob.triangle_count(),
                        "a filter was asked about a triangle that does not exist");
        return triangle.index % 2 == parity;
    };

    const RayHit hit = raycast(blob, ray);
    check_result(run, hit);
    const QueryStatus status = hit.status;
    const bool found = bool(hit);
    verdict.require(occluded(blob, ray).status() == status, "occluded and raycast disagree");
    QueryCounters counters;
    const RayHit counted = raycast(blob, ray, counters);
    verdict.require(counted.status == status || !run.sound, "the counted query and raycast disagree");
    verdict.require(!run.sound || counted.triangle == hit.triangle, "the counted query hit something else");
    const RoundedRay rounded = round_ray(blob.for_walks(2).lattice(), ray);
    const RayHit rounded_hit = raycast(blob, rounded);
    check_result(run, rounded_hit);
    verdict.require(occluded(blob, rounded).status() == rounded_hit.status, "occluded and raycast refuse differently");
    verdict.require(is_refused(rounded_hit.status) || rounded_hit.status == status || !run.sound,
                    "a ray and the same one rounded before disagree");
    if (parity != 0) {
        std::array<Ray, 20> rays;  // a group, and strangers
        rays.fill(ray);
        rays.back().direction = ray.origin;
        std::array<RayHit, 20> hits;
        std::array<YesNo, 20> answers;
        verdict.require(raycast(blob.for_walks(rays.size()), rays, hits).count == rays.size() &&
                            occluded(blob.for_walks(rays.size()), rays, answers).count == rays.size(),
                        "a batch is not complete");
        for (std::size_t i = 0; i < rays.size(); ++i)
            verdict.require(hits[i].status == answers[i].status(), "answers of a batch disagree");
        verdict.require(!run.sound || (hits[0].triangle == hit.triangle && hits[0].status == status),
                        "a ray alone and a batch disagree");
    }
    std::array<RayHit, 4> first;
    const Filled count = closest_hits(blob, ray, first);
    verdict.require((count.count > 0) == found && count.count <= first.size(), "closest_hits and raycast disagree");
    verdict.require(count.status != QueryStatus::output_full || count.count == first.size(),
                    "an array that is not full is reported as full");
    verdict.require(is_refused(count.status) == is_refused(status), "closest_hits and raycast refuse differently");
    for (std::size_t i = 0; i < count.count; ++i) {
        check_hit(run, first[i]);
        verdict.require(i == 0 || first[i - 1].t <= first[i].t, "closest_hits are not sorted");
    }
    const Ray segment = Ray::between(ray.origin, ray.direction);
    const RayHit on_segment = raycast(blob, segment);
    check_result(run, on_segment);
    verdict.require(!on_segment || on_segment.t <= 1.0f, "a segment is hit beyond its end");
    verdict.require(occluded(blob, segment).status() == on_segment.status,
                    "occluded and raycast disagree about a segment");
    const RayHit filtered = raycast(blob, ray, filter);
    check_result(run, filtered);
    verdict.require(occluded(blob, ray, filter).status() == filtered.status,
                    "occluded and raycast disagree under a filter");
    std::array<RayHit, 64> each;  // checked later: what a check looks up is measured too
    std::size_t visited = 0;
    const bool ascends = blob.duplicate_reference_count() == 0;
    const QueryStatus all = for_each_hit(blob.for_lists(), ray, [&](const RayHit& hit_in_order) {
        each[visited] = hit_in_order;
        return ++visited == each.size() ? Visit::stop : Visit::next;
    });
    for (std::size_t i = 0; i < visited; ++i) {
        check_hit(run, each[i]);
        verdict.require(i == 0 || !ascends || each[i].triangle.index > each[i - 1].triangle.index,
                        "hits are not in ascending order");
    }
    // Bytes of a stranger may have references outside of their boxes: those report nothing.
    verdict.require((visited > 0) == found || !ascends, "for_each_hit and raycast disagree");
    verdict.require((all == QueryStatus::stopped) == (visited == each.size()),
                    "for_each_hit reports wrongly that it was stopped");
    verdict.require(is_refused(all) == is_refused(status), "for_each_hit and raycast refuse differently");
    std::size_t crossings = 0;
    const QueryStatus crossed = for_each_crossing(blob.for_lists(), ray, [&](const RayHit& crossing) {
        each[crossings] = crossing;
        return ++crossings == each.size() ? Visit::stop : Visit::next;
    });
    for (std::size_t i = 0; i < crossings; ++i) check_hit(run, each[i]);
    verdict.require(crossings <= visited, "there are more crossings than hits");
    verdict.require(is_refused(crossed) == is_refused(status), "for_each_crossing and raycast refuse differently");
}

}  // namespace espalier::tests::exercises
