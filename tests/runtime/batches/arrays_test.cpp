// Claims about batches over strided arrays: the answers of one call for each query, to the bit, wherever numbers lie.
#include "support/testing.hpp"

#include <memory>

#include "support/machine/exact_buffer.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests::arrays_test {
namespace {

/// Values in memory that ends with them: with gaps, at any address, forwards or backwards.
template <class Value>
class Scattered {
public:
    Scattered(const std::vector<Value>& values, Random& random) {
        const std::size_t step = sizeof(Value) + random.below(9);
        const bool backwards = random.coin();
        const std::size_t last = values.empty() ? 0 : values.size() - 1;
        std::vector<std::byte> bytes(values.empty() ? 0 : step * last + sizeof(Value));
        for (std::size_t i = 0; i < values.size(); ++i)
            std::memcpy(bytes.data() + step * (backwards ? last - i : i), &values[i], sizeof(Value));
        buffer_ = std::make_unique<ExactBuffer>(bytes, random.below(16));
        const auto stride = static_cast<std::ptrdiff_t>(step);
        strided_ = {buffer_->bytes().data() + (backwards ? step * last : 0), backwards ? -stride : stride};
    }
    [[nodiscard]] const Strided<Value>& strided() const { return strided_; }

private:
    std::unique_ptr<ExactBuffer> buffer_;
    Strided<Value> strided_;
};

/// Rays of which runs are alike, so that batches make groups, and some hostile ones.
std::vector<Ray> mixed_rays(const Blob& blob, QueryMaker& maker, std::size_t count) {
    std::vector<Ray> rays;
    Random& random = maker.random();
    while (rays.size() < count) {
        Ray ray = maker.any_ray();
        if (random.below(6) == 0) ray.origin = some_point(blob, random);
        if (random.below(4) == 0) maker.restrict(ray);
        ray.culling = FaceCulling::back;  // is the same for all
        for (unsigned run = random.coin() ? 1 : 1 + random.below(40); run > 0; --run) rays.push_back(ray);
    }
    rays.resize(count);
    return rays;
}

template <class Of, class Get>
auto fields_of(const std::vector<Of>& all, Get get) {
    std::vector<std::remove_cvref_t<decltype(get(all[0]))>> fields;
    for (const Of& each : all) fields.push_back(get(each));
    return fields;
}

/// Fills lists in arrays of any size, page by page, and returns them as one call for each query would give them.
template <class Element, class Collect>
std::vector<std::vector<Element>> collect_in_pages(std::size_t count, std::vector<QueryStatus>& statuses,
                                                   Random& random, Collect collect) {
    std::vector<std::vector<Element>> lists;
    statuses.assign(count, QueryStatus::work_limit);
    std::size_t places = random.below(9);
    while (lists.size() < count || count == 0) {
        std::vector<std::size_t> offsets(count - lists.size() + 1, 99);
        std::vector<Element> elements(places);
        const FilledLists filled =
            collect(lists.size(), std::span(statuses).subspan(lists.size()), std::span(offsets), std::span(elements));
        REQUIRE(offsets[0] == 0);
        for (std::size_t i = 0; i < filled.lists; ++i) {
            REQUIRE(offsets[i] <= offsets[i + 1]);
            lists.emplace_back(elements.begin() + static_cast<std::ptrdiff_t>(offsets[i]),
                               elements.begin() + static_cast<std::ptrdiff_t>(offsets[i + 1]));
        }
        REQUIRE(filled.count == offsets[filled.lists]);
        if (filled.status == QueryStatus::ok) {
            REQUIRE(filled.needed == 0);
            break;
        }
        REQUIRE(filled.status == QueryStatus::output_full);
        REQUIRE(filled.needed > places - filled.count);
        places = std::max<std::size_t>(filled.needed, random.below(20));
    }
    REQUIRE(lists.size() == count);
    return lists;
}

bool same_element(const RayHit& a, const RayHit& b) { return same_bits(a, b); }
bool same_element(TriangleId a, TriangleId b) { return a == b; }

/// Requires the lists that one call for each query visits.
template <class Element, class Collect, class Visit>
void check_lists(std::size_t count, Random& random, Collect collect, Visit visit) {
    std::vector<QueryStatus> statuses;
    const auto lists = collect_in_pages<Element>(count, statuses, random, collect);
    for (std::size_t i = 0; i < count; ++i) {
        std::vector<Element> expected;
        const QueryStatus status = visit(i, [&](const Element& element) { expected.push_back(element); });
        REQUIRE(statuses[i] == status);
        REQUIRE(lists[i].size() == expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) REQUIRE(same_element(lists[i][k], expected[k]));
    }
}

TEST_CASE("batch: rays in arrays get the answers of each alone") {
    Random random(41);
    std::uint64_t hits_found = 0;
    const auto& blobs = small_test_blobs();
    for (std::size_t b = 0; b < blobs.size(); ++b) {
        const Blob& blob = blobs[b].opened.blob;
        QueryMaker maker(blobs[b].decoded, b);
        for (std::uint64_t round = 0; round < scaled(1); ++round) {
            const std::size_t counts[] = {0, 1, 15, 127, 128, 129, 300};
            const std::size_t count = counts[(b + round) % 7];
            const std::vector<Ray> rays = mixed_rays(blob, maker, count);
            const Scattered origins(fields_of(rays, [](const Ray& ray) { return ray.origin; }), random);
            const Scattered directions(fields_of(rays, [](const Ray& ray) { return ray.direction; }), random);
            const Scattered from(fields_of(rays, [](const Ray& ray) { return ray.t_min; }), random);
            const Scattered to(fields_of(rays, [](const Ray& ray) { return ray.t_max; }), random);
            const RayArrays arrays = {origins.strided(), directions.strided(), from.strided(), to.strided(),
                                      FaceCulling::back};
            std::vector<RayHit> hits(count);
            std::vector<YesNo> answers(count);
            REQUIRE(raycast(blob, arrays, hits).count == count);
            REQUIRE(occluded(blob, arrays, answers).count == count);
            for (std::size_t i = 0; i < count; ++i) {
                REQUIRE(same_bits(hits[i], raycast(blob, rays[i])));
                REQUIRE(answers[i] == occluded(blob, rays[i]));
                hits_found += hits[i] ? 1u : 0u;
            }
            const std::size_t places = random.below(5);
            std::vector<RayHit> rows(places * count), row(places);
            std::vector<Filled> found(count);
            REQUIRE(closest_hits(blob, arrays, rows, found).count == count);
            for (std::size_t i = 0; i < count; ++i) {
                const Filled alone = closest_hits(blob, rays[i], row);
                REQUIRE(found[i].count == alone.count);
                REQUIRE(found[i].status == alone.status);
                for (std::size_t k = 0; k < alone.count; ++k) REQUIRE(same_bits(rows[i * places + k], row[k]));
            }
            check_lists<RayHit>(
                count, random,
                [&](std::size_t first, auto statuses, auto offsets, auto elements) {
                    return collect_hits(blob, arrays.from(first), statuses, offsets, elements);
                },
                [&](std::size_t i, auto visit) { return for_each_hit(blob, rays[i], visit); });
            check_lists<RayHit>(
                count, random,
                [&](std::size_t first, auto statuses, auto offsets, auto elements) {
                    return collect_crossings(blob, arrays.from(first), statuses, offsets, elements);
                },
                [&](std::size_t i, auto visit) { return for_each_crossing(blob, rays[i], visit); });
        }
    }
    if (asks_enough()) CHECK(hits_found > 100);
}

TEST_CASE("batch: one value serves all queries and missing ends of rays are their defaults") {
    const OpenedBlob opened(small_test_blobs()[0].opened.bytes);
    const Vec3 eye = {0.1f, 0.2f, 9.0f};
    const std::vector<Vec3> ways = {{0.0f, 0.0f, -1.0f}, {0.1f, 0.0f, -1.0f}, {0.0f, 0.0f, 1.0f}};
    RayArrays arrays;
    arrays.origins = {&eye, 0};
    arrays.directions = {ways.data()};
    std::vector<RayHit> hits(3);
    REQUIRE(raycast(opened.blob, arrays, hits).status == QueryStatus::ok);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(same_bits(hits[i], raycast(opened.blob, {.origin = eye, .direction = ways[i]})));
    REQUIRE(raycast(opened.blob, arrays.from(1), std::span(hits).first(2)).status == QueryStatus::ok);
    CHECK(same_bits(hits[1], raycast(opened.blob, {.origin = eye, .direction = ways[2]})));
}

TEST_CASE("batch: points and volumes in arrays get the answers of each alone") {
    Random random(42);
    std::uint64_t touched = 0, inside = 0;
    for (const TestBlob& test_blob : small_test_blobs()) {
        const Blob& blob = test_blob.opened.blob;
        const std::size_t count = 5 + random.below(12);
        std::vector<Vec3> points, others;
        std::vector<float> lengths;
        for (std::size_t i = 0; i < count; ++i) {
            points.push_back(some_point(blob, random));
            others.push_back(some_point(blob, random));
            lengths.push_back(some_length(blob, random));
        }
        const Scattered of_points(points, random), of_others(others, random);
        const Scattered of_lengths(lengths, random);
        const float reach = some_length(blob, random);
        std::vector<ClosestPoint> nearest(count), far(count);
        std::vector<YesNo> contained(count), by_sphere(count), by_box(count);
        const SphereArrays spheres = {of_points.strided(), of_lengths.strided()};
        const BoxArrays boxes = {of_points.strided(), of_others.strided()};
        REQUIRE(closest_point(blob, of_points.strided(), nearest, reach).count == count);
        REQUIRE(signed_distance(blob, of_points.strided(), far, reach).count == count);
        REQUIRE(contains(blob, of_points.strided(), contained).count == count);
        REQUIRE(overlaps(blob, spheres, by_sphere).count == count);
        REQUIRE(overlaps(blob, boxes, by_box).count == count);
        for (std::size_t i = 0; i < count; ++i) {
            REQUIRE(same_bits(nearest[i], closest_point(blob, points[i], reach)));
            REQUIRE(same_bits(far[i], signed_distance(blob, points[i], reach)));
            REQUIRE(contained[i] == contains(blob, points[i]));
            REQUIRE(by_sphere[i] == overlaps(blob, Sphere{points[i], lengths[i]}));
            REQUIRE(by_box[i] == overlaps(blob, Box{points[i], others[i]}));
            touched += by_sphere[i].yes() && by_box[i].yes() ? 1u : 0u;
            inside += contained[i].yes() ? 1u : 0u;
        }
        std::vector<ClosestPoint> rows(3 * count), row(3);
        std::vector<Filled> found(count);
        REQUIRE(closest_triangles(blob, of_points.strided(), rows, found, reach).count == count);
        for (std::size_t i = 0; i < count; ++i) {
            const Filled alone = closest_triangles(blob, points[i], row, reach);
            REQUIRE(found[i].count == alone.count);
            REQUIRE(found[i].status == alone.status);
            for (std::size_t k = 0; k < alone.count; ++k) REQUIRE(same_bits(rows[3 * i + k], row[k]));
        }
        const auto check_overlaps = [&](const auto& shapes, auto shape_at) {
            check_lists<TriangleId>(
                count, random,
                [&](std::size_t first, auto... arrays) {
                    return collect_overlaps(blob, shapes.from(first), arrays...);
                },
                [&](std::size_t i, auto visit) { return for_each_overlap(blob, shape_at(i), visit); });
        };
        check_overlaps(spheres, [&](std::size_t i) { return Sphere{points[i], lengths[i]}; });
        check_overlaps(boxes, [&](std::size_t i) { return Box{points[i], others[i]}; });
    }
    if (asks_enough()) CHECK(touched > 10);
    if (asks_enough()) CHECK(inside > 10);
}

TEST_CASE("batch: sizes that do not match are refused and nothing is written") {
    const Blob& blob = small_test_blobs()[0].opened.blob;
    const Vec3 point = {};
    const Strided<Vec3> points = {&point, 0};
    const float one = 1.0f;
    std::vector<ClosestPoint> nearest(7);
    std::vector<Filled> found(2);
    std::vector<QueryStatus> statuses(2, QueryStatus::work_limit);
    std::vector<std::size_t> offsets(2, 9);
    std::vector<TriangleId> triangles(2);
    CHECK(closest_triangles(blob, points, nearest, found).status == QueryStatus::invalid_argument);
    CHECK(found[0].status == QueryStatus::not_open);
    const FilledLists lists = collect_overlaps(blob, SphereArrays{points, {&one, 0}}, statuses, offsets, triangles);
    CHECK(lists.status == QueryStatus::invalid_argument);
    CHECK(offsets[0] == 9);
    CHECK(statuses[0] == QueryStatus::work_limit);
    std::vector<YesNo> answers(2, YesNo(QueryStatus::work_limit));
    CHECK(contains(Blob(), points, answers).status == QueryStatus::not_open);
    CHECK(contains(blob, {}, answers).status == QueryStatus::invalid_argument);
    CHECK(contains(blob, points, {static_cast<YesNo*>(nullptr), 2}).status == QueryStatus::invalid_argument);
    CHECK(answers[0].status() == QueryStatus::work_limit);
    CHECK(closest_triangles(blob, points, nearest, {}).status == QueryStatus::ok);
}

}  // namespace
}  // namespace espalier::tests::arrays_test
