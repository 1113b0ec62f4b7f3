// Claims about the kernels of contacts: distance, depth and direction against a reference in double that tries every
// plane through three differences of vertices.
#include "support/testing.hpp"

#include <runtime/contacts/touch.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"

#include "touched.hpp"

namespace espalier::tests::touch_test {
namespace {

using detail::Integer3;
using detail::contacts::Touches;
using detail::operator*;

Integer3 integer_point(const GridPoint& p) { return {p[0], p[1], p[2]}; }

GridPoint twice_of(const GridPoint& p) { return {2 * p[0], 2 * p[1], 2 * p[2]}; }

detail::RoundedSegment segment_of(const GridPoint& from, const GridPoint& to) {
    detail::RoundedSegment segment{};
    segment.from = integer_point(from);
    segment.to = integer_point(to);
    segment.fraction_bits = 0;
    for (unsigned k = 0; k < 3; ++k) {
        segment.from_steps[k] = static_cast<float>(from[k]);
        segment.to_steps[k] = static_cast<float>(to[k]);
    }
    return segment;
}

TEST_CASE("contact: a point has the distance and the direction of the reference") {
    Random random(5);
    double worst = 0.0;
    const std::uint64_t count = scaled(20'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 2 + random.below(18);
        const GridTriangle triangle = some_triangle(random, bits);
        const GridPoint at = point_near(random, bits, triangle);
        detail::RoundedPoint point{};
        for (unsigned k = 0; k < 3; ++k) {
            point.origin[k] = at[k];
            point.steps[k] = static_cast<float>(at[k]);
        }
        Touches touches;
        detail::contacts::touch_point(point, lattice_triangle(triangle), side_of(at, triangle), touches);
        REQUIRE(touches.count == 1);
        const double size = std::ldexp(1.0, static_cast<int>(bits));
        require_right({{{to_point(at)}, corners_of(triangle), to_point(at), size * 0x1p-20}, size}, touches, worst);
    }
    MESSAGE(count, " points; worst error ", worst, " of the size");
}

TEST_CASE("contact: a segment has the distance or depth and the direction of the reference") {
    Random random(6);
    double worst = 0.0;
    std::uint64_t deep = 0, several = 0;
    const std::uint64_t count = scaled(10'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 2 + random.below(18);
        const GridTriangle triangle = some_triangle(random, bits);
        const GridPoint from = point_near(random, bits, triangle), to = point_near(random, bits, triangle);
        Touches touches;
        const double size = std::ldexp(1.0, static_cast<int>(bits));
        GridPoint twice;
        for (unsigned k = 0; k < 3; ++k) twice[k] = from[k] + to[k];
        const GridTriangle doubled = {twice_of(triangle.a), twice_of(triangle.b), twice_of(triangle.c)};
        detail::contacts::touch_segment(segment_of(from, to), lattice_triangle(triangle), side_of(twice, doubled),
                                        static_cast<float>(size) * 0.25f, touches);
        REQUIRE(touches.count >= 1);
        const Points ends = {to_point(from), to_point(to)};
        const Case asked = {{ends, corners_of(triangle), middle_of(ends), size * 0x1p-18}, size};
        CAPTURE(i);
        require_right(asked, touches, worst);
        if (touches.touch[0].distance < 0.0f) ++deep;
        if (touches.count > 1) ++several;
    }
    CHECK(deep > count / 100);
    CHECK(several > count / 50);
    MESSAGE(count, " segments, ", deep, " deep, ", several, " in several places; worst error ", worst, " of the size");
}

TEST_CASE("contact: a box has the distance or depth and the direction of the reference") {
    Random random(7);
    Tally tally;
    const std::uint64_t count = scaled(2'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 4 + random.below(16);
        const GridTriangle triangle = some_triangle(random, bits);
        const GridPoint at = point_near(random, bits, triangle);
        Vec3 half[3];
        const unsigned kind = random.below(4);  // turned, along the axes, flat, sheared
        const float reach = static_cast<float>(1u << bits) * (random.coin() ? 0.02f : 0.3f);
        const auto whole = [](const Vec3& v) { return Vec3{std::round(v.x), std::round(v.y), std::round(v.z)}; };
        const Vec3 u = random.in_cube(reach), v = random.in_cube(reach);
        half[0] = whole(u);
        half[1] = whole(kind == 3 ? v : detail::cross(u, v) * (1.0f / reach));
        half[2] = whole(kind == 3 ? random.in_cube(reach) : detail::cross(half[0], half[1]) * (1.0f / reach));
        if (kind == 1) {
            half[0] = {std::round(u.x), 0.0f, 0.0f};
            half[1] = {0.0f, std::round(u.y), 0.0f};
            half[2] = {0.0f, 0.0f, std::round(u.z)};
        }
        if (kind == 2) half[random.below(3)] = {};
        if (random.below(4) == 0) {  // along a side, or nearly
            const GridPoint &from = random.coin() ? triangle.a : triangle.b, &to = triangle.c;
            const Vec3 off = random.in_cube(random.coin() ? 0.0f : 40.0f);
            half[random.below(3)] = whole({static_cast<float>(to[0] - from[0]) * 0.5f + off.x,
                                           static_cast<float>(to[1] - from[1]) * 0.5f + off.y,
                                           static_cast<float>(to[2] - from[2]) * 0.5f + off.z});
        }
        const detail::contacts::BoxBody box = box_of(integer_point(at), half, 0);
        const double size = std::ldexp(1.0, static_cast<int>(bits)) + static_cast<double>(box.size);
        const double error = size * 0x1p-18;
        const float margin = static_cast<float>(size) * 0.1f;
        Touches touches;
        detail::contacts::touch_box(box, lattice_triangle(triangle), side_of(at, triangle), margin, touches);
        tally.take({{corners_of(to_point(at), box.half), corners_of(triangle), to_point(at), error}, size}, touches,
                   margin);
    }
    tally.report(count, "boxes");
}

}  // namespace
}  // namespace espalier::tests::touch_test
