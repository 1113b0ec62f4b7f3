// A quick lower bound of the time at which a moving capsule or sphere first touches a triangle, for cores without
// lanes.
#pragma once

#include <runtime/sweeps/float_shapes.hpp>

namespace espalier::detail {

/// What a capsule sweeps is a parallelogram grown by the radius. Three directions across it separate it from most
/// triangles, or tell when they no longer do: its normal, and in its plane across the way and across the axis. Any
/// directions are right; where way and axis are parallel, others take their place.
class SeparatingDirections {
public:
    explicit SeparatingDirections(const FloatCapsule& capsule) {
        float way[3], axis[3], normal[3];
        const bool moves = to_unit_length(capsule.way, way), is_long = to_unit_length(capsule.axis, axis);
        const float* const along = moves ? way : axis;
        set_cross(axis, way, normal);
        const bool is_plane = moves && is_long && dot(normal, normal) > 0x1p-20f;
        if (!is_plane) {
            int least = 0;
            for (int k = 1; k < 3; ++k)
                if (absolute(along[k]) < absolute(along[least])) least = k;
            float other[3] = {0.0f, 0.0f, 0.0f};
            other[least] = 1.0f;
            set_cross(along, other, normal);
        }
        if (!to_unit_length(normal, normal)) normal[0] = 1.0f;  // of a sphere that rests
        float across[3];
        set_cross(normal, along, across);
        set_direction(directions_[0], normal, capsule);
        set_direction(directions_[1], across, capsule);
        if (is_plane) set_cross(normal, axis, across);
        set_direction(directions_[2], is_plane ? across : along, capsule);
    }
    /// Returns a time that is not after the first contact; above the limit any time above it.
    [[nodiscard]] float bound(const LatticeTriangle& triangle, float limit) const {
        float corners[3][3];
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k) corners[i][k] = static_cast<float>(triangle.corner[i][k]);
        float first = 0.0f;
        for (const Direction& d : directions_) {
            const float a = dot(corners[0], d.scaled), b = dot(corners[1], d.scaled), c = dot(corners[2], d.scaled);
            const Span<float> span = span_of(a, b, c);
            const float gap = span.low - d.high;
            if (gap > 0.0f) first = maximum(gap * d.inverse, first);
            if (first > limit || d.low + first * d.speed > span.high) return infinity;
        }
        return first;
    }

private:
    /// More than all of this rounds (docs/numerics.md, Sweeps).
    static constexpr float error = 0x1p-17f;

    /// The capsule is between low and high at the start, and moves upward by `speed`.
    struct Direction {
        float scaled[3];  ///< times the scale of lanes: of lattice coordinates
        float low, high, speed, inverse;
    };

    static float dot(const float* a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
    static void set_cross(const float* a, const float* b, float* result) {
        for (int k = 0; k < 3; ++k) {
            const int y = k == 2 ? 0 : k + 1, z = k == 0 ? 2 : k - 1;
            result[k] = a[y] * b[z] - a[z] * b[y];
        }
    }
    /// False where the vector is too short; the result is zero then.
    static bool to_unit_length(const float* a, float* unit) {
        const float squared = dot(a, a);
        const bool is_long = squared > 0x1p-60f;
        const float inverse = is_long ? 1.0f / square_root(squared) : 0.0f;
        for (int k = 0; k < 3; ++k) unit[k] = a[k] * inverse;
        return is_long;
    }
    static void set_direction(Direction& direction, const float* unit, const FloatCapsule& capsule) {
        const float speed = dot(unit, capsule.way);
        const float sign = speed < 0.0f ? -1.0f : 1.0f;
        for (int k = 0; k < 3; ++k) direction.scaled[k] = unit[k] * sign * capsule.scale;
        const float at = dot(unit, capsule.from) * sign, end = dot(unit, capsule.axis) * sign;
        const float radius = capsule.radius * (1.0f + 0x1p-18f) + error;
        direction.low = at + minimum(end, 0.0f) - radius - error;
        direction.high = at + maximum(end, 0.0f) + radius;
        direction.speed = absolute(speed);
        direction.inverse = (1.0f - 0x1p-20f) / (absolute(speed) + error);
    }

    Direction directions_[3];
};

}  // namespace espalier::detail
