// Lower bounds of the time at which a moving box first touches triangles, in lanes: none of the separating axes (Eberly
// 2001) separates the two at that time. The axes of the box itself are those of swept_box.hpp.
#ifndef ESPALIER_SWEEPS_BOX_BOUNDS_HPP
#define ESPALIER_SWEEPS_BOX_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/beside_way.hpp>
#include <runtime/sweeps/shapes_in_lanes.hpp>
#include <runtime/sweeps/time_bounds.hpp>

ESPALIER_BEGIN_SET

/// The box has gone `begin` of its way before, without touching any of the triangles.
class BoxBounds {
public:
    using Beside = AnyPlace;

    explicit BoxBounds(const BoxInLanes& box)
        : way_(splat_each(box.way)), half_(splat_each(box.half)), size_(add(length_bound(way_), length_bound(half_))) {}

    /// Returns a bound for each triangle, whose three corners are seen from the middle of the box.
    [[nodiscard]] ESPALIER_NOINLINE Floats operator()(const Floats3* corners) const {
        const Floats3 &a = corners[0], &b = corners[1], &c = corners[2];
        const Floats3 sides[3] = {subtract(b, a), subtract(c, b), subtract(a, c)};
        const Floats reach = largest_of(length_bound(a), length_bound(b), length_bound(c));
        const Floats far = multiply(add(reach, size_), splat(time_bounds::rounding));
        CommonTime common;
        const Floats product = multiply(length_bound(sides[0]), length_bound(sides[1]));
        common.narrow(*this, cross(sides[0], sides[1]), a, a, multiply(product, far));
        for (int i = 0; i < 3; ++i) {
            const Floats3& side = sides[i];
            const Floats3 &on_side = corners[i], &opposite = corners[i == 0 ? 2 : i - 1];
            const Floats error = multiply(length_bound(side), far), zero = splat(0.0f);
            common.narrow(*this, {zero, negate(side.z), side.y}, on_side, opposite, error);
            common.narrow(*this, {side.z, zero, negate(side.x)}, on_side, opposite, error);
            common.narrow(*this, {negate(side.y), side.x, zero}, on_side, opposite, error);
        }
        return common.first();
    }

private:
    /// When no axis separates box and triangle.
    class CommonTime {
    public:
        // An initializer of a member would be compiled without the instruction set.
        CommonTime() : enter_(splat(0.0f)), leave_(splat(time_bounds::never)) {}

        /// The triangle lies between two of its corners along the axis.
        ESPALIER_ALWAYS_INLINE void narrow(const BoxBounds& box, const Floats3& axis, const Floats3& one,
                                           const Floats3& other, Floats error) {
            const Floats reach = dot({absolute_of(axis.x), absolute_of(axis.y), absolute_of(axis.z)}, box.half_);
            const Floats at_one = dot(axis, one), at_other = dot(axis, other);
            const time_bounds::Interval interval = {splat(0.0f), dot(axis, box.way_),
                                                    subtract(smaller(at_one, at_other), reach),
                                                    add(larger(at_one, at_other), reach), error};
            enter_ = larger(enter_, interval.entry());
            leave_ = smaller(leave_, interval.exit());
        }
        [[nodiscard]] Floats first() const { return where_at_most(enter_, leave_, enter_, splat(time_bounds::never)); }

    private:
        Floats enter_;
        Floats leave_;
    };

    Floats3 way_, half_;
    Floats size_;
};

ESPALIER_END_SET

#endif
