// Lower bounds of times, in lanes, for a point that moves along a straight line: when it enters an interval of a linear
// function, or a ball or cylinder. Times are shares of the way. Bounds are never late: each is rounded downward by more
// than its arithmetic rounds (docs/numerics.md, Sweeps).
#ifndef ESPALIER_SWEEPS_TIME_BOUNDS_HPP
#define ESPALIER_SWEEPS_TIME_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/point_bounds.hpp>

ESPALIER_BEGIN_SET

inline Floats3 splat_each(const float* a) { return {splat(a[0]), splat(a[1]), splat(a[2])}; }
inline Floats3 negate(const Floats3& a) { return {negate(a.x), negate(a.y), negate(a.z)}; }
inline Floats3 cross(const Floats3& a, const Floats3& b) {
    return {multiply_subtract(a.y, b.z, multiply(a.z, b.y)), multiply_subtract(a.z, b.x, multiply(a.x, b.z)),
            multiply_subtract(a.x, b.y, multiply(a.y, b.x))};
}
inline Floats absolute_of(Floats a) { return larger(a, negate(a)); }
/// The sum of the absolute coordinates: at least the length.
inline Floats length_bound(const Floats3& a) { return add(absolute_of(a.x), add(absolute_of(a.y), absolute_of(a.z))); }
inline Floats largest_of(Floats a, Floats b, Floats c) { return larger(larger(a, b), c); }

namespace time_bounds {

/// Sixteen roundings of a float.
inline constexpr float rounding = 0x1p-20f;
/// A time that stands for never.
inline constexpr float never = 0x1p60f;

inline Floats where_positive(Floats a, Floats then, Floats otherwise) {
    return where_at_most(a, splat(0.0f), otherwise, then);
}
/// Returns when something that is `gap` away, and comes nearer by `speed` on the whole way, is there.
inline Floats arrival(Floats gap, Floats speed) {
    const Floats when = where_positive(speed, divide(gap, larger(speed, splat(0x1p-100f))), splat(never));
    return where_positive(gap, when, splat(0.0f));
}

/// An interval of a linear function of the moving point: the function begins at `from` and changes by `change` on the
/// whole way. `error` bounds the roundings of both, and of the interval's ends.
struct Interval {
    Floats from, change, low, high, error;

    /// Returns a time that is not after the one at which the function enters the interval.
    [[nodiscard]] Floats entry() const {
        const Floats below = subtract(subtract(low, from), error), above = subtract(subtract(from, high), error);
        // At most one of them is positive.
        return arrival(larger(below, above), add(where_at_most(above, below, change, negate(change)), error));
    }
    /// Returns a time that is not before the one at which the function leaves the interval.
    [[nodiscard]] Floats exit() const {
        const Floats down = subtract(from, low), up = subtract(high, from);
        const Floats room = add(where_at_most(splat(0.0f), change, up, down), multiply(error, splat(2.0f)));
        const Floats speed = subtract(absolute_of(change), error);
        const Floats when = multiply(divide(room, larger(speed, splat(0x1p-100f))), splat(1.0f + rounding));
        return where_positive(speed, where_positive(room, when, splat(0.0f)), splat(never));
    }
    /// Returns `never` where the function has left the interval by then, and 0 elsewhere. The time is a bound of one at
    /// which it is in the interval, if it ever is.
    [[nodiscard]] Floats is_left_at(Floats when) const {
        const Floats at = multiply_add(change, when, from);
        const Floats outside = subtract(larger(subtract(low, at), subtract(at, high)), multiply(error, splat(4.0f)));
        return where_positive(outside, splat(never), splat(0.0f));
    }
};

/// Returns the smaller t of a t^2 - 2 b t + c = 0, where something that begins outside comes in; 0 where it begins
/// inside (c <= 0), and `never` where it does not come in. a and c are not above the real ones, b is not below.
inline Floats root(Floats a, Floats b, Floats c) {
    const Floats discriminant = multiply_subtract(multiply(b, splat(1.0f + 0x1p-19f)), b, multiply(a, c));
    const Floats when = divide(c, add(larger(b, splat(0x1p-100f)), square_roots(larger(discriminant, splat(0.0f)))));
    const Floats comes = where_at_most(splat(0.0f), discriminant, when, splat(never));
    return where_positive(c, where_positive(b, comes, splat(never)), splat(0.0f));
}

}  // namespace time_bounds

ESPALIER_END_SET

#endif
