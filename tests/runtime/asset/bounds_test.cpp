// Claims about bounds as floats.
#include "support/testing.hpp"

#include <memory>

#include <Eigen/Geometry>

#include "support/exact/as_rationals.hpp"

namespace espalier::tests::asset_bounds_test {
namespace {

using oracle::Point;

Point exact(Vec3 v) { return Point(Rational::of(v.x), Rational::of(v.y), Rational::of(v.z)); }

void check_point(const Point& point, const Sphere& sphere, const OrientedBox& box, const KDop& k_dop) {
    const Point from_center = point - exact(sphere.center);
    REQUIRE(from_center.dot(from_center) <= Rational::of(sphere.radius) * Rational::of(sphere.radius));
    // point = center + sum of t_i * half axis i, by Cramer's rule: every t_i is within -1 .. 1.
    const Point a = exact(box.half_axes[0]);
    const Point b = exact(box.half_axes[1]);
    const Point c = exact(box.half_axes[2]);
    const Point p = point - exact(box.center);
    const Rational volume = a.dot(b.cross(c));
    REQUIRE(volume.sign() != 0);
    for (const Rational& part : {p.dot(b.cross(c)), p.dot(c.cross(a)), p.dot(a.cross(b))})
        REQUIRE(part * part <= volume * volume);
    for (unsigned k = 0; k < KDop::count; ++k) {
        const Rational at = point.dot(exact(KDop::directions[k]));
        REQUIRE(Rational::of(k_dop.lo[k]) <= at);
        REQUIRE(at <= Rational::of(k_dop.hi[k]));
    }
}

BakeOptions with_bounds(unsigned bits) {
    BakeOptions options = {.resolution = Resolution::bits(bits), .bounds = {true, true, true}};
    return options;
}

struct Case {
    Mesh mesh;
    unsigned bits;
};

TEST_CASE("bounds: bounds as floats hold every corner exactly") {
    for (const Case& one :
         {Case{make_cube(-1.0f, 1.0f), 16}, Case{make_icosphere(2, 1.0, {0.5f, -3.0f, 0.25f}), 24},
          Case{moved_by(make_icosphere(2, 1.0, {0, 0, 0}), {1e6f, -3e5f, 2e4f}), 16},
          Case{moved_by(make_terrain(8, 3), {-7e7f, 0.0f, 1e-3f}), 4}, Case{scaled_by(make_soup(60, 3), 0x1p-60f), 20},
          Case{scaled_by(make_soup(60, 4), 0x1p60f), 20}, Case{make_plane_grid(3), 2}}) {
        CAPTURE(one.mesh.name);
        const OpenedBlob opened(one.mesh, with_bounds(one.bits));
        const DecodedBlob decoded = decode(opened.bytes);
        const Point origin = exact({decoded.origin[0], decoded.origin[1], decoded.origin[2]});
        const Result<Sphere> sphere = bounding_sphere(opened.blob);
        const Result<OrientedBox> box = oriented_bounds(opened.blob);
        const Result<KDop> k_dop = k_dop_bounds(opened.blob);
        REQUIRE(sphere);
        REQUIRE(box);
        REQUIRE(k_dop);
        for (const GridPoint& corner : distinct_corners(decoded)) {
            const Point moved = Rational::of(1, decoded.step_exponent) * exact_point(corner);
            check_point(origin + moved, *sphere, *box, *k_dop);
        }
        (void)for_each_triangle(opened.blob, [&](TriangleId, const Triangle& corners) {
            for (const Vec3& corner : {corners.a, corners.b, corners.c})
                check_point(exact(corner), *sphere, *box, *k_dop);
            return Visit::next;
        });
    }
}

TEST_CASE("bounds: bounds that a blob does not store are refused") {
    for (unsigned which = 0; which < 8; ++which) {
        CAPTURE(which);
        const BakeOptions options = {.bounds = {(which & 1) != 0, (which & 2) != 0, (which & 4) != 0}};
        const OpenedBlob opened(make_cube(0.0f, 1.0f), options);
        const Result<OrientedBox> box = oriented_bounds(opened.blob);
        const Result<Sphere> sphere = bounding_sphere(opened.blob);
        const Result<KDop> k_dop = k_dop_bounds(opened.blob);
        const auto expected = [](bool is_stored) { return is_stored ? QueryStatus::ok : QueryStatus::no_data; };
        CHECK(box.status == expected(options.bounds.oriented_box));
        CHECK(sphere.status == expected(options.bounds.sphere));
        CHECK(k_dop.status == expected(options.bounds.k_dop));
        CHECK((sphere->radius > 0.0f) == options.bounds.sphere);
        CHECK((box->half_axes[0] != Vec3{}) == options.bounds.oriented_box);
        CHECK((k_dop->hi[0] > 0.0f) == options.bounds.k_dop);
    }
    CHECK(bounding_sphere(Blob()).status == QueryStatus::not_open);
    CHECK(oriented_bounds(Blob()).status == QueryStatus::not_open);
    CHECK(k_dop_bounds(Blob()).status == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::asset_bounds_test
