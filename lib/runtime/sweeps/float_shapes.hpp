// Moving shapes as lanes take them: in floats, times a power of two that makes the largest coordinate about 1.
#pragma once

#include <runtime/sweeps/round_sweep.hpp>

namespace espalier::detail {

/// How far floats may move a shape and a triangle towards each other, and more (docs/numerics.md): shapes are grown by
/// this.
inline constexpr float float_slack = 0x1p-19f;
/// From this distance on, in lattice steps, only boxes are compared: products of small sides would be subnormal.
inline constexpr float farthest_in_floats = 0x1p25f;

struct FloatSweep {
    float scale;
    bool is_far;
    float from[3];  ///< a point of the shape at the start
    float way[3];   ///< the displacement
    float low[3];   ///< of the box around the shape, seen from that point
    float high[3];
};

struct FloatCapsule : FloatSweep {
    float axis[3];  ///< from the point to the other end
    float radius;
    bool is_sphere;
};

struct FloatBox : FloatSweep {
    float half[3];  ///< of the sides; the point is the middle
};

struct FloatHull : FloatSweep {
    /// What the hull takes up along an axis.
    struct Axis {
        float along[3];
        float low, high;
    };
    unsigned point_count;
    float point[max_hull_vertices][3];  ///< seen from the middle of the box
    unsigned edge_count;                ///< 3 of an oriented box, else 0
    float half_edge[3][3];
    unsigned axis_count;
    Axis axis[10];  ///< the faces of an oriented box; the diagonals of coordinate axes for other hulls
};

/// Sets what all shapes share but their box. The point is given in units of the sweep, `size` is the largest coordinate
/// of anything seen from it, in lattice steps.
inline void set_way(const BlobData& blob, const LatticeSweep& sweep, const Integer3& from, float size,
                    FloatSweep& lanes) {
    const float step = power_of_two(-sweep.fraction_bits);
    float reach = maximum(size, 1.0f);
    for (int k = 0; k < 3; ++k) {
        lanes.from[k] = to_float(from[k]) * step;
        lanes.way[k] = to_float(sweep.displacement[k]) * step;
        reach = maximum(maximum(absolute(lanes.from[k]), absolute(lanes.from[k] - blob.extent_steps[k])), reach);
        reach = maximum(absolute(lanes.way[k]), reach);
    }
    lanes.is_far = reach > farthest_in_floats;
    lanes.scale = power_of_two(-exponent_of(reach) - 1);
    for (int k = 0; k < 3; ++k) {
        lanes.from[k] *= lanes.scale;
        lanes.way[k] *= lanes.scale;
    }
}

inline FloatCapsule float_shape(const BlobData& blob, const CapsuleSweep& sweep) {
    FloatCapsule lanes;
    const float step = power_of_two(-sweep.fraction_bits);
    const float radius = to_float(sweep.moving.sphere.radius) * step;
    float size = radius;
    for (int k = 0; k < 3; ++k) {
        lanes.axis[k] = to_float(sweep.moving.axis[k]) * step;
        size = maximum(absolute(lanes.axis[k]), size);
    }
    set_way(blob, sweep, sweep.from, size, lanes);
    lanes.radius = radius * lanes.scale + float_slack;
    lanes.is_sphere = is_zero(sweep.moving.axis);
    for (int k = 0; k < 3; ++k) {
        lanes.axis[k] *= lanes.scale;
        lanes.low[k] = minimum(lanes.axis[k], 0.0f) - lanes.radius;
        lanes.high[k] = maximum(lanes.axis[k], 0.0f) + lanes.radius;
    }
    return lanes;
}

inline FloatBox float_shape(const BlobData& blob, const BoxSweep& sweep) {
    FloatBox lanes;
    const float half_step = power_of_two(-sweep.fraction_bits - 1);
    float size = 0.0f;
    for (int k = 0; k < 3; ++k) {
        lanes.half[k] = to_float(sweep.high[k] - sweep.low[k]) * half_step;
        size = maximum(lanes.half[k], size);
    }
    set_way(blob, sweep, sweep.middle(), size, lanes);
    // The middle is rounded down to a whole unit.
    const float slack = float_slack + half_step * lanes.scale;
    for (int k = 0; k < 3; ++k) {
        lanes.half[k] = lanes.half[k] * lanes.scale + slack;
        lanes.low[k] = -lanes.half[k];
        lanes.high[k] = lanes.half[k];
    }
    return lanes;
}

/// The ends are grown by what floats may move hull and triangles.
inline void add_axis(FloatHull& lanes, const Vec3& along) {
    FloatHull::Axis& axis = lanes.axis[lanes.axis_count++];
    axis = {{along.x, along.y, along.z}, infinity, -infinity};
    for (unsigned i = 0; i < lanes.point_count; ++i) {
        const float* const p = lanes.point[i];
        const float at = along.x * p[0] + along.y * p[1] + along.z * p[2];
        axis.low = minimum(at, axis.low);
        axis.high = maximum(at, axis.high);
    }
    const float slack = sum_of_magnitudes(along) * float_slack;
    axis.low -= slack;
    axis.high += slack;
}
inline void set_faces(const HullSweep& sweep, float scale, FloatHull& lanes) {
    const auto& corner = sweep.moving.point;
    lanes.edge_count = 3;
    for (unsigned i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            lanes.half_edge[i][k] = to_float(std::int64_t{corner[1u << i][k]} - corner[0][k]) * (scale * 0.5f);
    for (unsigned i = 0; i < 3; ++i) {
        const float *a = lanes.half_edge[i == 2 ? 0 : i + 1], *b = lanes.half_edge[i == 0 ? 2 : i - 1];
        add_axis(lanes, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
    }
}
inline void set_diagonals(FloatHull& lanes) {
    for (const float sign : {1.0f, -1.0f}) {
        add_axis(lanes, {0.0f, 1.0f, sign});
        add_axis(lanes, {1.0f, 0.0f, sign});
        add_axis(lanes, {1.0f, sign, 0.0f});
        add_axis(lanes, {1.0f, 1.0f, sign});
        add_axis(lanes, {1.0f, -1.0f, sign});
    }
}

inline FloatHull float_shape(const BlobData& blob, const HullSweep& sweep) {
    FloatHull lanes;
    const float step = power_of_two(-sweep.fraction_bits);
    const Integer3 middle = sweep.middle();
    float size = 0.0f;
    for (int k = 0; k < 3; ++k) size = maximum(to_float(sweep.high[k] - middle[k]) * step, size);
    set_way(blob, sweep, middle, size, lanes);
    const float scale = step * lanes.scale;
    lanes.point_count = sweep.moving.point_count;
    for (unsigned i = 0; i < lanes.point_count; ++i)
        for (int k = 0; k < 3; ++k) lanes.point[i][k] = to_float(sweep.moving.point[i][k] - middle[k]) * scale;
    for (int k = 0; k < 3; ++k) {
        lanes.low[k] = to_float(sweep.low[k] - middle[k]) * scale - float_slack;
        lanes.high[k] = to_float(sweep.high[k] - middle[k]) * scale + float_slack;
    }
    lanes.edge_count = lanes.axis_count = 0;
    if (sweep.is_box) set_faces(sweep, scale, lanes);
    else set_diagonals(lanes);
    return lanes;
}

}  // namespace espalier::detail
