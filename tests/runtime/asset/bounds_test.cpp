// Claims about bounds as floats, and about the first look that they allow.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <espalier/espalier.hpp>
#include <runtime/lattice_point.hpp>

#include "oracle/rational.hpp"
#include "support/base/profiles.hpp"
#include "support/blobs/baking.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/ray_maker.hpp"

using namespace espalier;
using namespace espalier::tests;
using espalier::oracle::Rational;

namespace {

using Exact3 = std::array<Rational, 3>;

Exact3 exact(Vec3 v) { return {Rational::of(v.x), Rational::of(v.y), Rational::of(v.z)}; }
Exact3 minus(const Exact3& a, const Exact3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Exact3& a, const Exact3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact3 cross(const Exact3& a, const Exact3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

void check_point(const Exact3& point, const Sphere& sphere, const OrientedBox& box, const KDop& k_dop) {
    const Exact3 from_center = minus(point, exact(sphere.center));
    REQUIRE(dot(from_center, from_center) <= Rational::of(sphere.radius) * Rational::of(sphere.radius));
    // point = center + sum of t_i * half axis i, by Cramer's rule: every t_i is within -1 .. 1.
    const Exact3 a = exact(box.half_axes[0]);
    const Exact3 b = exact(box.half_axes[1]);
    const Exact3 c = exact(box.half_axes[2]);
    const Exact3 p = minus(point, exact(box.center));
    const Rational volume = dot(a, cross(b, c));
    REQUIRE(volume.sign() != 0);
    for (const Rational& part : {dot(p, cross(b, c)), dot(p, cross(c, a)), dot(p, cross(a, b))})
        REQUIRE(part * part <= volume * volume);
    for (unsigned k = 0; k < KDop::count; ++k) {
        const Rational at = dot(point, exact(KDop::directions[k]));
        REQUIRE(Rational::of(k_dop.lo[k]) <= at);
        REQUIRE(at <= Rational::of(k_dop.hi[k]));
    }
}

BakeOptions with_bounds(unsigned bits) {
    BakeOptions options;
    options.bits = bits;
    options.bounds = {true, true, true};
    return options;
}

Mesh moved(Mesh mesh, Vec3 by) {
    for (Vec3& p : mesh.positions) p = {p.x + by.x, p.y + by.y, p.z + by.z};
    return mesh;
}

constexpr float infinity = std::numeric_limits<float>::infinity();

struct Case {
    Mesh mesh;
    unsigned bits;
};

}  // namespace

TEST_SUITE("bounds") {
    TEST_CASE("bounds: bounds as floats hold every corner exactly") {
        for (const Case& one :
             {Case{make_cube(-1.0f, 1.0f), 16}, Case{make_icosphere(2, 1.0, {0.5f, -3.0f, 0.25f}), 24},
              Case{moved(make_icosphere(2, 1.0, {0, 0, 0}), {1e6f, -3e5f, 2e4f}), 16},
              Case{moved(make_terrain(8, 3), {-7e7f, 0.0f, 1e-3f}), 4}, Case{scaled_by(make_soup(60, 3), 0x1p-60f), 20},
              Case{scaled_by(make_soup(60, 4), 0x1p60f), 20}, Case{make_plane_grid(3), 2}}) {
            CAPTURE(one.mesh.name);
            const OpenedBlob opened(one.mesh, with_bounds(one.bits));
            const DecodedBlob decoded = decode(opened.bytes);
            Sphere sphere;
            OrientedBox box;
            KDop k_dop;
            REQUIRE(bounding_sphere(opened.blob, sphere));
            REQUIRE(oriented_bounds(opened.blob, box));
            REQUIRE(k_dop_bounds(opened.blob, k_dop));
            for (const GridPoint& corner : distinct_corners(decoded)) {
                Exact3 point;
                for (std::size_t k = 0; k < 3; ++k)
                    point[k] =
                        Rational::of(decoded.origin[k]) + Rational::of(std::int64_t{corner[k]}, decoded.step_exponent);
                check_point(point, sphere, box, k_dop);
            }
            for_each_triangle(opened.blob, [&](Triangle, const Corners& corners) {
                for (const Vec3& corner : {corners.a, corners.b, corners.c})
                    check_point(exact(corner), sphere, box, k_dop);
                return keep_going;
            });
        }
    }

    TEST_CASE("bounds: bounds that a blob does not carry are absent and nothing is written") {
        for (unsigned which = 0; which < 8; ++which) {
            CAPTURE(which);
            BakeOptions options;
            options.bounds = {(which & 1) != 0, (which & 2) != 0, (which & 4) != 0};
            const OpenedBlob opened(make_cube(0.0f, 1.0f), options);
            OrientedBox box;
            Sphere sphere;
            KDop k_dop;
            CHECK(oriented_bounds(opened.blob, box) == options.bounds.oriented_box);
            CHECK(bounding_sphere(opened.blob, sphere) == options.bounds.sphere);
            CHECK(k_dop_bounds(opened.blob, k_dop) == options.bounds.k_dop);
            CHECK((sphere.radius > 0.0f) == options.bounds.sphere);
            CHECK((box.half_axes[0] != Vec3{}) == options.bounds.oriented_box);
            CHECK((k_dop.hi[0] > 0.0f) == options.bounds.k_dop);
        }
        CHECK(!bounding_sphere(Blob(), *std::make_unique<Sphere>()));
    }

    TEST_CASE("bounds: a sphere or box outside the bounds touches no triangle") {
        std::uint64_t kept_away = 0;
        std::uint64_t asked = 0;
        for (const bool medium : {false, true}) {
            for (const TestBlob& blob : medium ? medium_test_blobs() : small_test_blobs()) {
                CAPTURE(blob.name);
                const Blob& view = blob.opened.blob;
                const TriangleLoop loop(blob.decoded);
                QueryMaker maker(blob.decoded, 300);
                const std::uint64_t count = scaled_share(3'000);
                for (std::uint64_t i = 0; i < count; ++i) {
                    const Sphere sphere = maker.sphere();
                    ++asked;
                    if (!is_outside_bounds(view, sphere)) continue;
                    ++kept_away;
                    detail::LatticePoint point;
                    if (!detail::round_point(view.data(), sphere.center, sphere.radius, point)) continue;
                    REQUIRE_MESSAGE(loop.every_overlap(point).empty(), describe(sphere));
                }
                std::vector<Vec3> corners;
                for_each_triangle(view, [&](Triangle, const Corners& each) {
                    corners.insert(corners.end(), {each.a, each.b, each.c});
                    return keep_going;
                });
                const Vec3 low = view.bounds_min();
                const Vec3 high = view.bounds_max();
                for (std::uint64_t i = 0; i < count / 4; ++i) {
                    const auto place = [&](float from, float to) {
                        return from + (to - from) * (1.4f * maker.random().unit() - 0.2f);
                    };
                    Box box = {{place(low.x, high.x), place(low.y, high.y), place(low.z, high.z)}, {}};
                    const auto side = [&](float from, float to) { return 0.2f * (to - from) * maker.random().unit(); };
                    box.max = {box.min.x + side(low.x, high.x), box.min.y + side(low.y, high.y),
                               box.min.z + side(low.z, high.z)};
                    if (i % 4 == 0) {  // with a face exactly through a corner
                        const Vec3& corner = corners[maker.random().below(static_cast<std::uint32_t>(corners.size()))];
                        box.max = corner;
                        box.min = {corner.x - side(low.x, high.x), corner.y - side(low.y, high.y),
                                   corner.z - side(low.z, high.z)};
                    }
                    ++asked;
                    if (!is_outside_bounds(view, box)) continue;
                    ++kept_away;
                    for (const Vec3& p : corners) {
                        const bool inside = box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y &&
                                            p.y <= box.max.y && box.min.z <= p.z && p.z <= box.max.z;
                        REQUIRE(!inside);
                    }
                }
            }
        }
        CHECK(kept_away > asked / 50);
        CHECK(kept_away < asked);
    }

    TEST_CASE("bounds: each kind of bounds rejects queries that the axis-aligned box accepts") {
        // A long thin box along the diagonal, and spheres beside it.
        Mesh needle = make_cube(-1.0f, 1.0f);
        for (Vec3& p : needle.positions) {
            const float along = 10.0f * p.x;
            p = {along + 0.1f * p.y, along - 0.1f * p.y + 0.1f * p.z, along - 0.1f * p.z};
        }
        const Sphere beside = {{6.0f, -6.0f, 0.0f}, 1.0f};
        const Box box_beside = {{5.0f, -6.0f, -1.0f}, {6.0f, -5.0f, 1.0f}};
        for (unsigned which = 0; which < 8; ++which) {
            CAPTURE(which);
            BakeOptions options;
            options.bounds = {(which & 1) != 0, (which & 2) != 0, (which & 4) != 0};
            const OpenedBlob opened(needle, options);
            CHECK(is_outside_bounds(opened.blob, beside) == ((which & 5) != 0));  // the sphere is a loose one
            CHECK(is_outside_bounds(opened.blob, box_beside) == ((which & 5) != 0));
            CHECK(is_outside_bounds(opened.blob, Sphere{{10.0f, -10.0f, 10.0f}, 1.0f}) == ((which & 5) != 0));
            CHECK(!is_outside_bounds(opened.blob, Sphere{{0.0f, 0.0f, 0.0f}, 0.0f}));
            CHECK(!is_outside_bounds(opened.blob, Sphere{{50.0f, 0.0f, 0.0f}, infinity}));
            CHECK(is_outside_bounds(opened.blob, Sphere{{50.0f, 0.0f, 0.0f}, 1.0f}));
        }
    }

    TEST_CASE("bounds: nonsense touches nothing and an infinite box touches everything") {
        BakeOptions options;
        options.bounds = {true, true, true};
        const OpenedBlob opened(make_cube(0.0f, 1.0f), options);
        const float nan = std::nanf("");
        CHECK(is_outside_bounds(opened.blob, Sphere{{nan, 0, 0}, 1.0f}));
        CHECK(is_outside_bounds(opened.blob, Sphere{{0, 0, 0}, nan}));
        CHECK(is_outside_bounds(opened.blob, Sphere{{0, 0, 0}, -1.0f}));
        CHECK(is_outside_bounds(opened.blob, Sphere{{0, infinity, 0}, 1.0f}));
        CHECK(is_outside_bounds(opened.blob, Box{{0, 0, nan}, {1, 1, 1}}));
        CHECK(is_outside_bounds(opened.blob, Box{{0, 0, 0.6f}, {1, 1, 0.5f}}));
        CHECK(!is_outside_bounds(opened.blob, Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}));
        CHECK(!is_outside_bounds(opened.blob, Box{{1, 1, 1}, {infinity, 2, 3e38f}}));
        CHECK(is_outside_bounds(opened.blob, Box{{2, 1, 1}, {infinity, 2, 3e38f}}));
        CHECK(is_outside_bounds(Blob(), Box{{0, 0, 0}, {1, 1, 1}}));
        CHECK(is_outside_bounds(Blob(), Sphere{{0, 0, 0}, infinity}));
    }
}
