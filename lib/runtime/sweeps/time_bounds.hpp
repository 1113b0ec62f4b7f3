// Lower bounds of times, in lanes, for a point that moves along a straight line: when it enters an interval of a linear
// function, or a ball or cylinder. Times are shares of the way. Bounds are never late: each is rounded downward by more
// than its arithmetic rounds (docs/numerics.md, Sweeps).
#ifndef ESPALIER_SWEEPS_TIME_BOUNDS_HPP
#define ESPALIER_SWEEPS_TIME_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/proximity/point_bounds.hpp>

ESPALIER_BEGIN_SET

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
        const Floats speed = subtract(magnitude(change), error);
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

/// When none of some axes separates a moving shape and triangles: their ends along each are linear functions.
class CommonTime {
public:
    // An initializer of a member would be compiled without the instruction set.
    CommonTime() : enter_(splat(0.0f)), leave_(splat(never)) {}

    ESPALIER_ALWAYS_INLINE void narrow(const Interval& interval) {
        enter_ = larger(enter_, interval.entry());
        leave_ = smaller(leave_, interval.exit());
    }
    [[nodiscard]] Floats first() const { return where_at_most(enter_, leave_, enter_, splat(never)); }

private:
    Floats enter_, leave_;
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
