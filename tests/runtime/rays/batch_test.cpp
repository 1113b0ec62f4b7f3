// Claims about batches of rays: the answers of one call for each ray, to the bit, whatever stands next to it.
#include "support/testing.hpp"

#include "support/machine/instruction_paths.hpp"

namespace espalier::tests::batch_test {
namespace {

/// Neighbours of one ray: what is answered as a group, most often.
void add_alike(std::vector<Ray>& rays, QueryMaker& maker, std::size_t count) {
    const Ray first = maker.any_ray();
    for (std::size_t i = 0; i < count; ++i) {
        Ray ray = first;
        ray.direction = sum(first.direction, maker.random().in_cube(largest(first.direction) * 0.05f));
        if (maker.random().below(4) == 0) maker.restrict(ray);
        rays.push_back(ray);
    }
}

/// The same direction from everywhere, and axis by axis in turn: neighbours that part early or differ in signs.
void add_almost_alike(std::vector<Ray>& rays, QueryMaker& maker, std::size_t count) {
    const Ray first = maker.ray(RayKind::axis_parallel);
    for (std::size_t i = 0; i < count; ++i) {
        Ray ray = first;
        if (i % 3 != 0) ray.direction = sum(first.direction, maker.random().in_cube(largest(first.direction) * 0.001f));
        rays.push_back(ray);
    }
}

void add_hostile(std::vector<Ray>& rays, Random& random) {
    const auto value = [&] { return hostile_values[random.below(hostile_values.size())]; };
    rays.push_back({.origin = {value(), value(), value()},
                    .direction = {value(), value(), value()},
                    .t_min = value(),
                    .t_max = value(),
                    .culling = static_cast<FaceCulling>(random.below(4))});
}

/// A ray that is like its neighbours but for one number.
void spoil_some(std::vector<Ray>& rays, Random& random) {
    for (Ray& ray : rays) {
        if (random.below(24) != 0) continue;
        *numbers_of(ray)[random.below(8)] = hostile_values[random.below(hostile_values.size())];
    }
}

/// Runs of all sorts and lengths, so that groups begin and end everywhere.
std::vector<Ray> mixed_rays(QueryMaker& maker, std::size_t count) {
    std::vector<Ray> rays;
    Random& random = maker.random();
    while (rays.size() < count) {
        const std::size_t run = 1 + random.below(60);
        const auto kind = random.below(4);
        if (kind == 0)
            for (std::size_t i = 0; i < run; ++i) rays.push_back(maker.any_ray());
        else if (kind == 1) add_alike(rays, maker, run);
        else if (kind == 2) add_almost_alike(rays, maker, run);
        else add_hostile(rays, random);
    }
    rays.resize(count);
    spoil_some(rays, random);
    return rays;
}

struct Expected {
    std::vector<RayHit> hits;
    std::vector<YesNo> occluded;
    std::size_t count = 0;  ///< of those that hit
};

Expected one_by_one(const Blob& blob, const std::vector<Ray>& rays) {
    Expected expected;
    for (const Ray& ray : rays) {
        const RayHit hit = detail::scalar::closest_hit(detail::data_of(blob), ray, {});
        expected.hits.push_back(hit);
        expected.occluded.push_back(YesNo(hit.status));
        expected.count += hit ? 1u : 0u;
    }
    return expected;
}

/// What no query writes.
constexpr YesNo untouched(QueryStatus::work_limit);
const RayHit untouched_hit = {-5.0f, 1.0f, 2.0f, {3.0f, 4.0f, 5.0f}, {6}, QueryStatus::work_limit, Side::back, {7, 8}};

/// The number of the first ray that is answered differently, or how many there are.
template <class ClosestHits, class AnyHits>
std::size_t first_difference(const Expected& expected, ClosestHits closest_hits, AnyHits any_hits) {
    const std::size_t size = expected.hits.size();
    std::vector<RayHit> hits(size, untouched_hit);
    std::vector<YesNo> occluded(size, untouched);
    closest_hits(hits);
    any_hits(occluded);
    std::size_t i = 0;
    while (i < size && same_bits(hits[i], expected.hits[i]) && occluded[i] == expected.occluded[i]) ++i;
    return i;
}

/// The same blob as a batch answers it whose nodes and leaves are beyond a cache. Queries of rays use the size of
/// leaves for nothing else.
detail::BlobData as_if_large(const Blob& blob) {
    detail::BlobData large = detail::data_of(blob);
    large.leaf_bytes = 1u << 30;
    return large;
}

/// How many rays hit.
std::size_t check_batch(const Blob& blob, const std::vector<Ray>& rays) {
    const Expected expected = one_by_one(blob, rays);
    for (const InstructionPath& path : instruction_paths()) {
        const std::string name = path.name;
        CAPTURE(name);
        for (const detail::BlobData& asset : {detail::data_of(blob), as_if_large(blob)}) {
            CAPTURE(asset.leaf_bytes);
            const std::size_t different = first_difference(
                expected,
                [&](std::vector<RayHit>& hits) { path.closest_hits(asset, rays.data(), hits.data(), rays.size()); },
                [&](std::vector<YesNo>& answers) { path.any_hits(asset, rays.data(), answers.data(), rays.size()); });
            REQUIRE_MESSAGE(different == rays.size(), "ray ", different, ": ", describe(rays[different % rays.size()]));
        }
    }
    REQUIRE(first_difference(
                expected, [&](std::vector<RayHit>& hits) { REQUIRE(raycast(blob, rays, hits).count == rays.size()); },
                [&](std::vector<YesNo>& answers) { REQUIRE(occluded(blob, rays, answers).count == rays.size()); }) ==
            rays.size());
    return expected.count;
}

void check_batches(const std::vector<TestBlob>& blobs, std::uint64_t batches) {
    for (const std::size_t number : sampled(blobs.size(), every_profile.size())) {
        const TestBlob& blob = blobs[number];
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, 400);
        std::size_t rays = 0, hits = 0;
        for (std::uint64_t batch = 0; batch < batches; ++batch) {
            const std::size_t count = maker.random().below(400);
            hits += check_batch(blob.opened.blob, mixed_rays(maker, count));
            rays += count;
        }
        // Rays that all miss would prove nothing.
        CHECK(hits > rays / 20);
    }
}

/// Sixteen rays from each corner of each triangle, on every path, against one call for each. How many hit at once.
std::uint32_t check_beginnings(const Blob& blob) {
    std::uint32_t at_once = 0;
    for (const std::size_t index : sampled(blob.triangle_count(), 8)) {
        const Triangle corners = *triangle_at(blob, {static_cast<std::uint32_t>(index)});
        for (const Vec3 origin : {corners.a, corners.b, corners.c}) {
            std::vector<Ray> rays(16, Ray{origin, {0.25f, 0.125f, -1.0f}});
            for (std::size_t i = 0; i < rays.size(); ++i) rays[i].direction.x += static_cast<float>(i) * 0x1p-9f;
            std::vector<RayHit> hits(rays.size());
            for (const InstructionPath& path : instruction_paths()) {
                path.closest_hits(detail::data_of(blob), rays.data(), hits.data(), rays.size());
                CAPTURE(path.name);
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    const RayHit alone = raycast(blob, rays[i]);
                    at_once += alone && alone.t == 0.0f && i == 0 ? 1u : 0u;
                    CHECK(same_bits(alone, hits[i]));
                }
            }
        }
    }
    return at_once;
}

/// Small triangles and large ones, which spatial splits cut; two have their first corner in common.
Mesh make_soup_of_pairs() {
    Mesh mesh = make_soup(400, 3);
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i)
        mesh.triangles.push_back(
            {mesh.triangles[i][0], mesh.triangles[(i + 1) % count][1], mesh.triangles[(i + 2) % count][2]});
    return mesh;
}

TEST_CASE("batch: each ray gets the answer of a single call on every path") {
    check_batches(small_test_blobs(), scaled_share(12));
    check_batches(medium_test_blobs(), scaled_share(12));
}

TEST_CASE("batch: each ray gets the answer of a single call also with copies") {
    const OpenedBlob opened(make_soup(400, 3), with_copies());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    const DecodedBlob decoded = decode(opened.bytes);
    QueryMaker maker(decoded, 401);
    std::size_t hits = 0;
    for (std::uint64_t batch = 0; batch < scaled(12); ++batch) hits += check_batch(opened.blob, mixed_rays(maker, 300));
    CHECK(hits > 0);
}

TEST_CASE("batch: groups of only alike or only unlike or only invalid rays give the same answers") {
    for (const TestBlob& blob : medium_test_blobs()) {
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, 402);
        std::vector<Ray> alike, strangers, nonsense;
        add_alike(alike, maker, std::max<std::size_t>(48, std::min<std::size_t>(256, scaled(256))));
        for (std::uint64_t i = 0; i < scaled(600); ++i) strangers.push_back(maker.any_ray());
        for (std::uint64_t i = 0; i < scaled(100); ++i) add_hostile(nonsense, maker.random());
        check_batch(blob.opened.blob, alike);
        check_batch(blob.opened.blob, strangers);
        check_batch(blob.opened.blob, nonsense);
    }
}

TEST_CASE("batch: a batch that begins where triangles meet gives the first of them") {
    for (const bool has_copies : {false, true})
        for_each_profile([&](Profile profile) {
            if (has_copies && profile != Profile::fast) return;
            BakeOptions options = with_profile(profile);
            options.resolution = Resolution::bits(10);  // then floats hold every vertex
            if (has_copies) {
                options.build.builder = Builder::spatial_splits;
                options.build.duplicate_budget = 1.0;
            }
            const OpenedBlob opened(has_copies ? make_soup_of_pairs() : make_terrain(20, 3), options);
            if (has_copies) REQUIRE(opened.blob.duplicate_reference_count() > 20);
            CHECK(check_beginnings(opened.blob) > rounds_per_case(300) / 2);
        });
}

TEST_CASE("batch: spans of different sizes and a blob that is not open are refused and nothing is written") {
    const OpenedBlob opened(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f})), empty(Mesh{});
    const Ray ray = {.origin = {0.0f, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    for (const Blob& blob : {opened.blob, empty.blob, Blob()}) {
        for (const std::size_t rays_size : {0u, 1u, 15u, 16u, 17u, 40u}) {
            for (const std::size_t answers_size : {0u, 1u, 15u, 16u, 17u, 40u}) {
                const std::vector<Ray> rays(rays_size, ray);
                std::vector<RayHit> hits(answers_size, untouched_hit);
                std::vector<YesNo> answers(answers_size, untouched);
                const bool is_written = blob && rays_size == answers_size;
                const QueryStatus expected = !blob        ? QueryStatus::not_open
                                             : is_written ? QueryStatus::ok
                                                          : QueryStatus::invalid_argument;
                for (const Filled& filled : {raycast(blob, rays, hits), occluded(blob, rays, answers)}) {
                    CHECK(filled.status == expected);
                    CHECK(filled.count == (is_written ? rays_size : 0));
                }
                for (std::size_t i = 0; i < answers_size; ++i) {
                    REQUIRE(same_bits(hits[i], is_written ? raycast(blob, ray) : untouched_hit));
                    REQUIRE(answers[i] == (is_written ? occluded(blob, ray) : untouched));
                }
            }
        }
    }
}

TEST_CASE("batch: the number for no triangle belongs to no triangle") {
    CHECK(no_triangle.index == 0xFFFFFFFFu);
    CHECK(no_triangle.index >= format::max_triangles);
}

}  // namespace
}  // namespace espalier::tests::batch_test
