// Scenes placed in float64 and their origins, judged in rational numbers.
#include "support/testing.hpp"

#include "oracle/rational.hpp"
#include "maker.hpp"

namespace espalier::tests::placing_test {
namespace {

using oracle::Rational;
using Place = std::array<Rational, 3>;
using Bytes = std::vector<std::byte>;

Rational exact(double x) {
    int exponent = 0;
    const double fraction = std::frexp(x, &exponent);
    return Rational::of(static_cast<std::int64_t>(std::ldexp(fraction, 53)), exponent - 53);
}
Place exact(const auto& v) { return {exact(double(v.x)), exact(double(v.y)), exact(double(v.z))}; }
Place operator+(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Place operator*(const Rational& a, const Place& b) { return {a * b[0], a * b[1], a * b[2]}; }
Place cross(const Place& a, const Place& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Rational square_of(const Place& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }

/// rotation * (scale * place) + translation
Place moved(const Transform& transform, const Place& translation, const Place& place) {
    const Quaternion& q = transform.rotation;
    const Place axis = exact(Vec3{q.x, q.y, q.z}), across = cross(axis, place);
    const Rational w = exact(double(q.w)), twice = Rational(2) / (square_of(axis) + w * w);
    return translation + exact(double(transform.scale)) * (place + twice * (w * across + cross(axis, across)));
}

Bytes bake_far(const std::vector<Vec3d>& positions, const std::vector<TriangleVertices>& triangles, Resolution step) {
    MeshView view;
    view.float64_positions = positions;
    view.triangles = triangles;
    return bake(std::array{view}, {.resolution = step, .origin = std::nullopt}).bytes;
}
std::vector<std::span<const std::byte>> spans_of(const std::vector<Bytes>& blobs) {
    return {blobs.begin(), blobs.end()};
}

Vec3d near(Random& random, const Vec3d& place, double size) {
    const auto at = [&](double x) {
        return x + size * (double(random.signed_unit()) + 0x1p-30 * double(random.unit()));
    };
    return {at(place.x), at(place.y), at(place.z)};
}

TEST_CASE("scene: places are rounded once from the exact ones and the error states by how much") {
    Random random(6251);
    std::size_t rounded = 0, with_origin = 0;
    for (std::uint64_t i = 0; i < scaled(60); ++i) {
        const auto large = [&](int least) { return near(random, {}, std::ldexp(1.0, random.between(least, 24))); };
        const Vec3d center = large(4);
        std::vector<Bytes> blobs;
        std::vector<Instance> given(4);
        std::vector<Vec3d> translations;
        std::vector<Place> corners;  // one of each mesh, at the place of its instance
        for (std::uint32_t k = 0; k < 4; ++k) {
            Transform& transform = given[k].transform;
            if (random.coin()) {
                transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 0.5f};
                transform.scale = 0.5f + random.unit();
            }
            given[k].mesh = k;
            const Vec3d home = large(0), a = near(random, home, 8);
            blobs.push_back(bake_far({a, near(random, a, 8), near(random, a, 8)}, {{0, 1, 2}},
                                     Resolution::bits(static_cast<unsigned>(random.between(12, 20)))));
            const Place way = exact(near(random, center, 100)) + Rational(-1) * moved(transform, {}, exact(home));
            translations.push_back({way[0].rounded(), way[1].rounded(), way[2].rounded()});
            corners.push_back(moved(transform, exact(translations[k]), exact(a)));
        }
        SceneBakeOptions options = {.translations = translations, .origin = std::nullopt};
        if (i % 4 == 1) options.origin = near(random, center, 1000);
        if (i % 4 == 2) options.origin = Vec3d{};
        const SceneBakeResult baked = bake_scene(spans_of(blobs), given, options);
        const OpenedScene flat(baked.bytes);
        CHECK_MESSAGE(verify_scene(baked.bytes), verify_scene(baked.bytes).message);
        CHECK(flat.scene.source_origin() == baked.report.origin);
        with_origin += baked.report.origin != Vec3d{};
        // The same scene as a tile of another one.
        const Instance outer = {.transform = given[0].transform};
        const OpenedScene nested(
            bake_scene(spans_of({baked.bytes}), std::array{outer}, {.origin = options.origin}).bytes);
        for (std::uint32_t id = 0; id < 4; ++id) {
            const Instance instance = *instance_at(flat.scene, {id});
            const Blob mesh = *mesh_at(flat.scene, {id});
            const Place place = moved(given[instance.source].transform, exact(translations[instance.source]),
                                      exact(mesh.source_origin())) +
                                Rational(-1) * exact(baked.report.origin);
            const Vec3 at = instance.transform.translation;
            for (std::size_t k = 0; k < 3; ++k) {
                const float stored = std::array{at.x, at.y, at.z}[k];
                REQUIRE((place[k] == Rational(0) ? Rational(stored != 0.0f) : oracle::error_in_ulp(stored, place[k])) <=
                        Rational::of(1, -1));
                rounded += exact(double(stored)) != place[k];
            }
            for (const BakedScene* scene : {&flat.scene, &nested.scene}) {
                Place source = corners[instance.source];
                if (scene == &nested.scene) source = moved(outer.transform, {}, source);
                const Rational bound = exact(double(scene->max_error()));
                const auto is_near = [&](const Vec3& corner) {
                    Place found = moved(instance.transform, exact(at), exact(corner));
                    if (scene == &nested.scene) {
                        const Transform tile = instance_at(*scene, {0})->transform;
                        found = moved(tile, exact(tile.translation), found);
                    }
                    return square_of(exact(scene->source_origin()) + found + Rational(-1) * source) <= bound * bound;
                };
                const Triangle triangle = *triangle_at(mesh, {0});
                REQUIRE((is_near(triangle.a) || is_near(triangle.b) || is_near(triangle.c)));
            }
        }
    }
    CHECK(rounded > scaled(60));
    CHECK(with_origin >= scaled(60) / 2);
}

TEST_CASE("scene: places that float32 holds need an origin too where it is too coarse for what lies near them") {
    const auto cube = make_cube(0.0f, 10.0f);
    const std::vector<Bytes> blobs = {
        bake(std::array{cube.view()}, {.resolution = Resolution::tolerance(0.001)}).bytes};
    std::vector<Instance> instances(2);
    instances[1].transform.translation = {20.0f, 0.0f, 0.0f};
    const auto baked = [&] { return bake_scene(spans_of(blobs), instances, {.origin = std::nullopt}); };
    CHECK(baked().report.origin == Vec3d{});
    // A world about 0 gains nothing from another place to count from.
    instances[1].transform.translation = {40'000.0f, 0.0f, -40'000.0f};
    CHECK(baked().report.origin == Vec3d{});
    for (Instance& instance : instances) {
        instance.transform.translation.x += 431'000.0f;
        instance.transform.translation.y += 5'312'000.0f;
    }
    instances[1].transform.translation.x -= 39'980.0f;
    instances[1].transform.translation.z = 0.0f;
    const SceneBakeResult far = baked();
    CHECK(far.report.warnings.empty());
    // A round number, from which views of moving scenes can count too.
    CHECK(far.report.origin == Vec3d{434'176.0, 5'308'416.0, 0.0});
    const OpenedScene scene(far.bytes);
    const Vec3d from = scene.scene.source_origin();
    const auto below = static_cast<float>(5'311'999.8 - from.y);
    const auto nearest = closest_point(scene.scene, {static_cast<float>(431'005.0 - from.x), below, 5.0f});
    CHECK(std::abs(nearest->distance - 0.2f) < 0.001f);
}

TEST_CASE("scene: no ray falls through the seams of tiles of a map that were baked alone") {
    constexpr int side = 4;
    Random random(6252);
    std::vector<Vec3d> points;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x)
            points.push_back({499'968.25 + 50.3 * x, 5'400'003.5 + 41.7 * y, 612 + 9 * double(random.unit())});
    std::vector<Bytes> tiles;
    for (std::size_t at = 0; at + side + 2 < points.size(); ++at)
        if (at % (side + 1) != side)
            tiles.push_back(bake_far({points[at], points[at + 1], points[at + side + 1], points[at + side + 2]},
                                     {{0, 1, 3}, {0, 3, 2}}, Resolution::step(-6)));
    const auto joined = [](const std::vector<Bytes>& blobs) {
        std::vector<Instance> instances(blobs.size());
        for (std::uint32_t i = 0; i < blobs.size(); ++i) instances[i].mesh = i;
        return bake_scene(spans_of(blobs), instances, {.origin = std::nullopt}).bytes;
    };
    const auto half = tiles.begin() + static_cast<std::ptrdiff_t>(tiles.size() / 2);
    for (const Bytes& bytes : {joined(tiles), joined({joined({tiles.begin(), half}), joined({half, tiles.end()})})}) {
        const OpenedScene opened(bytes);
        const Vec3d origin = opened.scene.source_origin();
        CHECK(std::abs(origin.x - 500'000) <= 256);
        std::uint64_t through = 0;
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {  // at edges inside of the map, from above
            const int at = random.between(1, side - 2) * (side + 1) + random.between(1, side - 2);
            const int next[] = {at, at + 1, at + side + 1, at + side + 2};
            const Vec3d &a = points[std::size_t(at)], &b = points[std::size_t(next[random.below(4)])];
            const double f = double(random.unit());
            const Vec3 aim = {static_cast<float>(a.x + f * (b.x - a.x) - origin.x),
                              static_cast<float>(a.y + f * (b.y - a.y) - origin.y),
                              static_cast<float>(a.z + f * (b.z - a.z) - origin.z)};
            Ray ray = Ray::between(sum(aim, {30 * random.signed_unit(), 30 * random.signed_unit(), 200}), aim);
            ray.t_max = infinity;
            through += !raycast(opened.scene, ray);
        }
        CHECK(through == 0);
    }
}

TEST_CASE("scene: scenes that need none keep their bytes and others state it in version 1.1") {
    using namespace format::scene;
    for (const TestScene& test : test_scenes()) {
        std::vector<std::span<const std::byte>> blobs;
        for (const OpenedBlob& blob : test.blobs) blobs.emplace_back(blob.bytes);
        for (const OpenedScene& tile : test.tiles) blobs.emplace_back(tile.bytes);
        CAPTURE(test.name);
        const SceneBakeResult chosen = bake_scene(blobs, test.instances, {.origin = std::nullopt});
        const bool needs_one = test.name == "far from the origin";
        CHECK((chosen.report.origin != Vec3d{}) == needs_one);
        CHECK((chosen.bytes != test.opened.bytes) == needs_one);
        CHECK(get(test.opened.bytes, version_minor_at, 2) == 0);
        CHECK(test.opened.scene.source_origin() == Vec3d{});
    }
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const auto baked = [&](std::span<const Vec3d> translations, std::optional<Vec3d> origin) {
        return bake_scene(std::array{std::span<const std::byte>(cube.bytes)}, std::array<Instance, 1>(),
                          {translations, origin});
    };
    constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
    CHECK(baked(std::array<Vec3d, 2>{}, Vec3d{}).status == BakeStatus::invalid_options);
    CHECK(baked({}, Vec3d{0, no_number, 0}).status == BakeStatus::invalid_options);
    CHECK(baked(std::array{Vec3d{0, 0, no_number}}, Vec3d{}).status == BakeStatus::invalid_mesh);
    CHECK(baked({}, Vec3d{1e39, 0, 0}).status == BakeStatus::too_large);
    const std::array far = {Vec3d{4e6 + 0.1, 0, 0}};
    const SceneBakeResult without = baked(far, Vec3d{}), with = baked(far, std::nullopt);
    REQUIRE(without.report.warnings.size() == 1);
    CHECK(without.report.warnings[0].message.find("instance 0") == 0);
    CHECK(with.report.warnings.empty());
    CHECK(std::abs(with.report.origin.x - 4e6) < 8);
    CHECK(with.report.max_error < without.report.max_error);
    // Of whatever origin, the advice is one that helps.
    const auto advice = [](const SceneBakeResult& result) {
        return result.report.warnings.size() == 1 ? result.report.warnings[0].message : std::string();
    };
    const std::array at_zero = {Vec3d{0.1, 0, 0}};
    CHECK(advice(baked(at_zero, Vec3d{1e7, 0, 0})).find("choose an origin") != std::string::npos);
    CHECK(advice(baked(far, Vec3d{})).find("choose an origin") != std::string::npos);
    const auto baked_twice = [&](double from, double to, std::optional<Vec3d> origin) {
        return bake_scene(std::array{std::span<const std::byte>(cube.bytes)}, std::array<Instance, 2>(),
                          {std::array{Vec3d{from, 0, 0}, Vec3d{to, 0, 0}}, origin});
    };
    for (const double from : {0.1, 4e7 + 0.1, 1e14 + 0.1}) {
        CHECK(advice(baked_twice(from, from + 4e6, std::nullopt)).find("the scene is too large") != std::string::npos);
        CHECK(advice(baked_twice(from, from + 4e6, Vec3d{from, 0, 0})).find("the scene is too large") !=
              std::string::npos);
        const SceneBakeResult close = baked_twice(from, from, std::nullopt);
        CHECK(close.report.warnings.empty());
        CHECK(std::abs(close.report.origin.x - from) < 8);
    }
    const SceneBakeResult wide = baked_twice(0.1, 2.5e5 + 0.1, std::nullopt);
    CHECK(std::abs(wide.report.origin.x - 1.25e5) < 4096 + 2);  // a 64th of the side, to be below it
    std::vector<Blob> meshes(1);
    const auto changed = [&](std::size_t at, std::uint64_t value, unsigned bytes) {
        Bytes other = with.bytes;
        put(other, at, value, bytes);
        repair_checksum(other);
        return other;
    };
    const auto opens = [&](std::size_t at, std::uint64_t value, unsigned bytes) {
        return open_scene(changed(at, value, bytes), meshes).status();
    };
    for (std::size_t at = source_origin_at; at < header_bytes; at += 8) {
        CHECK(opens(at, 0x7FEFFFFFFFFFFFFFu, 8) == OpenStatus::ok);
        CHECK(opens(at, 0x7FF0000000000000u, 8) == OpenStatus::bad_header);
        CHECK(opens(at, 0xFFF8000000000001u, 8) == OpenStatus::bad_header);
    }
    CHECK(opens(zeros_at, 1, 4) == OpenStatus::bad_header);
    CHECK(opens(version_minor_at, 0, 2) == OpenStatus::bad_header);
    CHECK(opens(version_minor_at, 2, 2) == OpenStatus::unsupported_version);
    CHECK(opens(features_at, has_common_lattice, 4) == OpenStatus::bad_header);
    CHECK(opens(features_at, has_source_origin | 4, 4) == OpenStatus::unsupported_feature);
    // The error may have what rounding moved at most, and no more.
    for (const float error : {with.report.max_error - 0.001f, with.report.max_error + 0.001f})
        CHECK_FALSE(verify_scene(changed(max_error_at, std::bit_cast<std::uint32_t>(error), 4)));
}

}  // namespace
}  // namespace espalier::tests::placing_test
