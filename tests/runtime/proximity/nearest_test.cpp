// Claims about closest points as the header words them.
#include "support/testing.hpp"

#include "support/exact/as_rationals.hpp"

namespace espalier::tests::nearest_test {
namespace {

/// |a - sqrt(square)| <= allowed, without a square root.
bool near_square_root(const Rational& a, const Rational& square, const Rational& allowed) {
    const Rational low = a - allowed;
    const Rational high = a + allowed;
    return (low.sign() <= 0 || low * low <= square) && square <= high * high;
}

/// Of the largest coordinate of the asset's bounds.
Rational coordinate_ulp(const Blob& blob) {
    return Rational::of(1, std::ilogb(std::max(largest(blob.bounds().min), largest(blob.bounds().max))) - 23);
}

TEST_CASE("closest point: existence is exact and distance and point are within 4 ulp") {
    const std::uint64_t count = scaled_share(30);
    std::uint64_t found_count = 0;
    for (const std::size_t number : sampled(small_test_blobs().size(), every_profile.size())) {
        const TestBlob& blob = small_test_blobs()[number];
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, 800 + number);
        const Rational ulp = coordinate_ulp(blob.opened.blob);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Sphere query = maker.sphere();
            CAPTURE(describe(query));
            const ClosestPoint nearest = closest_point(blob.opened.blob, query.center, query.radius);
            const bool found{nearest};
            detail::RoundedPoint rounded;
            const QueryStatus status =
                detail::round_point(detail::data_of(blob.opened.blob), query.center, query.radius, rounded);
            if (status != QueryStatus::ok) {
                REQUIRE(nearest.status == status);
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
            REQUIRE(nearest.status == (found ? QueryStatus::ok : QueryStatus::not_found));
            if (!found) continue;
            ++found_count;
            // The triangle that was named is at most rounding farther than the closest one.
            const auto closest =
                oracle::closest_on_triangle(exact_triangle(blob.decoded.triangles.at(nearest.triangle.index)), center);
            REQUIRE(closest.squared_distance <= *least * (Rational(1) + Rational::of(12, -23)));
            if (rounded.distance_offset == 0.0f) {
                const Rational steps = Rational::of(nearest.distance) * Rational::of(1, -blob.decoded.step_exponent);
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

TEST_CASE("closest point: a cube matches hand-computed values") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    ClosestPoint nearest = closest_point(cube.blob, Vec3{0.25f, 0.5f, 3.0f});
    CHECK(nearest.point == Vec3{0.25f, 0.5f, 1.0f});
    CHECK(nearest.on_shape == Vec3{0.25f, 0.5f, 3.0f});
    CHECK(nearest.face_normal == Vec3{0.0f, 0.0f, 1.0f});
    CHECK(nearest.distance == 2.0f);
    CHECK(nearest.side == Side::front);
    nearest = closest_point(cube.blob, Vec3{4.0f, 5.0f, 13.0f});
    CHECK(nearest.point == Vec3{1.0f, 1.0f, 1.0f});
    CHECK(nearest.distance == 13.0f);
    nearest = closest_point(cube.blob, Vec3{0.25f, 0.5f, 0.75f});
    CHECK(nearest.distance == 0.25f);
    CHECK(nearest.side == Side::back);
}

TEST_CASE("closest point: the limit is closed and exact and a miss is no triangle") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Vec3 point{4.0f, 5.0f, 13.0f};
    const ClosestPoint miss = closest_point(cube.blob, point, std::nextafter(13.0f, 0.0f));
    CHECK_FALSE(miss);
    CHECK(miss.status == QueryStatus::not_found);
    CHECK(miss.triangle == no_triangle);
    CHECK(miss.distance == infinity);
    const ClosestPoint nearest = closest_point(cube.blob, point, 13.0f);
    CHECK(nearest.status == QueryStatus::ok);
    CHECK(nearest.distance == 13.0f);
}

TEST_CASE("closest point: a refusal is not a miss") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const auto check = [](const ClosestPoint& nearest, QueryStatus status) {
        CHECK_FALSE(nearest);
        ClosestPoint expected;
        expected.status = status;
        CHECK(same_bits(nearest, expected));
    };
    check(closest_point(cube.blob, Vec3{not_a_number, 0.0f, 0.0f}), QueryStatus::invalid_argument);
    check(closest_point(cube.blob, Vec3{0.0f, -infinity, 0.0f}), QueryStatus::invalid_argument);
    check(closest_point(cube.blob, Vec3{0.0f, 0.0f, 1.0f}, not_a_number), QueryStatus::invalid_argument);
    check(closest_point(cube.blob, Vec3{0.0f, 0.0f, 1.0f}, -1.0f), QueryStatus::invalid_argument);
    check(closest_point(cube.blob, Vec3{3e38f, 0.0f, 0.0f}), QueryStatus::out_of_range);
    check(closest_point(Blob(), Vec3{0.0f, 0.0f, 0.0f}), QueryStatus::not_open);
    check(closest_point(Blob(), Vec3{not_a_number, 0.0f, 0.0f}), QueryStatus::not_open);
    check(ClosestPoint{}, QueryStatus::not_open);
    const OpenedBlob empty(Mesh{});
    check(closest_point(empty.blob, Vec3{0.0f, 0.0f, 0.0f}), QueryStatus::not_found);
    check(closest_point(empty.blob, Vec3{0.0f, 0.0f, 0.0f}, -1.0f), QueryStatus::invalid_argument);
    const ClosestPoint touching = closest_point(cube.blob, Vec3{0.0f, 0.0f, 1.0f}, 0.0f);
    CHECK(touching);
    CHECK(touching.distance == 0.0f);
}

TEST_CASE("closest point: the lowest storage index wins among equally distant triangles") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const ClosestPoint nearest = closest_point(cube.blob, Vec3{0.0f, 0.0f, 0.0f});
    CHECK(nearest.triangle.index == 0);
    CHECK(nearest.distance == 1.0f);
}

TEST_CASE("closest point: side and face normal are those of the exact plane") {
    std::uint64_t behind = 0, asked = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        QueryMaker maker(blob.decoded, 970);
        for (std::uint64_t i = 0; i < scaled_share(100); ++i) {
            const Vec3 point = maker.sphere().center;
            CAPTURE(describe(Sphere{point, 0.0f}));
            const ClosestPoint nearest = closest_point(blob.opened.blob, point);
            if (!nearest) continue;
            REQUIRE(same_bits(nearest.on_shape, point));
            detail::RoundedPoint rounded;
            REQUIRE(detail::round_point(detail::data_of(blob.opened.blob), point, infinity, rounded) ==
                    QueryStatus::ok);
            const oracle::Triangle t = exact_triangle(blob.decoded.triangles.at(nearest.triangle.index));
            const oracle::Point normal = oracle::normal_of(t);
            const oracle::Point from_plane = exact_center(rounded) - t.a;
            const bool is_behind = normal.dot(from_plane).sign() < 0;
            REQUIRE(nearest.side == (is_behind ? Side::back : Side::front));
            ++asked;
            behind += is_behind ? 1u : 0u;
            const Rational squared = normal.dot(normal);
            const float given[3] = {nearest.face_normal.x, nearest.face_normal.y, nearest.face_normal.z};
            for (unsigned k = 0; k < 3; ++k) {
                if (squared.sign() == 0) {
                    REQUIRE(given[k] == 0.0f);
                    continue;
                }
                REQUIRE((Rational::of(given[k]).sign() == normal[k].sign() || std::fabs(given[k]) < 0x1p-100f));
                REQUIRE(near_square_root(oracle::absolute(Rational::of(given[k])), normal[k] * normal[k] / squared,
                                         Rational::of(4, -23)));
            }
        }
    }
    CHECK(behind > asked / 10);
    CHECK(behind < asked);
}

TEST_CASE("closest point: the feature is the face or side or corner of the point") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    CHECK(closest_point(cube.blob, Vec3{0.25f, 0.5f, 3.0f}).feature == Feature::face);
    const ClosestPoint beside = closest_point(cube.blob, Vec3{0.25f, 2.0f, 3.0f});
    CHECK(beside.feature >= Feature::edge_ab);
    CHECK(beside.feature <= Feature::edge_ca);
    CHECK(closest_point(cube.blob, Vec3{4.0f, 5.0f, 13.0f}).feature >= Feature::vertex_a);
    const ClosestPoint above_diagonal = closest_point(cube.blob, Vec3{0.25f, 0.25f, 3.0f});
    CHECK(above_diagonal.feature != Feature::face);
    CHECK(above_diagonal.distance == 2.0f);
}

TEST_CASE("closest point: the few closest are sorted and end with the array or the distance") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    std::array<ClosestPoint, 14> nearest;
    const Vec3 above{0.25f, 0.5f, 3.0f};
    const Filled all = closest_triangles(cube.blob, above, nearest);
    REQUIRE(all.count == 12);
    CHECK(all.status == QueryStatus::ok);
    for (std::size_t i = 1; i < 12; ++i) {
        const bool equal = nearest[i].distance == nearest[i - 1].distance;
        CHECK(nearest[i].distance >= nearest[i - 1].distance);
        if (equal) CHECK(nearest[i].triangle > nearest[i - 1].triangle);
    }
    CHECK(same_bits(nearest[12], ClosestPoint{}));
    CHECK(same_bits(nearest[0], closest_point(cube.blob, above)));

    std::array<ClosestPoint, 3> few;
    REQUIRE(closest_triangles(cube.blob, above, few).count == 3);
    for (std::size_t i = 0; i < few.size(); ++i) CHECK(same_bits(few[i], nearest[i]));
    // The two of the upper face and, 2.062 away, the one that shares its side
    CHECK(closest_triangles(cube.blob, above, nearest, 2.0625f).count == 3);
    CHECK(closest_triangles(cube.blob, above, nearest, 2.0f).count == 1);
    const Filled none = closest_triangles(cube.blob, above, nearest, 1.99f);
    CHECK(none.count == 0);
    CHECK(none.status == QueryStatus::ok);
    CHECK(closest_triangles(cube.blob, above, {}).status == QueryStatus::ok);
    const OpenedBlob empty(Mesh{});
    CHECK(closest_triangles(empty.blob, above, nearest).status == QueryStatus::ok);
    const auto refused = [&](const Filled& filled, QueryStatus status) {
        CHECK(filled.count == 0);
        CHECK(filled.status == status);
    };
    refused(closest_triangles(cube.blob, above, nearest, -1.0f), QueryStatus::invalid_argument);
    refused(closest_triangles(cube.blob, {std::nanf(""), 0.0f, 0.0f}, nearest), QueryStatus::invalid_argument);
    refused(closest_triangles(cube.blob, {std::nanf(""), 0.0f, 0.0f}, {}), QueryStatus::invalid_argument);
    refused(closest_triangles(cube.blob, {3e38f, 0.0f, 0.0f}, nearest), QueryStatus::out_of_range);
    refused(closest_triangles(Blob(), above, nearest), QueryStatus::not_open);
}

TEST_CASE("closest point: the weights lead to the point") {
    ask_each<QueryMaker>(
        small_test_blobs(), 950, scaled_share(50), [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
            const Rational ulp = coordinate_ulp(blob.opened.blob);
            const ClosestPoint nearest = closest_point(blob.opened.blob, maker.sphere().center);
            if (!nearest) return;
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
        });
}

}  // namespace
}  // namespace espalier::tests::nearest_test
