#include "run.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

#include <espalier/espalier.hpp>
#include <runtime/small_code.hpp>

#include "support/base/random.hpp"
#include "support/blobs/measured_blob.hpp"
#include "support/machine/float_mode.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::exercises {

namespace {

void check_nearest(Exercise& run, const Nearest& nearest) {
    run.verdict.require(nearest.triangle.index < run.blob.triangle_count(), "the nearest triangle does not exist");
    run.verdict.require(nearest.distance >= 0.0f, "the nearest distance is negative or NaN");
    run.verdict.require(nearest.feature <= Feature::vertex_c, "the nearest point lies on no feature");
    run.hash.add(nearest.triangle.index);
    run.hash.add(nearest.distance);
    run.hash.add(nearest.u);
    run.hash.add(nearest.v);
    run.hash.add(nearest.point);
    run.hash.add(static_cast<std::uint32_t>(nearest.feature));
}

}  // namespace

void exercise_distances(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    const Vec3 point = some_point(blob, run.random);
    const float max_distance = some_length(blob, run.random);
    Nearest nearest;
    const bool found = closest_point(blob, point, max_distance, nearest);
    if (found) check_nearest(run, nearest);
    std::array<Nearest, 9> few;
    const std::size_t count = closest_triangles(blob, point, max_distance, few);
    run.verdict.require((count > 0) == found && count <= few.size(), "closest_triangles and closest_point disagree");
    for (std::size_t i = 0; i < count; ++i) {
        check_nearest(run, few[i]);
        run.verdict.require(i == 0 || few[i].distance >= few[i - 1].distance, "the closest triangles are not sorted");
    }
    const Vec3 end = some_point(blob, run.random);
    NearestPair pairs[2];
    const bool answered[2] = {
        closest_to_segment(blob, {point, end}, max_distance, pairs[0]) == QueryStatus::ok,
        closest_to_box(blob, {point, end}, max_distance, pairs[1]) == QueryStatus::ok,
    };
    for (int i = 0; i < 2; ++i) {
        if (!answered[i]) continue;
        const NearestPair& pair = pairs[i];
        run.verdict.require(pair.triangle == no_triangle || pair.triangle.index < blob.triangle_count(),
                            "the nearest triangle of a pair does not exist");
        run.verdict.require(pair.distance >= 0.0f, "the distance of a pair is negative or NaN");
        run.hash.add(pair.triangle.index);
        run.hash.add(pair.distance);
        run.hash.add(pair.u);
        run.hash.add(pair.v);
        run.hash.add(pair.on_shape);
        run.hash.add(pair.on_surface);
    }
    for (const Result<float>& moved : {rounding_error(blob, point), rounding_error(blob, Segment{point, end}),
                                       rounding_error(blob, Ray{.origin = end, .direction = point})}) {
        run.verdict.require(moved.value >= 0.0f, "how far rounding moves a query is negative or NaN");
        run.hash.add(static_cast<std::uint32_t>(moved.status));
        run.hash.add(moved.value);
    }
    bool inside = false;
    const QueryStatus status = contains(blob, point, inside);
    run.hash.add(static_cast<std::uint32_t>(status));
    run.hash.add(std::uint32_t{inside});
    Nearest signed_nearest;
    if (signed_distance(blob.for_walks(2), point, max_distance, signed_nearest) == QueryStatus::ok) {
        run.verdict.require(status == QueryStatus::ok, "contains and signed_distance disagree");
        run.verdict.require((signed_nearest.triangle != no_triangle) == found,
                            "signed_distance and closest_point disagree");
        run.verdict.require(inside || !(signed_nearest.distance < 0.0f), "a distance outside is negative");
        run.hash.add(signed_nearest.distance);
    }
}

void exercise_approximate(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    const float length = some_length(blob, random);
    const float accuracy = plain_product(length, random.coin() ? 0.01f : 1.0f);
    const Sphere sphere{some_point(blob, random), some_length(blob, random)};
    const Box box{some_point(blob, random), some_point(blob, random)};
    Ray ray{some_point(blob, random), some_point(blob, random)};
    if (random.coin()) ray.t_max = some_length(blob, random);
    QueryCounters counters;
    verdict.require(may_overlap(blob, sphere, accuracy, &counters) || !overlaps(blob, sphere), "a sphere was missed");
    verdict.require(may_overlap(blob, sphere, 0.0f) == overlaps(blob, sphere), "accuracy 0 is not exact for a sphere");
    verdict.require(may_overlap(blob, box, accuracy) || !overlaps(blob, box), "a box was missed");
    verdict.require(may_overlap(blob, box, 0.0f) == overlaps(blob, box), "accuracy 0 is not exact for a box");
    // Small code sees the boxes of the two in different ways: what is not in its box may be met by one of them alone.
    verdict.require(may_be_occluded(blob, ray, accuracy) || !occluded(blob, ray) || (detail::small_code && !run.sound),
                    "a hit was missed");
    verdict.require(may_be_occluded(blob, ray, 0.0f) == occluded(blob, ray), "accuracy 0 is not exact for a ray");
    DistanceBounds bounds;
    if (distance_bounds(blob, sphere.center, sphere.radius, accuracy, bounds)) {
        verdict.require(bounds.lower >= 0.0f && (!run.sound || bounds.lower <= bounds.upper),
                        "bounds of a distance are none");
        run.hash.add(bounds.lower);
        run.hash.add(bounds.upper);
    }
    run.hash.add(static_cast<std::uint32_t>(counters.nodes));
}

}  // namespace espalier::tests::exercises
