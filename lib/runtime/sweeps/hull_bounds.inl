// Lower bounds of the time at which a moving convex hull first touches triangles, in lanes: none of a few axes
// separates the two at that time. The axes are the triangle's normal and what is across its sides and the way.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/sweeps/shapes_in_lanes.hpp>
#include <runtime/sweeps/time_bounds.inl>
#endif

/// The hull has gone `begin` of its way before, without touching any of the triangles.
class HullBounds {
public:
    explicit HullBounds(const HullInLanes& hull) : hull_(hull), way_(splat_each(hull.way)) {
        const Floats3 low = splat_each(hull.low), high = splat_each(hull.high);
        way_length_ = length_bound(way_);
        size_ = add(way_length_, larger(length_bound(low), length_bound(high)));
    }

    /// Returns a bound for each triangle, whose three corners are seen from the middle of the box around the hull.
    [[nodiscard, gnu::noinline]] Floats operator()(const Floats3* corners) const {
        const Floats3 &a = corners[0], &b = corners[1], &c = corners[2];
        const Floats3 sides[3] = {subtract(b, a), subtract(c, b), subtract(a, c)};
        const Floats reach = largest_of(length_bound(a), length_bound(b), length_bound(c));
        const Floats far = multiply(add(reach, size_), splat(time_bounds::rounding));
        Floats enter = splat(0.0f), leave = splat(time_bounds::never);
        const auto narrow = [&](const Floats3& axis, const Floats3& one, const Floats3& other, Floats error) {
            const Extent hull = extent_along(axis);
            const Floats at_one = dot(axis, one), at_other = dot(axis, other);
            const time_bounds::Interval interval = {splat(0.0f), dot(axis, way_),
                                                    subtract(smaller(at_one, at_other), hull.high),
                                                    subtract(larger(at_one, at_other), hull.low), error};
            enter = larger(enter, interval.entry());
            leave = smaller(leave, interval.exit());
        };
        const Floats product = multiply(length_bound(sides[0]), length_bound(sides[1]));
        narrow(cross(sides[0], sides[1]), a, a, multiply(product, far));
        for (int i = 0; i < 3; ++i) {
            const Floats error = multiply(multiply(length_bound(sides[i]), way_length_), far);
            narrow(cross(sides[i], way_), corners[i], corners[i == 0 ? 2 : i - 1], error);
        }
        return where_at_most(enter, leave, enter, splat(time_bounds::never));
    }

private:
    struct Extent {
        Floats low, high;
    };
    /// Grown by what floats may move hull and triangles.
    [[nodiscard]] Extent extent_along(const Floats3& axis) const {
        Floats low = dot(axis, splat_each(hull_.point[0])), high = low;
        for (unsigned i = 1; i < hull_.point_count; ++i) {
            const Floats at = dot(axis, splat_each(hull_.point[i]));
            low = smaller(low, at);
            high = larger(high, at);
        }
        const Floats slack = multiply(length_bound(axis), splat(lane_slack));
        return {subtract(low, slack), add(high, slack)};
    }

    const HullInLanes& hull_;
    Floats3 way_;
    Floats way_length_, size_;
};
