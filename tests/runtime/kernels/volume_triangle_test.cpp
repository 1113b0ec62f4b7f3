// Claims about the kernels of volumes, against exact arithmetic that knows nothing of separating axes.
#include "support/testing.hpp"

#include <runtime/overlap/rounded_shapes.hpp>

#include "oracle/convex_hull.hpp"
#include "support/exact/as_rationals.hpp"

namespace espalier::tests::volume_triangle_test {
namespace {

using detail::Integer3;
using detail::LatticeTriangle;
using oracle::BigInteger;

/// Corners of a parallelepiped and of a triangle, in units of 2^-fraction_bits steps.
template <class Number>
bool meet_in_truth(const Integer3& center, const Integer3* half, int fraction_bits, const LatticeTriangle& triangle) {
    std::vector<oracle::WholePoint<Number>> box, corners;
    for (int signs = 0; signs < 8; ++signs) {
        const auto signed_half = [&](int i, std::int64_t Integer3::*axis) {
            return (signs >> i & 1) != 0 ? half[i].*axis : -(half[i].*axis);
        };
        const auto at = [&](std::int64_t Integer3::*axis) {
            return Number(center.*axis + signed_half(0, axis) + signed_half(1, axis) + signed_half(2, axis));
        };
        const oracle::WholePoint<Number> corner = {at(&Integer3::x), at(&Integer3::y), at(&Integer3::z)};
        if (std::find(box.begin(), box.end(), corner) == box.end()) box.push_back(corner);
    }
    for (const auto& c : triangle.corner)
        corners.push_back({Number(std::int64_t{c[0]} << fraction_bits), Number(std::int64_t{c[1]} << fraction_bits),
                           Number(std::int64_t{c[2]} << fraction_bits)});
    return oracle::hulls_meet(box, corners);
}

/// In int64 where the coordinates are so short that the oracle's products fit.
bool meet_in_truth(const Integer3& center, const Integer3* half, int fraction_bits, unsigned bits,
                   const LatticeTriangle& triangle) {
    return bits <= 11 ? meet_in_truth<std::int64_t>(center, half, fraction_bits, triangle)
                      : meet_in_truth<BigInteger>(center, half, fraction_bits, triangle);
}

std::string describe(const LatticeTriangle& t) {
    std::string text = "triangle ";
    for (const auto& c : t.corner)
        text.append("(")
            .append(std::to_string(c[0]))
            .append(" ")
            .append(std::to_string(c[1]))
            .append(" ")
            .append(std::to_string(c[2]))
            .append(") ");
    return text;
}

/// Small numbers meet often and touch often, large ones show that nothing overflows.
struct Maker {
    Random random;

    std::int32_t coordinate(unsigned bits) { return static_cast<std::int32_t>(random.next() >> (64 - bits)); }
    LatticeTriangle triangle(unsigned bits) {
        LatticeTriangle t;
        for (auto& corner : t.corner)
            for (std::int32_t& c : corner) c = coordinate(bits);
        const std::uint32_t kind = random.below(16);
        if (kind == 0) t.corner[1][0] = t.corner[2][0] = t.corner[0][0];
        for (int k = 0; k < 3; ++k) {
            if (kind == 1 || kind == 2) t.corner[1][k] = t.corner[0][k];
            if (kind == 1) t.corner[2][k] = t.corner[0][k];
        }
        // Short ones take the narrow arithmetic.
        const auto length = static_cast<unsigned>(random.below(bits));
        if (bits > 12 && random.coin())
            for (int i = 1; i < 3; ++i)
                for (int k = 0; k < 3; ++k)
                    t.corner[i][k] = std::min((1 << bits) - 1, t.corner[0][k] + coordinate(length % 12 + 1));
        return t;
    }
    float steps(unsigned bits, int fraction) {
        return std::ldexp(static_cast<float>(coordinate(bits + 1) - coordinate(bits)), fraction);
    }
    Vec3 point(unsigned bits, int fraction) {
        const float x = steps(bits, fraction), y = steps(bits, fraction);
        return {x, y, steps(bits, fraction)};
    }
};

Vec3 to_vec3(const std::int32_t* c) {
    return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}
Vec3 difference(const std::int32_t* a, const std::int32_t* b) {
    return {static_cast<float>(a[0] - b[0]), static_cast<float>(a[1] - b[1]), static_cast<float>(a[2] - b[2])};
}

Integer3 to_integer3(const std::int64_t* a) { return {a[0], a[1], a[2]}; }

struct Counts {
    std::uint64_t yes = 0, no = 0;
    void add(bool answer) { ++(answer ? yes : no); }
    void check() const {
        CHECK(yes > (yes + no) / 10);
        CHECK(no > (yes + no) / 10);
    }
};

/// Compares the kernel with exact arithmetic at shapes and triangles of each number of bits: `make(bits, triangle)`
/// draws a shape, and `meet(rounded, bits, triangle)` decides about it.
template <class Shape, class Make, class Meet>
void decide(const char* name, Maker& maker, std::initializer_list<unsigned> sizes, std::uint64_t small_ones,
            std::uint64_t large_ones, Make make, Meet meet) {
    std::uint64_t decided = 0;
    for (const unsigned bits : sizes) {
        Counts counts;
        const detail::BlobData asset = lattice_asset(bits);
        for (std::uint64_t i = 0; i < scaled(bits <= 4 ? small_ones : large_ones); ++i) {
            const LatticeTriangle triangle = maker.triangle(bits);
            detail::Rounded<Shape> rounded;
            const QueryStatus status = round_volume(asset, make(bits, triangle), rounded);
            if (status == QueryStatus::not_found) continue;  // clearly apart
            REQUIRE(status == QueryStatus::ok);
            CAPTURE(describe(triangle));
            const bool expected = meet(rounded, bits, triangle);
            ++decided;
            REQUIRE(meets(rounded, triangle) == expected);
            counts.add(expected);
        }
        counts.check();
    }
    MESSAGE(decisions_made(name, decided));
}

TEST_CASE("kernel: axis-aligned boxes and triangles overlap as in exact arithmetic") {
    Maker maker{Random(3)};
    const auto make = [&](unsigned bits, const LatticeTriangle& triangle) {
        const int fraction = bits == 24 ? 0 : -static_cast<int>(maker.random.below(3));
        Box box = {maker.point(bits, fraction), {}};
        box.max = box.min;
        for (float* c : {&box.max.x, &box.max.y, &box.max.z})
            if (maker.random.below(4) != 0) *c += std::fabs(maker.steps(bits, fraction));
        if (maker.random.below(4) == 0) box.min.y = -INFINITY;
        if (maker.random.coin()) {  // around a corner, or up to it
            const Vec3 corner = to_vec3(triangle.corner[maker.random.below(3)]);
            if (maker.random.coin()) box.min.x = box.max.x - std::fabs(box.max.x - corner.x);
            box.min.z = std::min(box.min.z, corner.z);
            box.max = {std::max(box.max.x, corner.x), std::max(box.max.y, corner.y), std::max(box.max.z, corner.z)};
        }
        return box;
    };
    const auto meet = [](const detail::Rounded<Box>& box, unsigned bits, const LatticeTriangle& triangle) {
        const Integer3 half[3] = {{box.half[0], 0, 0}, {0, box.half[1], 0}, {0, 0, box.half[2]}};
        return meet_in_truth(to_integer3(box.center), half, detail::Rounded<Box>::fraction_bits, bits + 8, triangle);
    };
    decide<Box>("box and triangle", maker, {1, 2, 3, 12, 24}, 20'000, 1'000, make, meet);
}

TEST_CASE("kernel: oriented boxes and triangles overlap as in exact arithmetic") {
    Maker maker{Random(4)};
    const auto make = [&](unsigned bits, const LatticeTriangle& triangle) {
        const int fraction = bits == 24 ? 0 : -static_cast<int>(maker.random.below(2));
        OrientedBox box = {maker.point(bits, fraction), {}};
        for (Vec3& half : box.half_axes) half = maker.point(bits, fraction);
        const auto kind = maker.random.below(8);
        if (kind == 0) {  // in the triangle's plane, or on it
            box.half_axes[0] = difference(triangle.corner[1], triangle.corner[0]);
            box.half_axes[1] = difference(triangle.corner[2], triangle.corner[0]);
            if (maker.random.coin()) box.half_axes[2] = {};
            box.center = to_vec3(triangle.corner[0]);
            box.center.x += 3.0f * box.half_axes[0].x - box.half_axes[2].x;
            box.center.y += 3.0f * box.half_axes[0].y - box.half_axes[2].y;
            box.center.z += 3.0f * box.half_axes[0].z - box.half_axes[2].z;
        } else if (kind == 1) {
            box.half_axes[2] = {};
        } else if (kind == 2) {
            box.half_axes[1] = box.half_axes[2] = box.half_axes[0];
        } else if (kind == 3) {
            box.half_axes[1] = box.half_axes[2] = {};
        } else if (kind == 4) {
            box.half_axes[0] = box.half_axes[1] = box.half_axes[2] = {};
        } else if (kind == 5) {  // touching by a corner
            box.center = to_vec3(triangle.corner[1]);
            box.center.x += box.half_axes[0].x + box.half_axes[1].x + box.half_axes[2].x;
            box.center.y += box.half_axes[0].y + box.half_axes[1].y + box.half_axes[2].y;
            box.center.z += box.half_axes[0].z + box.half_axes[1].z + box.half_axes[2].z;
        }
        return box;
    };
    std::set<unsigned> flat;
    const auto meet = [&](const detail::Rounded<OrientedBox>& box, unsigned bits, const LatticeTriangle& triangle) {
        if (box.face_reach.is_zero()) flat.insert(bits);
        return meet_in_truth(box.center, box.half, box.fraction_bits, bits + 8, triangle);
    };
    decide<OrientedBox>("oriented box and triangle", maker, {1, 2, 3, 12, 16, 24}, 20'000, 1'000, make, meet);
    CHECK(flat.size() == 6);
}

TEST_CASE("kernel: an oriented box along the axes is the box of the same bounds") {
    Maker maker{Random(5)};
    const detail::BlobData asset = lattice_asset(16);
    for (std::uint64_t i = 0; i < scaled(3'000); ++i) {
        const LatticeTriangle triangle = maker.triangle(16);
        const Vec3 half = {std::fabs(maker.steps(14, -1)), maker.random.coin() ? 0.0f : std::fabs(maker.steps(12, 0)),
                           std::fabs(maker.steps(15, 0))};
        const Vec3 center = maker.random.coin() ? maker.point(16, 0) : to_vec3(triangle.corner[0]);
        detail::Rounded<Box> box;
        detail::Rounded<OrientedBox> oriented;
        const auto meets_rounded = [&](const auto& shape, auto& rounded) {
            const QueryStatus status = round_volume(asset, shape, rounded);
            REQUIRE(!is_refused(status));
            return status == QueryStatus::ok && meets(rounded, triangle);
        };
        const Box world = {tests::difference(center, half), sum(center, half)};
        const OrientedBox same = {center, {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}}};
        REQUIRE(meets_rounded(world, box) == meets_rounded(same, oriented));
    }
}

using Polygon = std::vector<oracle::Point>;

/// What of a convex polygon, which may have lost its area, is in the half-space.
Polygon clipped(const Polygon& polygon, const detail::LatticePlane& plane) {
    const auto room = [&](const oracle::Point& p) {
        Rational sum = plane.offset;
        for (int k = 0; k < 3; ++k) sum -= Rational(std::int64_t{plane.normal[k]}) * p[k];
        return sum;
    };
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const oracle::Point& from = polygon[i];
        const oracle::Point& to = polygon[(i + 1) % polygon.size()];
        const Rational here = room(from), there = room(to);
        if (here.sign() >= 0) result.push_back(from);
        if (here.sign() * there.sign() < 0) result.push_back(from + (to - from) * (here / (here - there)));
    }
    return result;
}

bool meet_in_truth(const detail::Rounded<ConvexVolume>& set, const LatticeTriangle& triangle) {
    Polygon polygon;
    for (const auto& c : triangle.corner)
        polygon.push_back({Rational(std::int64_t{c[0]}), Rational(std::int64_t{c[1]}), Rational(std::int64_t{c[2]})});
    for (unsigned i = 0; i < set.plane_count; ++i) polygon = clipped(polygon, set.planes[i]);
    return !polygon.empty();
}

TEST_CASE("kernel: half-spaces and triangles overlap as in exact arithmetic") {
    Maker maker{Random(6)};
    std::vector<Plane> planes;
    const auto make = [&](unsigned bits, const LatticeTriangle& triangle) {
        planes.assign(1 + maker.random.below(maker.random.below(8) == 0 ? 32 : 6), Plane{});
        const bool round = maker.random.coin();
        const auto weight = [&] { return static_cast<float>(maker.random.below(3)) * 0.5f; };
        // Through a point of the triangle or near it, so that planes touch.
        const float v = weight(), w = weight() * (1.0f - 0.5f * v);
        const Vec3 a = to_vec3(triangle.corner[0]);
        const Vec3 ab = difference(triangle.corner[1], triangle.corner[0]);
        const Vec3 ac = difference(triangle.corner[2], triangle.corner[0]);
        const Vec3 on = {a.x + v * ab.x + w * ac.x, a.y + v * ab.y + w * ac.y, a.z + v * ab.z + w * ac.z};
        for (Plane& plane : planes) {
            do
                plane.normal = round ? Vec3{static_cast<float>(maker.random.between(-2, 2)),
                                            static_cast<float>(maker.random.between(-2, 2)),
                                            static_cast<float>(maker.random.between(-1, 1))}
                                     : maker.random.in_cube(1.0f);
            while (plane.normal == Vec3{});
            plane.offset = dot(plane.normal, on);
            if (maker.random.below(3) == 0) plane.offset += maker.steps(bits, -2) * maker.random.unit();
        }
        if (planes.size() > 1 && maker.random.below(4) == 0) {
            const Plane& first = planes[0];
            planes[1] = {{-first.normal.x, -first.normal.y, -first.normal.z}, -first.offset};
        }
        return ConvexVolume{planes};
    };
    const auto meet = [&](const detail::Rounded<ConvexVolume>& set, unsigned, const LatticeTriangle& triangle) {
        REQUIRE(set.plane_count == planes.size());
        return meet_in_truth(set, triangle);
    };
    decide<ConvexVolume>("half-spaces and triangle", maker, {1, 2, 4, 16, 24}, 4'000, 800, make, meet);
}

TEST_CASE("rounding: a plane gets a normal of 24 bits and the nearest offset") {
    Random random(7);
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        detail::BlobData asset = lattice_asset(16);
        asset.step_exponent = static_cast<std::int16_t>(random.between(-40, 40));
        asset.derive();
        const auto any = [&](int low, int high) {
            return random.below(8) == 0 ? 0.0f : std::ldexp(random.signed_unit(), random.between(low, high));
        };
        for (int k = 0; k < 3; ++k) asset.origin[k] = std::ldexp(any(0, 30), asset.step_exponent);
        const int scale = random.between(-90, 40);
        Plane plane = {{any(scale - 4, scale), any(scale - 30, scale), any(scale, scale)}, 0.0f};
        if (plane.normal == Vec3{}) plane.normal.x = std::ldexp(1.0f, scale);
        plane.offset = std::ldexp(any(0, 30), scale + asset.step_exponent);
        // Subnormal numbers count as zero.
        for (float* x : {&plane.normal.x, &plane.normal.y, &plane.normal.z, &plane.offset})
            *x = detail::flush_subnormal(*x);
        detail::Rounded<ConvexVolume> set;
        REQUIRE(round_volume(asset, ConvexVolume{{&plane, 1}}, set) == QueryStatus::ok);
        const detail::LatticePlane& rounded = set.planes[0];
        const float normal[3] = {plane.normal.x, plane.normal.y, plane.normal.z};
        int exponent = -1000;
        for (const float n : normal)
            if (n != 0.0f) exponent = std::max(exponent, std::ilogb(n));
        const Rational scaling = Rational::of(1, 23 - exponent);
        Rational offset = Rational::of(plane.offset);
        for (int k = 0; k < 3; ++k) {
            const Rational exact = Rational::of(normal[k]) * scaling;
            CHECK(oracle::absolute(exact - Rational(std::int64_t{rounded.normal[k]})) <= Rational::of(1, -1));
            offset -= Rational::of(normal[k]) * Rational::of(asset.origin[k]);
        }
        const Rational exact = offset * scaling * Rational::of(1, -asset.step_exponent);
        if (oracle::absolute(exact) < Rational::of(1, 52)) {
            CHECK(oracle::absolute(exact - Rational(rounded.offset)) <= Rational::of(1, -1) + Rational::of(1, -13));
        } else {
            CHECK(rounded.offset == (exact.sign() < 0 ? -1 : 1) * (std::int64_t{1} << 52));
        }
    }
}

}  // namespace
}  // namespace espalier::tests::volume_triangle_test
