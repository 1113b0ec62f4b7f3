// Claims about bounds as floats.
#include "support/testing.hpp"

#include <memory>

#include "oracle/rational.hpp"

namespace espalier::tests::asset_bounds_test {
namespace {

using espalier::oracle::Rational;

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
        const Result<Sphere> sphere = bounding_sphere(opened.blob);
        const Result<OrientedBox> box = oriented_bounds(opened.blob);
        const Result<KDop> k_dop = k_dop_bounds(opened.blob);
        REQUIRE(sphere);
        REQUIRE(box);
        REQUIRE(k_dop);
        for (const GridPoint& corner : distinct_corners(decoded)) {
            Exact3 point;
            for (std::size_t k = 0; k < 3; ++k)
                point[k] =
                    Rational::of(decoded.origin[k]) + Rational::of(std::int64_t{corner[k]}, decoded.step_exponent);
            check_point(point, *sphere, *box, *k_dop);
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
