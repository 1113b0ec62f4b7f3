// Triangles of the lattice for claims about kernels: of all sizes and shapes, often at the lattice's ends.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "as_rationals.hpp"
#include "support/base/random.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

inline GridPoint some_grid_point(Random& random, unsigned bits) {
    const std::int32_t limit = (1 << bits) - 1;
    const auto coordinate = [&] {
        switch (random.below(6)) {
            case 0:
                return 0;
            case 1:
                return limit;
            default:
                return random.between(0, limit);
        }
    };
    const std::int32_t x = coordinate();
    const std::int32_t y = coordinate();
    const std::int32_t z = coordinate();
    return {x, y, z};
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

}  // namespace espalier::tests
