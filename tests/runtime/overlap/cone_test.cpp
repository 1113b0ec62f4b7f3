// Claims about cones, against rationals that share nothing with the kernel: not even the rounding.
#include "support/testing.hpp"

#include "oracle/cone.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/blobs/weird_blobs.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::cone_test {
namespace {

float flushed(float x) { return std::fabs(x) < std::numeric_limits<float>::min() ? 0.0f : x; }

/// Returns the nearest multiple of 2^exponent, ties to even.
Rational rounded_to(float x, int exponent) {
    const double units = std::nearbyint(std::ldexp(static_cast<double>(x), -exponent));
    return Rational::of(static_cast<std::int64_t>(units), exponent);
}

/// Returns the cone in lattice steps, rounded as docs/numerics.md states.
oracle::Cone rounded_in_truth(const DecodedBlob& blob, const Cone& cone) {
    const float world[3] = {cone.apex.x, cone.apex.y, cone.apex.z};
    const float along[3] = {cone.axis.x, cone.axis.y, cone.axis.z};
    float apex[3], axis[3], reach = 0.0f, longest = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
        apex[k] = std::ldexp(flushed(world[k]) - blob.origin[k], -blob.step_exponent);
        axis[k] = flushed(std::ldexp(flushed(along[k]), -blob.step_exponent));
        const auto extent = static_cast<float>(blob.extent[k]);
        reach = std::max({reach, std::fabs(apex[k]), std::fabs(extent - apex[k])});
        longest = std::max(longest, std::fabs(axis[k]));
    }
    const int fraction_bits = std::clamp(22 - std::ilogb(reach), 0, 6);
    const int axis_unit = std::max(std::ilogb(longest) - 23, -16 - fraction_bits);
    oracle::Cone exact;
    for (int k = 0; k < 3; ++k) {
        exact.apex[k] = rounded_to(apex[k], -fraction_bits);
        exact.axis[k] = rounded_to(axis[k], axis_unit);
    }
    exact.radius = oracle::absolute(Rational::of(cone.radius)) * Rational::of(1, -blob.step_exponent);
    return exact;
}

struct Tally {
    std::uint64_t yes = 0, no = 0;

    void check() const {
        CHECK(yes > 0);
        CHECK(no > 0);
    }
};

/// Compares the triangles that a cone overlaps with the oracle, all of them or some of each kind.
std::vector<std::uint32_t> check_overlaps(const Blob& blob, const DecodedBlob& decoded, const Cone& cone,
                                          std::size_t samples, Random& random, Tally& tally) {
    CAPTURE(describe(cone));
    std::vector<std::uint32_t> found;
    REQUIRE(for_each_overlap(blob, cone, [&](TriangleId t) { found.push_back(t.index); }) == QueryStatus::ok);
    REQUIRE(std::is_sorted(found.begin(), found.end()));
    REQUIRE(overlaps(blob, cone).yes() == !found.empty());
    std::vector<TriangleId> page(found.size() + 1);
    const Filled filled = collect_overlaps(blob, cone, page);
    REQUIRE(filled.status == QueryStatus::ok);
    REQUIRE(filled.count == found.size());
    const oracle::Cone exact = rounded_in_truth(decoded, cone);
    const auto count = static_cast<std::uint32_t>(decoded.triangles.size());
    const auto check = [&](std::uint32_t index) {
        const bool is_found = std::binary_search(found.begin(), found.end(), index);
        CAPTURE(index);
        REQUIRE(oracle::meets(exact, exact_triangle(decoded.triangles[index])) == is_found);
        ++(is_found ? tally.yes : tally.no);
    };
    if (samples >= count) {
        for (std::uint32_t i = 0; i < count; ++i) check(i);
        return found;
    }
    for (std::size_t i = 0; i < samples; ++i) {
        if (!found.empty() && random.coin()) check(found[random.below(static_cast<std::uint32_t>(found.size()))]);
        else check(random.below(count));
    }
    return found;
}

/// Triangles with corners on whole numbers below 2^bits, two of them at the ends: their lattice is the whole numbers.
Mesh make_whole_soup(unsigned bits, unsigned count, Random& random) {
    const std::int32_t limit = (1 << bits) - 1;
    Mesh mesh;
    const auto add = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
        mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    };
    for (const std::int32_t end : {0, limit}) {
        add(end, end, end);
        add(limit - end, end, end);
        add(end, limit - end, end);
    }
    for (unsigned i = 0; i < count; ++i) {
        const std::int32_t x = random.between(0, limit), y = random.between(0, limit), z = random.between(0, limit);
        const std::int32_t size = std::max(1, limit >> random.below(bits));
        for (int corner = 0; corner < 3; ++corner)
            add(std::clamp(x + random.between(-size, size), 0, limit),
                std::clamp(y + random.between(-size, size), 0, limit),
                std::clamp(z + random.between(-size, size), 0, limit));
    }
    for (std::uint32_t i = 0; i < mesh.positions.size(); i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    return mesh;
}

/// In small multiples of an eighth, toward a lattice point, often along an axis: cones that touch corners and sides
/// exactly.
Cone small_cone(unsigned bits, Random& random) {
    const std::int32_t limit = 1 << bits;
    const int exponent = random.coin() ? 0 : -2;
    const float stretch = random.coin() ? 1.0f : random.coin() ? 0.5f : 1.5f;
    const bool is_straight = random.below(3) == 0;
    const std::uint32_t direction = random.below(3);
    Cone cone;
    float* const apex[3] = {&cone.apex.x, &cone.apex.y, &cone.apex.z};
    float* const axis[3] = {&cone.axis.x, &cone.axis.y, &cone.axis.z};
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::int32_t scale = 1 << -exponent;
        *apex[k] = std::ldexp(static_cast<float>(random.between(-limit * scale, 2 * limit * scale)), exponent);
        const auto to = static_cast<float>(random.between(0, limit - 1));
        *axis[k] = is_straight && k != direction ? 0.0f : stretch * (to - *apex[k]);
    }
    if (cone.axis.x == 0.0f && cone.axis.y == 0.0f && cone.axis.z == 0.0f) cone.axis.z = 1.0f;
    cone.radius = std::ldexp(static_cast<float>(random.below(8 * static_cast<std::uint32_t>(limit))), -2);
    return cone;
}

/// Along an axis of space, with a corner of a triangle on the slope or the rim: right triangles give whole radii.
Cone touching_cone(const DecodedBlob& decoded, Random& random) {
    constexpr std::int32_t sides[][3] = {{0, 1, 1}, {1, 0, 1},   {0, 2, 2}, {3, 4, 5},
                                         {4, 3, 5}, {5, 12, 13}, {8, 6, 10}};
    const auto& [across, upward, radius] = sides[random.below(std::size(sides))];
    const GridPoint& corner = some_triangle(decoded, random).a;
    const std::size_t along = random.below(3);
    const std::int32_t height = random.between(1, 6) * (random.coin() ? 1 : -1);
    const auto stretch = static_cast<float>(1 << random.below(3));
    float apex[3] = {}, axis[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t off = k == along ? height : k == (along + 1) % 3 ? across : upward;
        apex[k] = decoded.origin[k] + static_cast<float>(corner[k] - off);
    }
    axis[along] = stretch * static_cast<float>(height);
    return {{apex[0], apex[1], apex[2]}, {axis[0], axis[1], axis[2]}, stretch * static_cast<float>(radius)};
}

/// Toward some triangle, from any distance, of any length and width; often its slope leads to a corner.
Cone large_cone(const DecodedBlob& decoded, Random& random) {
    const GridTriangle& triangle = some_triangle(decoded, random);
    const double step = std::ldexp(1.0, decoded.step_exponent);
    const double away = std::ldexp(1.0 + static_cast<double>(random.unit()), random.between(-2, 34));
    double apex[3], way[3], axis[3], length = 0.0, along = 0.0, squared = 0.0;
    const double stretch =
        random.below(4) == 0 ? std::ldexp(1.0, random.between(-30, 10)) : 0.5 + static_cast<double>(random.unit());
    for (std::size_t k = 0; k < 3; ++k) {
        const double at = triangle.a[k];
        apex[k] = at + (random.below(8) == 0 ? 0.0 : away * static_cast<double>(random.signed_unit()));
        way[k] = (at + triangle.b[k] + triangle.c[k]) / 3 - apex[k];
        axis[k] = random.below(8) == 0
                      ? 0.0
                      : way[k] * stretch + away * stretch / 8 * static_cast<double>(random.signed_unit());
        along += axis[k] * (triangle.b[k] - apex[k]);
        length += axis[k] * axis[k];
        squared += (triangle.b[k] - apex[k]) * (triangle.b[k] - apex[k]);
    }
    const double off = std::sqrt(std::max(0.0, squared - along * along / length));
    double radius = length * off / std::fabs(along);
    if (random.below(4) == 0) radius *= std::ldexp(1.0, random.between(-20, 20));
    if (random.below(8) == 0) radius = 0.0;
    if (!(radius < 1e30)) radius = 1.0;
    const auto scaled_axis = [&](std::size_t k) { return static_cast<float>(axis[k] * step); };
    return {place_in_world(decoded, apex[0], apex[1], apex[2]),
            {scaled_axis(0), scaled_axis(1), scaled_axis(2)},
            static_cast<float>(radius * step)};
}

/// Some that are not refused.
void check_large_cones(const Blob& blob, const DecodedBlob& decoded, std::uint64_t count, std::size_t samples,
                       Random& random, Tally& tally) {
    for (std::uint64_t i = 0; i < count; ++i) {
        const Cone cone = large_cone(decoded, random);
        if (!is_refused(overlaps(blob, cone).status())) check_overlaps(blob, decoded, cone, samples, random, tally);
    }
}

QueryStatus status_of(const Blob& blob, const Cone& cone) {
    const YesNo any = overlaps(blob, cone);
    TriangleId room[1];
    const Filled page = collect_overlaps(blob, cone, room);
    CHECK(is_refused(page.status) == is_refused(any.status()));
    if (is_refused(page.status)) CHECK(page.status == any.status());
    else CHECK(any.yes() == (page.count != 0));
    return any.status();
}

TEST_CASE("overlap: a cone touches with its apex and slope and rim and base and axis") {
    const BakeOptions options = {.resolution = Resolution::step(-8)};
    const float hair = 0x1p-14f;  // of the grid, here
    // Flat in z = 0, from (0, 0) to (8, 0) and (0, 8).
    const OpenedBlob opened(make_triangle({0, 0, 0}, {8, 0, 0}, {0, 8, 0}), options);
    const Blob& blob = opened.blob;
    const auto touches = [&](const Cone& cone) { return overlaps(blob, cone).yes(); };
    const Vec3 up = {0, 0, 2};
    for (const float z : {0.0f, hair}) {
        const bool at_height = z == 0.0f;
        CAPTURE(z);
        CHECK(touches({{2, 2, z}, up, 1.0f}) == at_height);                 // the apex, inside
        CHECK(touches({{4, 0, z}, up, 1.0f}) == at_height);                 // the apex, on a side
        CHECK(touches({{0, 0, z}, up, 1.0f}) == at_height);                 // the apex, on a corner
        CHECK(touches({{2, 2, -2 - z}, up, 0.125f}) == at_height);          // the base, inside
        CHECK(touches({{2, 2, -2 - z}, up, 99.0f}) == at_height);           // the base, around all of it
        CHECK(touches({{2, 2, -2 - z}, up, 0.0f}) == at_height);            // a segment's end
        CHECK(touches({{2, 2, 1.5f + z}, {2, 0, 0}, 1.5f}) == at_height);   // the rim, inside
        CHECK(touches({{2, 2, 3 + z}, {4, 0, -3}, 0.0f}) == at_height);     // a segment's end, askew
        CHECK(touches({{-1 - z, 4, 0}, {1, 0, 0}, 0.5f}) == at_height);     // the base, on a side
        CHECK(touches({{-1 - z, 4, 0}, {0, 0, 4}, 4.0f}) == false);         // the slope, above the side
        CHECK(touches({{-3 - z, 4, -4}, {0, 0, 8}, 6.0f}) == at_height);    // the slope, on a side
        CHECK(touches({{-3 - z, -4, -4}, {0, 0, 8}, 10.0f}) == at_height);  // the slope, on a corner
        CHECK(touches({{-3 - z, -4, -8}, {0, 0, 8}, 5.0f}) == at_height);   // the rim, on a corner
    }
    CHECK(touches({{2, 2, -1}, up, 0.0f}));  // a segment through the inside
    CHECK(touches({{2, 2, -1}, up, 0.25f}));
    CHECK_FALSE(touches({{2, 2, -3}, up, 0.25f}));
    CHECK_FALSE(touches({{2, 2, 1}, up, 99.0f}));
    CHECK_FALSE(touches({{9, 9, -1}, up, 3.0f}));
}
TEST_CASE("overlap: hostile cones are refused and never taken for no overlap") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Blob& blob = cube.blob;
    const Vec3 up = {0, 0, 1};
    constexpr QueryStatus invalid = QueryStatus::invalid_argument, far = QueryStatus::out_of_range;
    const float tiny = std::numeric_limits<float>::denorm_min();
    for (const float bad : {not_a_number, infinity, -infinity}) {
        CHECK(status_of(blob, {{bad, 0, 0}, up, 1.0f}) == invalid);
        CHECK(status_of(blob, {{}, {0, bad, 1}, 1.0f}) == invalid);
        CHECK(status_of(blob, {{}, up, bad}) == invalid);
    }
    CHECK(status_of(blob, {{}, up, -tiny}) == invalid);
    CHECK(status_of(blob, {{0, 0, -0.5f}, up, -0.0f}) == QueryStatus::not_found);
    CHECK(status_of(blob, {{}, {}, 1.0f}) == invalid);
    CHECK(status_of(blob, {{}, {0, 0, -tiny}, 1.0f}) == invalid);
    const float step = std::ldexp(1.0f, blob.lattice().step_exponent);
    CHECK(status_of(blob, {{0, 0, 0x1p36f * step}, up, 1.0f}) == far);
    CHECK(status_of(blob, {{0, 0, 0x1p35f * step}, up, 1.0f}) == QueryStatus::not_found);
    CHECK(status_of(blob, {{}, {0, 0, 0x1p36f * step}, 1.0f}) == far);
    CHECK(status_of(blob, {{}, {0, 0, 0x1p35f * step}, 1.0f}) == QueryStatus::ok);
    CHECK(status_of(blob, {{0, 0, -3}, up, 3e38f}) == QueryStatus::not_found);
    CHECK(status_of(blob, {{0, 0, -2}, up, 3e38f}) == QueryStatus::ok);
    CHECK(status_of(blob, {{0, 0, -2}, up, tiny}) == QueryStatus::ok);
    CHECK(status_of(Blob(), {{}, up, 1.0f}) == QueryStatus::not_open);
    int visited = 0;
    CHECK(for_each_overlap(blob, Cone{}, [&](TriangleId) { ++visited; }) == invalid);
    CHECK(visited == 0);
}
TEST_CASE("overlap: a cone inside a closed mesh overlaps none of its surface") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    CHECK(overlaps(cube.blob, Cone{{0, 0, -0.5f}, {0, 0, 1}, 0.5f}).no());
    CHECK(overlaps(cube.blob, Cone{{0, 0, -0.5f}, {0, 0, 1}, 1.0f}).yes());
}
TEST_CASE("deformation: cones equal exact arithmetic in every pose and on triangles without area") {
    Tally tally;
    Random random(5);
    for (const Mesh& mesh : {make_plane_grid(6), make_icosphere(1, 1.0, {1.0f, 0.0f, 0.0f})})
        for (const unsigned bits : {4u, 16u}) {
            DeformedMesh moving(mesh, bits);
            for (const Motion motion : every_motion) {
                moving.move_to(posed(mesh, motion));
                const DecodedBlob decoded = moving.decoded();
                check_large_cones(moving.deformable.blob(), decoded, scaled(12), 8, random, tally);
            }
        }
    tally.check();
}
TEST_CASE("overlap: cones in every profile equal exact arithmetic") {
    Tally tally;
    Random random(3);
    for (const std::vector<TestBlob>* blobs : {&small_test_blobs(), &medium_test_blobs()}) {
        for (const TestBlob& blob : *blobs) {
            CAPTURE(blob.name);
            check_large_cones(blob.opened.blob, blob.decoded, scaled_share(20), 6, random, tally);
        }
    }
    tally.check();
}
TEST_CASE("overlap: cones and triangles without area equal exact arithmetic") {
    Tally tally;
    Random random(4);
    for (std::uint64_t i = 0; i < scaled(60); ++i) {
        const PlainBlob plain = make_weird_blob(random);
        const OpenedBlob opened(encode(plain));
        if (opened.blob.triangle_count() == 0 || opened.blob.duplicate_reference_count() != 0) continue;
        check_large_cones(opened.blob, decode(opened.bytes), 4, 8, random, tally);
    }
    tally.check();
}
TEST_CASE("overlap: cones of small whole numbers equal exact arithmetic where they touch") {
    Tally tally;
    std::uint64_t touching = 0;
    Random random(1);
    for (std::uint64_t i = 0; i < scaled(150); ++i) {
        const unsigned bits = 1 + random.below(4);
        const OpenedBlob opened(make_whole_soup(bits, 20, random), {.resolution = Resolution::step(0)});
        const DecodedBlob decoded = decode(opened.bytes);
        for (int k = 0; k < 8; ++k) {
            Cone cone = random.coin() ? small_cone(bits, random) : touching_cone(decoded, random);
            const auto found = check_overlaps(opened.blob, decoded, cone, 40, random, tally);
            if (cone.radius == 0.0f) continue;
            cone.radius = std::nextafter(cone.radius, 0.0f);
            touching += check_overlaps(opened.blob, decoded, cone, 40, random, tally) != found ? 1u : 0u;
        }
    }
    MESSAGE(tally.yes << " yes, " << tally.no << " no, " << touching << " that only touched something");
    tally.check();
    if (asks_enough()) CHECK(touching > 20);
}
TEST_CASE("overlap: cones of all sizes and from all distances equal exact arithmetic") {
    Tally tally;
    Random random(2);
    for (const unsigned bits : {3u, 12u, 17u, 24u}) {
        const OpenedBlob opened(make_whole_soup(bits, 20, random), {.resolution = Resolution::step(0)});
        check_large_cones(opened.blob, decode(opened.bytes), scaled(100), 6, random, tally);
    }
    MESSAGE(tally.yes << " yes, " << tally.no << " no");
    CHECK(tally.yes > (tally.yes + tally.no) / 10);
    CHECK(tally.no > (tally.yes + tally.no) / 10);
}

}  // namespace
}  // namespace espalier::tests::cone_test
