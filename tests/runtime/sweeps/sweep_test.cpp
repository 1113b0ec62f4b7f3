// Claims about sweeps: they equal the loop over all triangles, agree with the overlap queries, and have manners.
#include "support/testing.hpp"

#include <runtime/sweeps/queries.hpp>

#include "support/loops/triangle_loop.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/sweep_maker.hpp"

namespace espalier::tests::sweep_test {
namespace {

bool third_is_left_out(TriangleId triangle) { return triangle.index % 3 != 2; }

constexpr unsigned option_sets = 6;

/// All triangles, then those that the filter leaves, then other options.
SweepOptions options_of(unsigned number, float skin) {
    SweepOptions options;
    if (number == 1 || number == 5) options.filter = third_is_left_out;
    if (number == 2 || number == 5) options.culling = FaceCulling::back;
    if (number == 3) options.culling = FaceCulling::front;
    options.ignore_leaving = number >= 3;
    if (number == 4 || number == 5) options.skin = skin;
    return options;
}

/// What the loop says.
template <class Shape>
std::array<SweepHit, option_sets> ask(const TriangleLoop& loop, const Blob& blob, const Moving<Shape>& moving,
                                      float skin) {
    const detail::BlobData& data = detail::data_of(blob);
    auto sweep = sweep_of(moving.shape);
    std::array<SweepHit, option_sets> hits;
    hits.fill(SweepHit{});
    const QueryStatus status = round_sweep(data, moving.shape, moving.displacement, sweep);
    for (unsigned i = 0; i < option_sets; ++i) {
        hits[i].status = status;
        if (status != QueryStatus::ok) continue;
        hits[i].status = QueryStatus::not_found;
        hits[i].t = 1.0f;
        const SweepOptions options = options_of(i, skin);
        const auto all = [](TriangleId) { return true; };
        const detail::FoundContact found = options.filter ? loop.first_contact(sweep, third_is_left_out, options)
                                                          : loop.first_contact(sweep, all, options);
        if (found.tick != detail::no_contact)
            hits[i] = to_sweep_hit(data, sweep, found, detail::radius_in_steps(data, options.skin));
    }
    return hits;
}

struct Seen {
    std::uint64_t hits = 0, starts = 0, asked = 0;
    std::uint64_t left = 0;  ///< at the start, with the option that ignores what is left
};

template <class Shape>
void require_equal(const Blob& blob, const TriangleLoop& loop, const Moving<Shape>& moving, Seen& seen) {
    const float skin = std::ldexp(static_cast<float>(seen.asked % 8), blob.lattice().step_exponent);
    const auto expected = ask(loop, blob, moving, skin);
    for (unsigned i = 0; i < option_sets; ++i) {
        CAPTURE(i);
        const SweepHit hit = sweep(blob, query_shape(moving.shape), moving.displacement, options_of(i, skin));
        REQUIRE_MESSAGE(same_bits(hit, expected[i]), describe(moving));
        if (i == 3 && expected[0].starts_overlapping && !hit.starts_overlapping) ++seen.left;
        if (i != 0 || !hit) continue;
        ++seen.hits;
        seen.starts += hit.starts_overlapping ? 1 : 0;
        REQUIRE_MESSAGE(std::fabs(dot(hit.normal, hit.normal) - 1.0f) < 0x1p-20f, describe(moving));
    }
    ++seen.asked;
}

constexpr std::size_t shape_kinds = 5;

/// Two random sweeps to each awkward one.
void check_sweeps(const Blob& blob, const DecodedBlob& decoded, std::uint64_t seed, std::uint64_t count, Seen* seen) {
    const TriangleLoop loop(decoded);
    SweepMaker maker(decoded, seed);
    for (std::uint64_t i = 0; i < count; ++i) {
        maker.make_shapes(i % 3 == 0,
                          [&](const auto& moving, int kind) { require_equal(blob, loop, moving, seen[kind]); });
    }
}

void tell_calls(const std::string& mesh, std::uint64_t count, std::uint64_t meshes = 1) {
    const std::uint64_t awkward = (count + 2) / 3;
    for (const char* shape : {"spheres", "capsules", "boxes", "oriented boxes", "hulls"})
        MESSAGE(calls_made(std::string("sweeps: ") + shape, mesh, (count - awkward) * meshes, awkward * meshes));
}

void check_blobs(const std::vector<TestBlob>& blobs, std::uint64_t count) {
    Seen seen[shape_kinds];
    std::uint64_t seed = 500;
    for (const TestBlob& blob : blobs) {
        CAPTURE(blob.name);
        check_sweeps(blob.opened.blob, blob.decoded, seed++, count, seen);
    }
    tell_calls(generated_meshes, count, blobs.size());
    if (!asks_enough()) return;
    for (const Seen& each : seen) {
        CHECK(each.hits > each.asked / 5);
        CHECK(each.starts > each.asked / 50);
        CHECK(each.starts < each.hits);
        CHECK(each.left > each.asked / 200);
    }
}

bool same(const detail::Integer3& a, const detail::Integer3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

struct Cube {
    explicit Cube(Profile profile) : opened(make_cube(-1.0f, 1.0f), with_profile(profile)) {}
    OpenedBlob opened;
    [[nodiscard]] const Blob& blob() const { return opened.blob; }
};

TEST_CASE("sweep: every shape equals the loop on small meshes") { check_blobs(small_test_blobs(), scaled_share(45)); }
TEST_CASE("sweep: every shape equals the loop on medium meshes") { check_blobs(medium_test_blobs(), scaled_share(6)); }
TEST_CASE("sweep: blobs with copies equal the loop") {
    const OpenedBlob opened(make_soup(400, 3), with_copies());
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    Seen seen[shape_kinds];
    check_sweeps(opened.blob, decode(opened.bytes), 500, scaled(150), seen);
    for (const Seen& each : seen) CHECK(each.hits > each.asked / 5);
}
TEST_CASE("sweep: every shape equals the loop on real meshes") {
    for_each_real_mesh([](const Mesh& mesh, Profile profile) {
        const OpenedBlob opened(mesh, with_profile(profile));
        const DecodedBlob decoded = decode(opened.bytes);
        Seen seen[shape_kinds];
        // Times a scale of 1,000 these are at least the counts that a release must show, all profiles together.
        const std::uint64_t count = scaled_share(decoded.triangles.size() > 200'000 ? 2 : 151);
        check_sweeps(opened.blob, decoded, 510 + static_cast<std::uint64_t>(profile), count, seen);
        tell_calls(mesh.name, count);
        for (const Seen& each : seen)
            if (count >= 20) CHECK(each.hits > 0);  // fewer may all pass by
    });
}

TEST_CASE("sweep: a first contact has time and point and normal") {
    for_each_profile([](Profile profile) {
        const Cube cube(profile);
        SweepHit hit = sweep(cube.blob(), Sphere{{0.25f, 0.5f, 5.0f}, 1.0f}, {0.0f, 0.0f, -6.0f});
        CHECK(hit.face_normal == Vec3{0.0f, 0.0f, 1.0f});
        CHECK(hit.t == doctest::Approx(0.5));
        CHECK(hit.t <= 0.5f);
        CHECK(hit.point.z == doctest::Approx(1.0));
        CHECK(hit.point.x == doctest::Approx(0.25).epsilon(0.001));
        CHECK(tests::same_bits(hit.normal.z, 1.0f));
        CHECK_FALSE(hit.starts_overlapping);

        // A corner.
        hit = sweep(cube.blob(), Sphere{{5.0f, 5.0f, 5.0f}, 1.0f}, {-8.0f, -8.0f, -8.0f});
        CHECK(hit.t == doctest::Approx((4.0 - std::sqrt(1.0 / 3.0)) / 8.0).epsilon(0.0001));
        CHECK(hit.normal.x == doctest::Approx(std::sqrt(1.0 / 3.0)).epsilon(0.001));
        CHECK(hit.point.x == doctest::Approx(1.0));

        hit = sweep(cube.blob(), Capsule{{0.0f, 0.0f, 3.0f}, {0.0f, 0.0f, 9.0f}, 0.5f}, {0.0f, 0.0f, -3.0f});
        CHECK(hit.t == doctest::Approx(0.5));
        CHECK(hit.normal.z == doctest::Approx(1.0));

        hit = sweep(cube.blob(), Box{{-0.5f, -0.5f, 2.0f}, {0.5f, 0.5f, 3.0f}}, {0.0f, 0.0f, -2.0f});
        CHECK(hit.t == doctest::Approx(0.5));
        CHECK(tests::same_bits(hit.normal.z, 1.0f));
        CHECK(hit.point.z == doctest::Approx(1.0));
        CHECK(std::fabs(hit.point.x) <= 0.51f);
        CHECK(std::fabs(hit.point.y) <= 0.51f);
    });
}

TEST_CASE("sweep: a box and the same as an oriented one and as a hull take the same time") {
    std::uint64_t hits = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        if (blob.decoded.triangle_count == 0) continue;
        CAPTURE(blob.name);
        SweepMaker maker(blob.decoded, 503);
        const auto& data = detail::data_of(blob.opened.blob);
        for (std::uint64_t i = 0; i < scaled_share(300); ++i) {
            const Moving<Box> moving = maker.box(i % 3 == 0);
            const Box& box = moving.shape;
            const Vec3& way = moving.displacement;
            detail::BoxSweep aligned;
            if (round_sweep(data, box, way, aligned) != QueryStatus::ok) continue;
            // The rounded box, on whose grid no shape is rounded again.
            const auto in_world = [&](const detail::Integer3& at) {
                const float unit = std::ldexp(1.0f, data.step_exponent - aligned.fraction_bits);
                const auto axis = [&](std::int64_t units, float origin) {
                    return origin + static_cast<float>(units) * unit;
                };
                return Vec3{axis(at.x, data.origin[0]), axis(at.y, data.origin[1]), axis(at.z, data.origin[2])};
            };
            const Vec3 low = in_world(aligned.low), high = in_world(aligned.high);
            std::vector<Vec3> corners;
            for (unsigned c = 0; c < 8; ++c)
                corners.push_back(
                    {(c & 1u) != 0 ? low.x : high.x, (c & 2u) != 0 ? low.y : high.y, (c & 4u) != 0 ? low.z : high.z});
            const OrientedBox turned = {{(low.x + high.x) / 2.0f, (low.y + high.y) / 2.0f, (low.z + high.z) / 2.0f},
                                        {{0.0f, 0.0f, (high.z - low.z) / 2.0f},
                                         {(high.x - low.x) / 2.0f, 0.0f, 0.0f},
                                         {0.0f, (low.y - high.y) / 2.0f, 0.0f}}};
            const auto is_same = [&](const detail::HullSweep& rounded) {
                return rounded.fraction_bits == aligned.fraction_bits && same(rounded.low, aligned.low) &&
                       same(rounded.high, aligned.high) && same(rounded.displacement, aligned.displacement);
            };
            const SweepHit expected = sweep(blob.opened.blob, box, way);
            const auto compare = [&](const auto& shape) {
                detail::HullSweep rounded;
                if (round_sweep(data, shape, way, rounded) != QueryStatus::ok || !is_same(rounded)) return;
                const SweepHit hit = sweep(blob.opened.blob, shape, way);
                REQUIRE_MESSAGE(hit.status == expected.status, describe(moving));
                REQUIRE_MESSAGE(hit.t == expected.t, describe(moving));
                // At the start the depth in a triangle decides, which a hull tells by fewer directions.
                if (!hit.starts_overlapping || rounded.is_box)
                    REQUIRE_MESSAGE(hit.triangle == expected.triangle, describe(moving));
                hits += hit ? 1u : 0u;
            };
            compare(turned);
            compare(ConvexHull{corners});
        }
    }
    if (asks_enough()) CHECK(hits > 1000);
}

TEST_CASE("sweep: hulls have as many vertices as are allowed or none") {
    const Cube cube(Profile::balanced);
    const Vec3 down = {0.0f, 0.0f, -4.0f};
    std::vector<Vec3> vertices(max_hull_vertices + 1, Vec3{0.25f, 0.5f, 3.0f});
    vertices[max_hull_vertices - 1] = {0.25f, 0.5f, 2.0f};
    const auto of = [&](std::size_t count) { return ConvexHull{std::span<const Vec3>(vertices).first(count)}; };
    SweepHit hit = sweep(cube.blob(), of(max_hull_vertices), down);
    CHECK(hit.t == doctest::Approx(0.25));
    CHECK(hit.normal == Vec3{0.0f, 0.0f, 1.0f});
    CHECK(hit.point.x == doctest::Approx(0.25).epsilon(0.001));
    CHECK(hit.point.y == doctest::Approx(0.5).epsilon(0.001));
    CHECK(hit.point.z == doctest::Approx(1.0));
    CHECK(sweep(cube.blob(), of(1), down).t == doctest::Approx(0.5));
    CHECK(sweep(cube.blob(), of(max_hull_vertices + 1), down).status == QueryStatus::invalid_argument);
    hit = sweep(cube.blob(), of(0), down);
    CHECK(hit.status == QueryStatus::not_found);
    CHECK(hit.t == 1.0f);
    CHECK(sweep(cube.blob(), of(0), {not_a_number, 0.0f, 0.0f}).status == QueryStatus::invalid_argument);
    // An oriented box that stands on an edge.
    const OrientedBox box = {{0.0f, 0.0f, 3.0f}, {{0.5f, 0.0f, 0.5f}, {-0.5f, 0.0f, 0.5f}, {0.0f, 0.25f, 0.0f}}};
    hit = sweep(cube.blob(), box, down);
    CHECK(hit.t == doctest::Approx(0.25));
    CHECK(hit.normal.z == doctest::Approx(1.0));
    CHECK(hit.point.x == doctest::Approx(0.0).epsilon(0.001));
    CHECK(std::fabs(hit.point.y) <= 0.26f);
}

TEST_CASE("sweep: a sphere touches exactly when the capsule along its way overlaps") {
    std::uint64_t touched = 0, asked = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        SweepMaker maker(blob.decoded, 502);
        const float step = std::ldexp(1.0f, blob.opened.blob.lattice().step_exponent);
        // Whole steps from the lattice's origin: both queries round nothing.
        const auto snap = [&](Vec3 at, Vec3 from) {
            const auto axis = [&](float a, float b) { return b + std::nearbyint((a - b) / step) * step; };
            return Vec3{axis(at.x, from.x), axis(at.y, from.y), axis(at.z, from.z)};
        };
        const Vec3 origin = blob.opened.blob.bounds().min;
        for (std::uint64_t i = 0; i < scaled_share(300); ++i) {
            Moving<Sphere> moving = maker.sphere(i % 3 == 0);
            moving.shape.center = snap(moving.shape.center, origin);
            moving.shape.radius = std::nearbyint(moving.shape.radius / step) * step;
            const Vec3 end = snap(sum(moving.shape.center, moving.displacement), origin);
            moving.displacement = difference(end, moving.shape.center);
            detail::CapsuleSweep rounded;
            detail::RoundedSegment segment;
            const auto& data = detail::data_of(blob.opened.blob);
            if (round_sweep(data, moving.shape, moving.displacement, rounded) != QueryStatus::ok ||
                round_segment(data, {moving.shape.center, end}, segment) != QueryStatus::ok)
                continue;
            const int shift = segment.fraction_bits - rounded.fraction_bits;
            const detail::Integer3 to = rounded.from + rounded.displacement;
            if (shift < 0 || segment.from[0] != rounded.from.x << shift || segment.from[1] != rounded.from.y << shift ||
                segment.from[2] != rounded.from.z << shift || segment.to[0] != to.x << shift ||
                segment.to[1] != to.y << shift || segment.to[2] != to.z << shift)
                continue;
            const SweepHit hit = sweep(blob.opened.blob, query_shape(moving.shape), moving.displacement);
            const bool found{hit};
            REQUIRE_MESSAGE(
                found == overlaps(blob.opened.blob, Capsule{moving.shape.center, end, moving.shape.radius}).yes(),
                describe(moving));
            ++asked;
            touched += found ? 1 : 0;
            const bool starts{sweep(blob.opened.blob, query_shape(moving.shape), {0.0f, 0.0f, 0.0f})};
            REQUIRE(starts == overlaps(blob.opened.blob, moving.shape).yes());
            REQUIRE((!found || hit.starts_overlapping == starts));
        }
    }
    CHECK(touched > asked / 4);
    CHECK(asked > 13 * scaled_share(300));
}

TEST_CASE("sweep: contact at the start gives t 0 and the deepest triangle and a normal to the middle") {
    for_each_profile([](Profile profile) {
        const Cube cube(profile);
        // Both triangles of the top are as deep.
        const auto top = [&] {
            std::uint32_t first = no_triangle.index;
            (void)for_each_overlap(cube.blob(), Box{{-0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, 1.5f}},
                                   [&](TriangleId triangle) { return first = triangle.index, Visit::stop; });
            return first;
        }();
        const Vec3 anywhere = {1.0f, 2.0f, 3.0f};
        const Sphere sphere = {{0.25f, 0.5f, 1.5f}, 1.0f};
        SweepHit hit = sweep(cube.blob(), sphere, anywhere);
        CHECK(hit.starts_overlapping);
        CHECK(hit.t == 0.0f);
        CHECK(hit.triangle == closest_point(cube.blob(), sphere.center).triangle);
        CHECK(hit.feature == Feature::face);
        const Capsule capsule = {{0.0f, 0.0f, 0.5f}, {0.0f, 0.0f, 2.5f}, 0.125f};
        hit = sweep(cube.blob(), capsule, anywhere);
        CHECK(hit.starts_overlapping);
        CHECK(hit.triangle.index == top);
        CHECK(hit.normal.z == doctest::Approx(1.0));
        const Box box = {{-0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 3.0f}};
        hit = sweep(cube.blob(), box, anywhere);
        CHECK(hit.starts_overlapping);
        CHECK(hit.triangle.index == top);
        // Touching from outside, and moving away.
        hit = sweep(cube.blob(), Sphere{{0.25f, 0.5f, 2.0f}, 1.0f}, {0.0f, 0.0f, 1.0f});
        CHECK(hit.starts_overlapping);
        // Inside, touching nothing.
        CHECK_FALSE(sweep(cube.blob(), Sphere{{0.0f, 0.0f, 0.0f}, 0.5f}, {0.0f, 0.0f, 0.25f}));
    });
}

TEST_CASE("sweep: shapes without size and ways without length are valid") {
    for_each_profile([](Profile profile) {
        const Cube cube(profile);
        const Vec3 down = {0.0f, 0.0f, -2.0f};
        const Vec3 nowhere = {0.0f, -0.0f, 0.0f};
        const Vec3 at = {0.25f, 0.5f, 2.0f};
        const SweepHit of_sphere = sweep(cube.blob(), Sphere{at, 0.0f}, down);
        const SweepHit of_capsule = sweep(cube.blob(), Capsule{at, at, 0.0f}, down);
        const SweepHit of_box = sweep(cube.blob(), Box{at, at}, down);
        REQUIRE(of_sphere);
        REQUIRE(of_capsule);
        REQUIRE(of_box);
        CHECK(of_sphere.t == doctest::Approx(0.5));
        CHECK(same_bits(of_sphere, of_capsule));
        CHECK(of_sphere.t == of_box.t);
        CHECK(of_sphere.triangle == of_box.triangle);
        CHECK(of_sphere.normal == of_box.normal);
        CHECK(of_box.point.z == doctest::Approx(1.0));
        CHECK(sweep(cube.blob(), Sphere{at, 0.5f}, nowhere).status == QueryStatus::not_found);
        CHECK(sweep(cube.blob(), Sphere{at, 1.0f}, nowhere).starts_overlapping);
        const SweepHit of_nothing = sweep(cube.blob(), Box{{2.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}}, down);
        CHECK(of_nothing.status == QueryStatus::not_found);
        CHECK(of_nothing.t == 1.0f);
    });
}

TEST_CASE("sweep: a refused sweep has t 0 and a missed one t 1") {
    const Cube cube(Profile::balanced);
    const Blob& blob = cube.blob();
    const Vec3 zero = {0.0f, 0.0f, 0.0f};
    const auto refused = [&](const auto& shape, Vec3 way, QueryStatus status) {
        SweepHit expected;
        CHECK(expected.t == 0.0f);
        CHECK(same_bits(sweep(Blob(), shape, way), expected));
        expected.status = status;
        CHECK(same_bits(sweep(blob, shape, way), expected));
    };
    for (const float bad : {not_a_number, infinity, -infinity}) {
        refused(Sphere{{bad, 0.0f, 0.0f}, 1.0f}, zero, QueryStatus::invalid_argument);
        refused(Sphere{zero, bad}, zero, QueryStatus::invalid_argument);
        refused(Sphere{zero, 1.0f}, {0.0f, bad, 0.0f}, QueryStatus::invalid_argument);
        refused(Capsule{zero, {0.0f, 0.0f, bad}, 1.0f}, zero, QueryStatus::invalid_argument);
        refused(Box{{bad, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}}, zero, QueryStatus::invalid_argument);
        refused(Box{zero, {1.0f, 1.0f, 1.0f}}, {bad, 0.0f, 0.0f}, QueryStatus::invalid_argument);
    }
    const OrientedBox bad_box = {zero, {{1.0f, 0.0f, 0.0f}, {0.0f, not_a_number, 0.0f}, zero}};
    refused(bad_box, zero, QueryStatus::invalid_argument);
    refused(OrientedBox{{0.0f, infinity, 0.0f}, {zero, zero, zero}}, zero, QueryStatus::invalid_argument);
    refused(OrientedBox{zero, {zero, zero, zero}}, {0.0f, infinity, 0.0f}, QueryStatus::invalid_argument);
    const std::array<Vec3, 2> bad_vertices = {zero, {0.0f, 0.0f, infinity}};
    refused(ConvexHull{bad_vertices}, zero, QueryStatus::invalid_argument);
    refused(Sphere{zero, -1.0f}, zero, QueryStatus::invalid_argument);
    refused(Capsule{zero, zero, -1.0f}, zero, QueryStatus::invalid_argument);
    CHECK(sweep(blob, Sphere{zero, -0.0f}, zero).status == QueryStatus::not_found);
    const float far = 0x1p35f * std::ldexp(1.0f, blob.lattice().step_exponent);
    refused(Sphere{{far, 0.0f, 0.0f}, 1.0f}, zero, QueryStatus::out_of_range);
    refused(Sphere{zero, far}, zero, QueryStatus::out_of_range);
    refused(Sphere{zero, 1.0f}, {0.0f, far, 0.0f}, QueryStatus::out_of_range);
    refused(Capsule{zero, {0.0f, 0.0f, 0x1p26f * std::ldexp(1.0f, blob.lattice().step_exponent)}, 1.0f}, zero,
            QueryStatus::out_of_range);
    refused(Box{{-far, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}}, zero, QueryStatus::out_of_range);
    const float far_for_hulls = far * 0x1p-5f;
    const std::array<Vec3, 1> far_vertex = {{{far_for_hulls, 0.0f, 0.0f}}}, some_vertex = {{zero}};
    refused(ConvexHull{far_vertex}, zero, QueryStatus::out_of_range);
    refused(ConvexHull{some_vertex}, {far_for_hulls, 0.0f, 0.0f}, QueryStatus::out_of_range);
    refused(OrientedBox{zero, {{far_for_hulls, 0.0f, 0.0f}, zero, zero}}, zero, QueryStatus::out_of_range);
    refused(OrientedBox{{0.0f, far_for_hulls, 0.0f}, {zero, zero, zero}}, zero, QueryStatus::out_of_range);
    const float most = std::numeric_limits<float>::max();
    refused(Box{{-most, -most, -most}, {most, most, most}}, {most, most, most}, QueryStatus::out_of_range);

    const OpenedBlob empty(Mesh{});
    SweepHit miss;
    miss.status = QueryStatus::not_found;
    miss.t = 1.0f;
    CHECK(same_bits(sweep(empty.blob, Sphere{zero, 1.0f}, zero), miss));
    CHECK(same_bits(sweep(empty.blob, Capsule{zero, zero, 1.0f}, zero), miss));
    CHECK(same_bits(sweep(empty.blob, Box{zero, zero}, zero), miss));
    CHECK(same_bits(sweep(blob, Sphere{{9.0f, 9.0f, 9.0f}, 1.0f}, zero), miss));
    CHECK(sweep(empty.blob, Sphere{zero, -1.0f}, zero).status == QueryStatus::invalid_argument);

    // Just within range: a sphere larger than the asset from far away.
    const SweepHit hit = sweep(blob, Sphere{{0.0f, 0.0f, far / 4.0f}, far / 8.0f}, {0.0f, 0.0f, -far / 4.0f});
    CHECK(hit.t == doctest::Approx(0.5));
}

TEST_CASE("sweep: of contacts at the start the deepest is that of find_contacts") {
    const OpenedBlob opened(make_icosphere(3, 4.0, {0.0f, 0.0f, 0.0f}));
    Random random(77);
    std::uint64_t compared = 0;
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        const Vec3 off = random.in_cube(1.0f);
        const float length = std::sqrt(dot(off, off)), out = 4.3f / length;
        const Vec3 at = times(off, out), way = random.in_cube(1.0f);
        const Vec3 end = {at.x + 0.1f * way.y, at.y + 0.1f * way.z, at.z + 0.1f * way.x};
        const auto compare = [&](const auto& shape, float error) {
            std::array<Contact, 64> contacts;
            const Filled found = find_contacts(opened.blob, shape, 0.0f, contacts);
            const SweepHit hit = sweep(opened.blob, shape, way);
            if (found.count == 0 || found.status != QueryStatus::ok || contacts[0].distance > -0.001f) return;
            REQUIRE(hit.starts_overlapping);
            float deepest = 0.0f;  // of the triangle
            for (const Contact& contact : found.in(contacts))
                if (contact.triangle == hit.triangle) deepest = std::min(deepest, contact.distance);
            REQUIRE(deepest <= contacts[0].distance + error);
            ++compared;
        };
        compare(Sphere{at, 0.5f}, 0x1p-10f);
        compare(Capsule{at, end, 0.5f}, 0x1p-10f);
        compare(OrientedBox{at, {{0.4f, 0.1f, 0.0f}, {-0.1f, 0.4f, 0.1f}, {0.0f, 0.1f, 0.4f}}}, 0x1p-10f);
    }
    if (asks_enough()) CHECK(compared > scaled(2'000));
}

TEST_CASE("sweep: braces mean options and a callable is a filter") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Sphere sphere = {{0.0f, 0.0f, 3.0f}, 1.0f};
    const Vec3 way = {0.0f, 0.0f, -2.0f};
    const float t = sweep(cube.blob, sphere, way).t;
    CHECK(t < 1.0f);
    CHECK(sweep(cube.blob, sphere, way, {}).t == t);
    CHECK(sweep(cube.blob, sphere, way, {.skin = 0.5f}).t < t);
    std::uint32_t asked = 0;
    auto nothing = [&asked](TriangleId) mutable { return ++asked == 0; };
    CHECK(sweep(cube.blob, sphere, way, nothing).t == 1.0f);
    CHECK(asked > 0);
}

TEST_CASE("sweep: culled faces are passed from the side that is ignored") {
    for_each_profile([](Profile profile) {
        const Cube cube(profile);
        const auto hit = [&](const auto& shape, const Vec3& way, FaceCulling culling) {
            return sweep(cube.blob(), shape, way, SweepOptions{.culling = culling});
        };
        const Vec3 up = {0.0f, 0.0f, 8.0f}, down = {0.0f, 0.0f, -8.0f}, above = {0.2f, 0.1f, 4.0f};
        const auto check = [&](const auto& inside, const auto& outside) {
            CHECK(hit(inside, up, FaceCulling::none));
            CHECK(hit(inside, up, FaceCulling::back).status == QueryStatus::not_found);
            CHECK(hit(inside, up, FaceCulling::front));
            const SweepHit first = hit(outside, down, FaceCulling::back);
            CHECK(same_bits(first, hit(outside, down, FaceCulling::none)));
            const SweepHit last = hit(outside, down, FaceCulling::front);
            REQUIRE((first && last));
            CHECK(first.face_normal.z == 1.0f);
            CHECK(last.face_normal.z == -1.0f);
            CHECK(last.t > first.t);
        };
        check(Sphere{{0.2f, 0.1f, 0.0f}, 0.25f}, Sphere{above, 0.25f});
        check(Capsule{{0.2f, 0.1f, 0.0f}, {0.3f, 0.1f, 0.1f}, 0.25f}, Capsule{above, {0.3f, 0.1f, 4.1f}, 0.25f});
        check(Box{{0.0f, 0.0f, 0.0f}, {0.2f, 0.3f, 0.4f}}, Box{{0.0f, 0.0f, 4.0f}, {0.2f, 0.3f, 4.4f}});
        const Vec3 half[3] = {{0.1f, 0.1f, 0.0f}, {-0.1f, 0.1f, 0.0f}, {0.0f, 0.0f, 0.2f}};
        check(OrientedBox{{0.2f, 0.1f, 0.0f}, {half[0], half[1], half[2]}},
              OrientedBox{above, {half[0], half[1], half[2]}});
        const std::array<Vec3, 4> low = {
            {{0.2f, 0.1f, 0.0f}, {0.4f, 0.1f, 0.1f}, {0.3f, 0.3f, -0.1f}, {0.3f, 0.2f, 0.2f}}};
        std::array<Vec3, 4> high = low;
        for (Vec3& vertex : high) vertex.z += 4.0f;
        check(ConvexHull{low}, ConvexHull{high});
    });
}

TEST_CASE("sweep: what the shape leaves is ignored and what it goes deeper into is not") {
    for_each_profile([](Profile profile) {
        const Cube cube(profile);
        const auto start = [&](const auto& shape, const Vec3& way) {
            return sweep(cube.blob(), shape, way, SweepOptions{.ignore_leaving = true});
        };
        // Each reaches a little into the top of the cube.
        const auto check = [&](const auto& shape) {
            for (const Vec3 away : {Vec3{0.0f, 0.0f, 1.0f}, {0.3f, 0.2f, 0.1f}, {0.25f, 0.125f, 0.0f}})
                CHECK(start(shape, away).status == QueryStatus::not_found);
            for (const Vec3 deeper : {Vec3{0.0f, 0.0f, -1.0f}, {0.3f, 0.2f, -0.1f}}) {
                const SweepHit hit = start(shape, deeper);
                CHECK(hit.starts_overlapping);
                CHECK(hit.t == 0.0f);
            }
        };
        check(Sphere{{0.25f, -0.5f, 1.1f}, 0.125f});
        check(Capsule{{0.25f, -0.5f, 1.1f}, {0.25f, -0.4f, 2.0f}, 0.125f});
        check(Box{{0.2f, -0.6f, 0.99f}, {0.4f, -0.4f, 2.0f}});
        check(OrientedBox{{0.25f, -0.5f, 1.1f}, {{0.1f, 0.1f, 0.0f}, {-0.1f, 0.1f, 0.0f}, {0.0f, 0.0f, 0.11f}}});
        const std::array<Vec3, 4> vertices = {
            {{0.2f, -0.5f, 0.99f}, {0.5f, -0.4f, 1.2f}, {0.1f, -0.3f, 1.2f}, {0.3f, -0.6f, 1.3f}}};
        check(ConvexHull{vertices});
        // A box that reaches over the edge of a wall goes deeper along the wall's plane.
        const Mesh wall = make_triangle({0.0f, 0.0f, -4.0f}, {0.0f, 4.0f, 0.0f}, {0.0f, 0.0f, 4.0f});
        const OpenedBlob opened(wall, with_profile(profile));
        const Box box = {{-0.25f, -1.0f, -0.25f}, {0.5f, 0.01f, 0.25f}};
        CHECK(sweep(opened.blob, box, {0.0f, 1.0f, 0.0f}, SweepOptions{.ignore_leaving = true}).starts_overlapping);
        CHECK_FALSE(sweep(opened.blob, box, {0.0f, -1.0f, 0.0f}, SweepOptions{.ignore_leaving = true}));
    });
}

TEST_CASE("sweep: with a skin the shape stops so far from the plane of the contact") {
    const OpenedBlob opened(make_icosphere(3, 4.0, {0.0f, 0.0f, 0.0f}));
    Random random(78);
    std::uint64_t stopped = 0;
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        const Vec3 from = random.in_cube(9.0f), to = random.in_cube(4.0f);
        const Vec3 way = difference(to, from);
        const float skin = 0.25f * random.unit() * random.unit();
        const auto check = [&](const auto& shape) {
            const SweepHit hit = sweep(opened.blob, shape, way);
            const SweepHit kept = sweep(opened.blob, shape, way, SweepOptions{.skin = skin});
            SweepHit same = kept;
            same.t = hit.t;
            REQUIRE(same_bits(hit, same));
            REQUIRE(kept.t <= hit.t);
            if (!hit || kept.t == 0.0f) return;
            const Vec3& n = hit.normal;
            const auto wide = [](float value) { return static_cast<double>(value); };
            const double speed = -(wide(way.x) * wide(n.x) + wide(way.y) * wide(n.y) + wide(way.z) * wide(n.z));
            const double back = (wide(hit.t) - wide(kept.t)) * speed, least = wide(skin);
            REQUIRE(back >= least * (1.0 - 0x1p-18));
            const double length = std::sqrt(wide(way.x * way.x + way.y * way.y + way.z * way.z));
            REQUIRE(back <= least * (1.0 + 0x1p-17 * length / speed) + 0x1p-22 * length);
            ++stopped;
        };
        check(Sphere{from, 0.5f});
        check(Box{from, {from.x + 0.5f, from.y + 0.25f, from.z + 0.75f}});
        const Vec3 end = {from.x + way.y * 0.0625f, from.y - way.x * 0.0625f, from.z + 0.25f};
        check(Capsule{from, end, 0.25f});
        check(OrientedBox{from, {{0.25f, 0.125f, 0.0f}, {-0.125f, 0.25f, 0.0f}, {0.0f, 0.0f, 0.5f}}});
        const std::array<Vec3, 4> vertices = {from, end, {from.x + 0.5f, from.y, from.z}, {from.x, end.y, end.z}};
        check(ConvexHull{vertices});
    }
    if (asks_enough()) CHECK(stopped > scaled(2'500));
    const Vec3 zero = {0.0f, 0.0f, 0.0f};
    for (const float bad : {-1.0f, not_a_number, infinity})
        CHECK(sweep(opened.blob, Sphere{zero, 1.0f}, zero, SweepOptions{.skin = bad}).status ==
              QueryStatus::invalid_argument);
    CHECK(sweep(opened.blob, Sphere{{0.0f, 0.0f, 9.0f}, 1.0f}, {0.0f, 0.0f, -9.0f}, SweepOptions{.skin = 1e38f}).t ==
          0.0f);
}

TEST_CASE("sweep: a filter leaves out triangles and the ones behind them are hit") {
    for_each_profile([](Profile profile) {
        const Cube cube(profile);
        const Sphere sphere = {{0.25f, 0.5f, 5.0f}, 0.25f};
        const Vec3 down = {0.0f, 0.0f, -8.0f};
        SweepHit hit = sweep(cube.blob(), sphere, down);
        REQUIRE(hit);
        const float first = hit.point.z;
        std::vector<TriangleId> top;
        (void)for_each_overlap(cube.blob(), Box{{-2.0f, -2.0f, 0.999f}, {2.0f, 2.0f, 2.0f}},
                               [&](TriangleId triangle) { return top.push_back(triangle), Visit::next; });
        hit = sweep(cube.blob(), sphere, down, [&](TriangleId triangle) {
            for (const TriangleId each : top)
                if (each == triangle) return false;
            return true;
        });
        REQUIRE(hit);
        CHECK(first == doctest::Approx(1.0));
        CHECK(hit.point.z == doctest::Approx(-1.0));
        CHECK(sweep(cube.blob(), sphere, down, [](TriangleId) { return false; }).status == QueryStatus::not_found);
    });
}

}  // namespace
}  // namespace espalier::tests::sweep_test
