// Claims about closest points as the header words them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <espalier/nearest.hpp>
#include <espalier/overlap.hpp>

#include "support/answers/differences.hpp"
#include "support/base/profiles.hpp"
#include "support/base/same_bits.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/ray_maker.hpp"

using namespace espalier;
using namespace espalier::tests;
using oracle::Rational;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// |a - sqrt(square)| <= allowed, without a square root.
bool near_square_root(const Rational& a, const Rational& square, const Rational& allowed) {
    const Rational low = a - allowed;
    const Rational high = a + allowed;
    return (low.sign() <= 0 || low * low <= square) && square <= high * high;
}

/// Of the largest coordinate of the asset's bounds.
Rational coordinate_ulp(const Blob& blob) {
    float largest = 0.0f;
    for (const Vec3& corner : {blob.bounds_min(), blob.bounds_max()}) {
        largest = std::max({largest, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
    }
    return Rational::of(1, std::ilogb(largest) - 23);
}

}  // namespace

TEST_SUITE("nearest") {
    TEST_CASE("closest point: existence is exact and distance and point are within 4 ulp") {
        const std::uint64_t count = scaled_share(30);
        std::uint64_t found_count = 0;
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 800);
            const Rational ulp = coordinate_ulp(blob.opened.blob);
            for (std::uint64_t i = 0; i < count; ++i) {
                const Sphere query = maker.sphere();
                CAPTURE(describe(query));
                Nearest nearest;
                const bool found = closest_point(blob.opened.blob, query.center, query.radius, nearest);
                detail::LatticePoint rounded;
                if (!detail::round_point(blob.opened.blob.data(), query.center, query.radius, rounded)) {
                    REQUIRE_FALSE(found);
                    continue;
                }
                const oracle::Point center = exact_center(rounded);
                std::optional<Rational> least;
                for (const GridTriangle& triangle : blob.decoded.triangles) {
                    const auto closest = oracle::closest_on_triangle(exact_triangle(triangle), center);
                    if (!least || closest.squared_distance < *least) least = closest.squared_distance;
                }
                const bool within =
                    std::isinf(rounded.radius) || *least <= Rational::of(rounded.radius) * Rational::of(rounded.radius);
                REQUIRE(found == within);
                if (!found) continue;
                ++found_count;
                // The triangle that was named is at most rounding farther than the closest one.
                const auto closest = oracle::closest_on_triangle(
                    exact_triangle(blob.decoded.triangles.at(nearest.triangle.index)), center);
                REQUIRE(closest.squared_distance <= *least * (Rational(1) + Rational::of(12, -23)));
                if (rounded.distance_offset == 0.0f) {
                    const Rational steps =
                        Rational::of(nearest.distance) * Rational::of(1, -blob.decoded.step_exponent);
                    const Rational allowed = steps.sign() == 0 ? Rational(0) : Rational::of(4, steps.exponent() - 23);
                    REQUIRE(near_square_root(steps, *least, allowed));
                }
                const float given[3] = {nearest.point.x, nearest.point.y, nearest.point.z};
                for (unsigned k = 0; k < 3; ++k) {
                    const Rational exact = Rational::of(blob.decoded.origin[k]) +
                                           closest.point[k] * Rational::of(1, blob.decoded.step_exponent);
                    REQUIRE(oracle::absolute(Rational::of(given[k]) - exact) <= Rational(4) * ulp);
                }
            }
        }
        CHECK(found_count > count);
    }
}

TEST_SUITE("nearest") {
    TEST_CASE("closest point: a cube matches hand-computed values") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        Nearest nearest;
        REQUIRE(closest_point(cube.blob, {0.25f, 0.5f, 3.0f}, infinity, nearest));
        CHECK(nearest.point == Vec3{0.25f, 0.5f, 1.0f});
        CHECK(nearest.distance == 2.0f);
        REQUIRE(closest_point(cube.blob, {4.0f, 5.0f, 13.0f}, infinity, nearest));
        CHECK(nearest.point == Vec3{1.0f, 1.0f, 1.0f});
        CHECK(nearest.distance == 13.0f);
        REQUIRE(closest_point(cube.blob, {0.25f, 0.5f, 0.75f}, infinity, nearest));
        CHECK(nearest.distance == 0.25f);
    }

    TEST_CASE("closest point: the limit is closed and exact and no result leaves the value untouched") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const Nearest before{{1.0f, 2.0f, 3.0f}, 4.0f, 0.5f, 0.25f, Triangle{7}};
        Nearest nearest = before;
        CHECK_FALSE(closest_point(cube.blob, {4.0f, 5.0f, 13.0f}, std::nextafter(13.0f, 0.0f), nearest));
        CHECK(same_bits(nearest, before));
        CHECK_FALSE(closest_point(Blob(), {0.0f, 0.0f, 0.0f}, infinity, nearest));
        CHECK(same_bits(nearest, before));
        CHECK(closest_point(cube.blob, {4.0f, 5.0f, 13.0f}, 13.0f, nearest));
        CHECK(nearest.distance == 13.0f);
    }

    TEST_CASE("closest point: a NaN and an infinite point and a negative limit give none") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const float nan = std::numeric_limits<float>::quiet_NaN();
        Nearest nearest;
        CHECK_FALSE(closest_point(cube.blob, {nan, 0.0f, 0.0f}, infinity, nearest));
        CHECK_FALSE(closest_point(cube.blob, {0.0f, -infinity, 0.0f}, infinity, nearest));
        CHECK_FALSE(closest_point(cube.blob, {0.0f, 0.0f, 1.0f}, nan, nearest));
        CHECK_FALSE(closest_point(cube.blob, {0.0f, 0.0f, 1.0f}, -1.0f, nearest));
        CHECK(closest_point(cube.blob, {0.0f, 0.0f, 1.0f}, 0.0f, nearest));
        CHECK(nearest.distance == 0.0f);
    }

    TEST_CASE("closest point: the lowest storage index wins among equally distant triangles") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        Nearest nearest;
        REQUIRE(closest_point(cube.blob, {0.0f, 0.0f, 0.0f}, infinity, nearest));
        CHECK(nearest.triangle.index == 0);
        CHECK(nearest.distance == 1.0f);
    }

    TEST_CASE("closest point: one exists within a distance exactly when the sphere overlaps") {
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 900);
            for (std::uint64_t i = 0; i < scaled_share(300); ++i) {
                const Sphere sphere = maker.sphere();
                CAPTURE(describe(sphere));
                Nearest nearest;
                const bool found = closest_point(blob.opened.blob, sphere.center, sphere.radius, nearest);
                REQUIRE(found == overlaps(blob.opened.blob, sphere));
                if (found) REQUIRE(nearest.distance <= sphere.radius);
            }
        }
    }

    TEST_CASE("closest point: the feature is the face or side or corner of the point") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        Nearest nearest;
        REQUIRE(closest_point(cube.blob, {0.25f, 0.5f, 3.0f}, infinity, nearest));
        CHECK(nearest.feature == Feature::face);
        REQUIRE(closest_point(cube.blob, {0.25f, 2.0f, 3.0f}, infinity, nearest));
        CHECK(nearest.feature >= Feature::edge_ab);
        CHECK(nearest.feature <= Feature::edge_ca);
        REQUIRE(closest_point(cube.blob, {4.0f, 5.0f, 13.0f}, infinity, nearest));
        CHECK(nearest.feature >= Feature::vertex_a);
        REQUIRE(closest_point(cube.blob, {0.25f, 0.25f, 3.0f}, infinity, nearest));  // above a face's diagonal
        CHECK(nearest.feature != Feature::face);
        CHECK(nearest.distance == 2.0f);
    }

    TEST_CASE("closest point: the few closest are sorted and end with the array or the distance") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        std::array<Nearest, 14> nearest;
        const Vec3 above{0.25f, 0.5f, 3.0f};
        REQUIRE(closest_triangles(cube.blob, above, infinity, nearest) == 12);
        for (std::size_t i = 1; i < 12; ++i) {
            const bool equal = nearest[i].distance == nearest[i - 1].distance;
            CHECK(nearest[i].distance >= nearest[i - 1].distance);
            if (equal) CHECK(nearest[i].triangle > nearest[i - 1].triangle);
        }
        CHECK(same_bits(nearest[12], Nearest{}));
        Nearest first;
        REQUIRE(closest_point(cube.blob, above, infinity, first));
        CHECK(same_bits(nearest[0], first));

        std::array<Nearest, 3> few;
        REQUIRE(closest_triangles(cube.blob, above, infinity, few) == 3);
        for (std::size_t i = 0; i < few.size(); ++i) CHECK(same_bits(few[i], nearest[i]));
        // The two of the upper face and, 2.062 away, the one that shares its side
        CHECK(closest_triangles(cube.blob, above, 2.0625f, nearest) == 3);
        CHECK(closest_triangles(cube.blob, above, 2.0f, nearest) == 1);
        CHECK(closest_triangles(cube.blob, above, 1.99f, nearest) == 0);
        CHECK(closest_triangles(cube.blob, above, -1.0f, nearest) == 0);
        CHECK(closest_triangles(cube.blob, {std::nanf(""), 0.0f, 0.0f}, infinity, nearest) == 0);
        CHECK(closest_triangles(cube.blob, above, infinity, {}) == 0);
        CHECK(closest_triangles(Blob(), above, infinity, nearest) == 0);
    }

    TEST_CASE("closest point: a triangle with copies is among the few closest once") {
        BakeOptions options = with_profile(format::Profile::fast);
        options.builder = Builder::spatial_splits;
        options.duplicates = 1.0;
        const OpenedBlob opened(make_soup(400, 3), options);
        REQUIRE(opened.blob.copy_count() > 0);
        const DecodedBlob decoded = decode(opened.bytes);
        const TriangleLoop loop(decoded);
        QueryMaker maker(decoded, 960);
        std::uint64_t hits = 0;
        for (std::uint64_t i = 0; i < scaled(500); ++i) {
            const auto difference = sphere_difference(opened.blob, loop, maker.sphere(), hits);
            REQUIRE_MESSAGE(!difference, *difference);
        }
        CHECK(hits > 1000);
    }

    TEST_CASE("closest point: the weights lead to the point") {
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            QueryMaker maker(blob.decoded, 950);
            const Rational ulp = coordinate_ulp(blob.opened.blob);
            for (std::uint64_t i = 0; i < scaled_share(50); ++i) {
                Nearest nearest;
                if (!closest_point(blob.opened.blob, maker.sphere().center, infinity, nearest)) continue;
                const oracle::Triangle triangle = exact_triangle(blob.decoded.triangles.at(nearest.triangle.index));
                const oracle::Point steps = triangle.a + (triangle.b - triangle.a) * Rational::of(nearest.u) +
                                            (triangle.c - triangle.a) * Rational::of(nearest.v);
                const float given[3] = {nearest.point.x, nearest.point.y, nearest.point.z};
                for (unsigned k = 0; k < 3; ++k) {
                    const Rational world =
                        Rational::of(blob.decoded.origin[k]) + steps[k] * Rational::of(1, blob.decoded.step_exponent);
                    REQUIRE(oracle::absolute(Rational::of(given[k]) - world) <= Rational(4) * ulp);
                }
                REQUIRE(nearest.u >= 0.0f);
                REQUIRE(nearest.v >= 0.0f);
            }
        }
    }
}
