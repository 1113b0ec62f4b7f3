// Lower bounds of the distances of points and segments from one triangle, squared, in float: for walks without lanes.
// Nothing of a convex body is nearer than the least that its corners are along any direction, over its length. The
// directions are those of the closest points, nearly, so that the bounds are tight (docs/numerics.md, *A tighter
// bound*).
#pragma once

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Returns at least the sum of the absolute coordinates of any point of the asset, seen from the point.
inline float reach_from(const BlobData& blob, const float* point) {
    float reach = 0.0f;
    for (int k = 0; k < 3; ++k) reach += maximum(absolute(point[k]), absolute(blob.extent_steps[k] - point[k]));
    return reach;
}

/// A triangle in float, seen from a point of a shape.
struct SeenTriangle {
    float corner[3][3];

    ESPALIER_PART_OF_CALLER SeenTriangle(const LatticeTriangle& triangle, const float* from) {
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corner[i][k] = static_cast<float>(triangle.corner[i][k]) - from[k];
    }
};

namespace triangle_gap {

inline float dot(const float* a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns the bound along a direction; 0 or a NaN where nothing is clear. `end` is how far along the shape's other end
/// is, `reach` bounds what all of this rounds.
ESPALIER_PART_OF_CALLER inline float squared_along(const SeenTriangle& t, const float* direction, float end,
                                                   float reach) {
    const Span<float> along =
        span_of(dot(direction, t.corner[0]), dot(direction, t.corner[1]), dot(direction, t.corner[2]));
    const float apart = maximum(along.low - maximum(end, 0.0f), minimum(end, 0.0f) - along.high);
    const float length_bound = absolute(direction[0]) + absolute(direction[1]) + absolute(direction[2]);
    const float gap = apart - length_bound * reach * 0x1p-20f;
    // No squared length of a direction that matters is as small as this.
    return gap > 0.0f ? gap * (gap / maximum(dot(direction, direction), 0x1p-60f)) : 0.0f;
}

/// Sets the direction of the closest point, nearly, by the regions of the exact kernel (point_triangle.hpp).
inline void set_direction(const SeenTriangle& t, float* direction) {
    const auto& [a, b, c] = t.corner;
    float ab[3], ac[3];
    for (int k = 0; k < 3; ++k) {
        ab[k] = b[k] - a[k];
        ac[k] = c[k] - a[k];
    }
    float v = 0.0f, w = 0.0f;  // weights of b and c
    const float b_of_a = -dot(ab, a), c_of_a = -dot(ac, a);
    if (b_of_a > 0.0f || c_of_a > 0.0f) {
        const float b_of_b = -dot(ab, b), c_of_b = -dot(ac, b);
        const float b_of_c = -dot(ab, c), c_of_c = -dot(ac, c);
        const float to_b = b_of_c - c_of_c, to_c = c_of_b - b_of_b;
        if (b_of_b >= 0.0f && to_c <= 0.0f) {
            v = 1.0f;
        } else if (c_of_c >= 0.0f && to_b <= 0.0f) {
            w = 1.0f;
        } else if (b_of_a >= 0.0f && b_of_b <= 0.0f && b_of_a * c_of_b <= b_of_b * c_of_a) {
            v = b_of_a / (b_of_a - b_of_b);
        } else if (c_of_a >= 0.0f && c_of_c <= 0.0f && b_of_c * c_of_a <= b_of_a * c_of_c) {
            w = c_of_a / (c_of_a - c_of_c);
        } else if (to_b <= 0.0f || to_c <= 0.0f || b_of_b * c_of_c > b_of_c * c_of_b) {
            for (int k = 0; k < 3; ++k) {
                const int y = k == 2 ? 0 : k + 1, z = k == 0 ? 2 : k - 1;
                direction[k] = ab[y] * ac[z] - ab[z] * ac[y];
            }
            return;
        } else {
            w = to_c / (to_c + to_b);
            v = 1.0f - w;
        }
    }
    for (int k = 0; k < 3; ++k) direction[k] = a[k] + (v * ab[k] + w * ac[k]);
}

/// How far along something of that length, from 0 to 1.
inline float share_of(float along, float length, float least_length) {
    return maximum(minimum(along / maximum(length, least_length), 1.0f), 0.0f);
}

}  // namespace triangle_gap

/// `reach` is that of the point.
inline float squared_gap_to_point(const LatticeTriangle& triangle, const float* point, float reach) {
    const SeenTriangle t(triangle, point);
    float direction[3];
    triangle_gap::set_direction(t, direction);
    return triangle_gap::squared_along(t, direction, 0.0f, reach);
}

/// Tight unless an end of the segment is nearest to the triangle's face: from the closest points of the segment and of
/// the triangle's sides (Ericson 2005, 5.1.9). `reach` is that of `from`.
inline float squared_gap_to_segment(const LatticeTriangle& triangle, const float* from, const float* to, float reach) {
    using namespace triangle_gap;
    const SeenTriangle t(triangle, from);
    const float way[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const float squared_way = dot(way, way);
    float direction[3] = {0.0f, 0.0f, 0.0f};
    float squared_length = infinity;
    for (int i = 0; i < 3; ++i) {
        const float* const start = t.corner[i];
        const float* const end = t.corner[i == 2 ? 0 : i + 1];
        const float side[3] = {end[0] - start[0], end[1] - start[1], end[2] - start[2]};
        const float squared_side = dot(side, side), both = dot(way, side);
        const float on_way = dot(start, way), on_side = dot(start, side);
        // Sides are whole steps long, segments whole units of 2^-6 steps.
        float along =
            share_of(on_way * squared_side - on_side * both, squared_way * squared_side - both * both, 0x1p-24f);
        const float share = share_of(along * both - on_side, squared_side, 1.0f);
        along = share_of(on_way + share * both, squared_way, 0x1p-12f);
        float between[3];
        for (int k = 0; k < 3; ++k) between[k] = start[k] + share * side[k] - along * way[k];
        const float squared = dot(between, between);
        if (squared >= squared_length) continue;
        squared_length = squared;
        for (int k = 0; k < 3; ++k) direction[k] = between[k];
    }
    return squared_along(t, direction, dot(direction, way),
                         reach + (absolute(way[0]) + absolute(way[1]) + absolute(way[2])));
}

}  // namespace espalier::detail
