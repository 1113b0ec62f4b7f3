// Triangles of the lattice for claims about kernels: of all sizes and shapes, often at the lattice's ends.
#pragma once

#include "support/testing.hpp"

#include "as_rationals.hpp"

namespace espalier::tests {

inline GridPoint some_grid_point(Random& random, unsigned bits) {
    const std::int32_t limit = (1 << bits) - 1;
    const auto coordinate = [&] {
        const auto kind = random.below(6);
        if (kind == 0) return 0;
        if (kind == 1) return limit;
        return random.between(0, limit);
    };
    const std::int32_t x = coordinate();
    const std::int32_t y = coordinate();
    const std::int32_t z = coordinate();
    return {x, y, z};
}

/// A third of them at height 0.
inline GridPoint some_low_point(Random& random, std::int32_t limit) {
    const std::int32_t x = random.between(0, limit);
    const std::int32_t y = random.between(0, limit);
    const std::int32_t z = random.below(3) == 0 ? 0 : random.between(0, limit);
    return {x, y, z};
}

/// Moves the third corner to the middle of the others, or one step beside it.
inline void make_sliver(Random& random, std::int32_t limit, GridTriangle& triangle) {
    for (unsigned k = 0; k < 3; ++k)
        triangle.c[k] = std::clamp((triangle.a[k] + triangle.b[k]) / 2 + random.between(-1, 1), 0, limit);
}

/// Also slivers and triangles without area.
inline GridTriangle any_triangle(Random& random, unsigned bits) {
    const std::int32_t limit = (1 << bits) - 1;
    const GridPoint a = some_low_point(random, limit), b = some_low_point(random, limit);
    GridTriangle triangle = {a, b, some_low_point(random, limit)};
    const std::uint32_t kind = random.below(6);
    if (kind == 0) make_sliver(random, limit, triangle);
    if (kind == 1) {
        triangle.c = random.coin() ? triangle.a : triangle.b;
        if (random.below(3) == 0) triangle.b = triangle.a;
    }
    return triangle;
}

/// With area; large, small, needle-like and sliver-like ones.
inline GridTriangle some_triangle(Random& random, unsigned bits) {
    for (;;) {
        GridTriangle triangle{some_grid_point(random, bits), some_grid_point(random, bits),
                              some_grid_point(random, bits)};
        const std::int32_t limit = (1 << bits) - 1;
        const auto near = [&](const GridPoint& p, std::int32_t by) {
            GridPoint q = p;
            for (std::int32_t& c : q) c = std::clamp(c + random.between(-by, by), 0, limit);
            return q;
        };
        switch (random.below(4)) {
            case 0:
                break;
            case 1:
                triangle.b = near(triangle.a, 3);
                break;
            case 2:
                triangle.b = near(triangle.a, 40);
                triangle.c = near(triangle.a, 40);
                break;
            default:
                for (unsigned k = 0; k < 3; ++k) triangle.c[k] = (triangle.a[k] + triangle.b[k]) / 2;
                triangle.c = near(triangle.c, 1);
        }
        if (oracle::normal_of(exact_triangle(triangle)) != oracle::Point(0, 0, 0)) return triangle;
    }
}

/// Without area: on a line, with two corners at one place or all three.
inline GridTriangle flat_triangle(Random& random, unsigned bits) {
    const std::int32_t limit = (1 << bits) - 1;
    GridTriangle triangle{some_grid_point(random, bits), some_grid_point(random, bits), {}};
    triangle.c = triangle.a;
    switch (random.below(6)) {
        case 0:
            triangle.b = triangle.a;
            break;
        case 1:
            std::swap(triangle.a, triangle.b);
            break;
        case 2:
            break;
        default: {
            const std::int32_t along = random.between(-9, 9), other = random.between(-9, 9);
            for (unsigned k = 0; k < 3; ++k) {
                // So short that all three stay on the lattice.
                const std::int32_t room = std::min(triangle.a[k], limit - triangle.a[k]) / 9;
                const std::int32_t side = random.between(-room, room);
                triangle.b[k] = triangle.a[k] + along * side;
                triangle.c[k] = triangle.a[k] + other * side;
            }
        }
    }
    return triangle;
}

/// A point of the triangle by weights that were rounded.
inline oracle::Point weighted(const oracle::Triangle& triangle, float u, float v) {
    return triangle.a + (triangle.b - triangle.a) * Rational::of(u) + (triangle.c - triangle.a) * Rational::of(v);
}

/// No less than the longer of two sides.
inline Rational size_of(const oracle::Triangle& t) {
    Rational size = 0;
    for (int k = 0; k < 3; ++k) size += oracle::absolute(t.b[k] - t.a[k]) + oracle::absolute(t.c[k] - t.a[k]);
    return size;
}

/// Returns whether the root of `squared` is at most that of `allowed` and the slack: both squared twice.
inline bool is_root_within(const Rational& squared, const Rational& allowed, const Rational& slack) {
    const Rational above = squared - allowed - slack * slack;
    return above.sign() <= 0 || above * above <= Rational(4) * slack * slack * allowed;
}

/// Calls `is_within(radius)` for some floats next to the root of a squared distance, which is rounded, and for ones
/// that are larger than all distances. It must be true exactly from the exact distance on. Returns how many of the nine
/// were the exact distance.
template <class IsWithin>
std::uint64_t check_radii(float rounded, const Rational& squared, IsWithin is_within) {
    std::uint64_t exactly = 0;
    float radius = std::sqrt(rounded);
    for (int step = 0; step < 4 && radius > 0.0f; ++step) radius = std::nextafter(radius, 0.0f);
    for (int step = 0; step < 9; ++step, radius = std::nextafter(radius, 1e30f)) {
        if (radius > 0.0f && radius < 0x1p-100f) radius = 0x1p-100f;
        const Rational square = Rational::of(radius) * Rational::of(radius);
        CAPTURE(radius);
        REQUIRE(is_within(radius) == (squared <= square));
        exactly += squared == square ? 1u : 0u;
    }
    REQUIRE(is_within(1e30f));
    REQUIRE(is_within(std::numeric_limits<float>::infinity()));
    return exactly;
}

/// Checks the radii of `count` random cases of a kernel. `draw(random, check)` makes one, or nothing, and calls `check`
/// as check_radii is called.
template <class Draw>
void check_within_radius(const char* kernel, std::uint64_t count, Draw draw) {
    Random random(2);
    std::uint64_t decided = 0, exactly = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        CAPTURE(i);
        draw(random, [&](float rounded, const Rational& squared, auto is_within) {
            exactly += check_radii(rounded, squared, [&](float radius) {
                ++decided;
                return is_within(radius);
            });
        });
    }
    CHECK(exactly > count / 100);
    MESSAGE(decisions_made(kernel, decided));
}

}  // namespace espalier::tests
