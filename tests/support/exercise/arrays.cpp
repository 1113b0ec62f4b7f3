#include "run.hpp"

namespace espalier::tests::exercises {

namespace {

constexpr std::size_t queries = 4;

/// Requires whole lists that lie one after the other, of triangles that exist.
template <class Element, std::size_t places, class Triangle>
void check_filled_lists(Exercise& run, const FilledLists& filled, const std::array<std::size_t, queries + 1>& offsets,
                        const std::array<Element, places>& elements, Triangle triangle_of) {
    run.verdict.require(filled.lists <= queries && filled.count <= places && offsets[filled.lists] == filled.count,
                        "lists do not end where they are reported to");
    run.verdict.require((filled.status == QueryStatus::output_full) == (filled.needed > places - filled.count),
                        "lists that are full need no place");
    for (std::size_t i = 0; i < filled.lists; ++i)
        run.verdict.require(offsets[i] <= offsets[i + 1], "a list ends before it begins");
    for (std::size_t i = 0; i < filled.count; ++i)
        run.verdict.require(triangle_of(elements[i]) < run.blob.triangle_count(), "a list has no triangle");
}

}  // namespace

void exercise_arrays(Exercise& run) {
    Random random = run.random;  // a copy, so that all others draw as they would without this one
    const MeasuredBlob& blob = run.blob;
    if (!blob.unmeasured()) return;
    std::array<Vec3, queries> points, others;
    std::array<float, queries> lengths;
    for (std::size_t i = 0; i < queries; ++i) {
        points[i] = some_point(blob, random);
        others[i] = some_point(blob, random);
        lengths[i] = some_length(blob, random);
    }
    const RayArrays rays = {{points.data()}, {others.data()}, {}, {lengths.data()}};
    const SphereArrays spheres = {{points.data()}, {lengths.data()}};
    const BoxArrays boxes = {{points.data()}, {others.data()}};
    std::array<RayHit, queries> hits;
    std::array<YesNo, queries> answers;
    std::array<ClosestPoint, queries> nearest;
    const auto is_whole = [&](const Filled& filled) {
        run.verdict.require(filled.count == queries && filled.status == QueryStatus::ok, "a batch is not whole");
    };
    is_whole(raycast(blob.for_walks(queries), rays, hits));
    is_whole(occluded(blob.for_walks(queries), rays, answers));
    for (std::size_t i = 0; i < queries; ++i) {
        const RayHit alone = raycast(blob, rays.at(i));
        run.verdict.require(!run.sound || (hits[i].triangle == alone.triangle && hits[i].status == alone.status),
                            "a ray of arrays and one alone disagree");
        run.verdict.require(answers[i].status() == hits[i].status || !run.sound, "answers of arrays disagree");
    }
    is_whole(closest_point(blob.for_walks(queries), rays.origins, nearest));
    is_whole(overlaps(blob.for_walks(queries), spheres, answers));
    is_whole(overlaps(blob.for_walks(queries), boxes, answers));
    for (std::size_t i = 0; i < queries; ++i) {
        run.verdict.require(nearest[i].triangle == closest_point(blob, points[i]).triangle || !run.sound,
                            "a point of an array and one alone disagree");
        run.verdict.require(answers[i] == overlaps(blob, boxes.at(i)), "a box of arrays and one alone disagree");
    }

    const std::uint64_t duplicates = blob.duplicate_reference_count();
    const auto for_lists = [&]() -> const Blob& {
        return blob.for_walks(queries * (1 + duplicates), queries * duplicates);
    };
    std::array<QueryStatus, queries> statuses;
    std::array<std::size_t, queries + 1> offsets = {};
    std::array<RayHit, 9> listed;
    std::array<TriangleId, 9> triangles;
    const auto of_hit = [](const RayHit& hit) { return hit.triangle.index; };
    const auto of_id = [](TriangleId triangle) { return triangle.index; };
    check_filled_lists(run, collect_hits(for_lists(), rays, statuses, offsets, listed), offsets, listed, of_hit);
    check_filled_lists(run, collect_crossings(for_lists(), rays, statuses, offsets, listed), offsets, listed, of_hit);
    check_filled_lists(run, collect_overlaps(for_lists(), spheres, statuses, offsets, triangles), offsets, triangles,
                       of_id);
    check_filled_lists(run, collect_overlaps(for_lists(), boxes, statuses, offsets, triangles), offsets, triangles,
                       of_id);
}

}  // namespace espalier::tests::exercises
