// Lower bounds of the time at which a moving box or convex hull first touches triangles, in lanes: none of some axes
// separates the two at that time (Eberly 2001).
#ifndef ESPALIER_SWEEPS_HULL_BOUNDS_HPP
#define ESPALIER_SWEEPS_HULL_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/leaf_bounds.hpp>

ESPALIER_BEGIN_SET

/// Lower bounds of the time at which a box touches the triangles of a leaf, by all axes that may separate them but
/// those of the box itself, which SweptBox compares.
class BoxBounds {
public:
    using Beside = AnyPlace;
    static int few(const FloatSweep&) { return 1; }

    explicit BoxBounds(const FloatBox& box)
        : way_(splat_each(box.way)), half_(splat_each(box.half)), size_(add(length_bound(way_), length_bound(half_))) {}

    /// Returns a bound for each triangle, whose three corners are seen from the middle of the box.
    [[nodiscard]] ESPALIER_NOINLINE Floats operator()(const Floats3* corners) const {
        const Floats3 &a = corners[0], &b = corners[1], &c = corners[2];
        const Floats3 sides[3] = {subtract(b, a), subtract(c, b), subtract(a, c)};
        const Floats reach = largest_of(length_bound(a), length_bound(b), length_bound(c));
        const Floats far = multiply(add(reach, size_), splat(time_bounds::rounding));
        time_bounds::CommonTime common;
        const Floats product = multiply(length_bound(sides[0]), length_bound(sides[1]));
        narrow(common, cross(sides[0], sides[1]), a, a, multiply(product, far));
        for (int i = 0; i < 3; ++i) {
            const Floats3& side = sides[i];
            const Floats3 &on_side = corners[i], &opposite = corners[i == 0 ? 2 : i - 1];
            const Floats error = multiply(length_bound(side), far), zero = splat(0.0f);
            narrow(common, {zero, negate(side.z), side.y}, on_side, opposite, error);
            narrow(common, {side.z, zero, negate(side.x)}, on_side, opposite, error);
            narrow(common, {negate(side.y), side.x, zero}, on_side, opposite, error);
        }
        return common.first();
    }

private:
    /// The triangle lies between two of its corners along the axis.
    ESPALIER_ALWAYS_INLINE void narrow(time_bounds::CommonTime& common, const Floats3& axis, const Floats3& one,
                                       const Floats3& other, Floats error) const {
        const Floats reach = dot({magnitude(axis.x), magnitude(axis.y), magnitude(axis.z)}, half_);
        const Floats at_one = dot(axis, one), at_other = dot(axis, other);
        common.narrow({splat(0.0f), dot(axis, way_), subtract(smaller(at_one, at_other), reach),
                       add(larger(at_one, at_other), reach), error});
    }

    Floats3 way_, half_;
    Floats size_;
};

/// Lower bounds of the time at which a hull touches the triangles of a leaf, by the triangle's normal, axes along which
/// the extent of the hull is known, and the cross products of the triangle's sides with the edges of an oriented box or
/// the displacement of another hull.
class HullBounds {
public:
    using Beside = AnyPlace;
    static int few(const FloatSweep&) { return 1; }

    explicit HullBounds(const FloatHull& hull) : hull_(hull), way_(splat_each(hull.way)) {
        size_ =
            add(length_bound(way_), larger(length_bound(splat_each(hull.low)), length_bound(splat_each(hull.high))));
    }

    /// Returns a bound for each triangle, whose three corners are seen from the middle of the box around the hull.
    [[nodiscard]] ESPALIER_NOINLINE Floats operator()(const Floats3* corners) const {
        const Floats3 &a = corners[0], &b = corners[1], &c = corners[2];
        const Floats3 sides[3] = {subtract(b, a), subtract(c, b), subtract(a, c)};
        const Floats reach = largest_of(length_bound(a), length_bound(b), length_bound(c));
        const Floats far = multiply(add(reach, size_), splat(time_bounds::rounding));
        time_bounds::CommonTime common;
        for (unsigned i = 0; i < hull_.axis_count; ++i) {
            const FloatHull::Axis& axis = hull_.axis[i];
            const Floats3 along = splat_each(axis.along);
            const Floats at[3] = {dot(along, a), dot(along, b), dot(along, c)};
            narrow(common, dot(along, way_), {splat(axis.low), splat(axis.high)},
                   {smaller(at[0], smaller(at[1], at[2])), largest_of(at[0], at[1], at[2])},
                   multiply(length_bound(along), far));
        }
        const Floats product = multiply(length_bound(sides[0]), length_bound(sides[1]));
        narrow(common, cross(sides[0], sides[1]), a, a, multiply(product, far));
        for (int i = 0; i < 3; ++i) {
            const Floats3 &on_side = corners[i], &opposite = corners[i == 0 ? 2 : i - 1];
            const auto across = [&](const Floats3& edge) {
                const Floats error = multiply(multiply(length_bound(sides[i]), length_bound(edge)), far);
                narrow(common, cross(sides[i], edge), on_side, opposite, error);
            };
            for (unsigned edge = 0; edge < hull_.edge_count; ++edge) across(splat_each(hull_.half_edge[edge]));
            if (hull_.edge_count == 0) across(way_);
        }
        return common.first();
    }

private:
    struct Ends {
        Floats low, high;
    };
    ESPALIER_ALWAYS_INLINE static void narrow(time_bounds::CommonTime& common, Floats way, const Ends& hull,
                                              const Ends& triangle, Floats error) {
        common.narrow({splat(0.0f), way, subtract(triangle.low, hull.high), subtract(triangle.high, hull.low), error});
    }
    /// The triangle lies between two of its corners along the axis.
    ESPALIER_ALWAYS_INLINE void narrow(time_bounds::CommonTime& common, const Floats3& axis, const Floats3& one,
                                       const Floats3& other, Floats error) const {
        const Floats at_one = dot(axis, one), at_other = dot(axis, other);
        narrow(common, dot(axis, way_), ends_along(axis), {smaller(at_one, at_other), larger(at_one, at_other)}, error);
    }
    /// Grown by what floats may move hull and triangles.
    [[nodiscard]] Ends ends_along(const Floats3& axis) const {
        const Floats slack = multiply(length_bound(axis), splat(float_slack));
        if (hull_.edge_count != 0) {
            Floats reach = slack;
            for (unsigned i = 0; i < 3; ++i) reach = add(reach, magnitude(dot(axis, splat_each(hull_.half_edge[i]))));
            return {negate(reach), reach};
        }
        Floats low = dot(axis, splat_each(hull_.point[0])), high = low;
        for (unsigned i = 1; i < hull_.point_count; ++i) {
            const Floats at = dot(axis, splat_each(hull_.point[i]));
            low = smaller(low, at);
            high = larger(high, at);
        }
        return {subtract(low, slack), add(high, slack)};
    }

    const FloatHull& hull_;
    Floats3 way_;
    Floats size_;
};

ESPALIER_END_SET

#endif
