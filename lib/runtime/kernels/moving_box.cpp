// The kernel of boxes that move. Widths and roundings: docs/numerics.md.
#include <runtime/base/bits.hpp>
#include <runtime/base/wide_difference.hpp>
#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/point_triangle.hpp>

namespace espalier::detail {

namespace {

/// A share of the way, not negative.
struct Share {
    Int128 numerator;
    Int128 denominator;
    float top, bottom;  ///< both times one power of two, rounded once
};

template <class Number>
ESPALIER_SHARED_CODE Share share(Argument<Number> numerator, Argument<Number> denominator) {
    // Products of two, also of the normal's, which have up to 92 bits, stay within float32.
    constexpr float scale = sizeof(Number) > 8 ? 0x1p-32f : 1.0f;
    return {numerator, denominator, to_float(numerator) * scale, to_float(denominator) * scale};
}
bool is_narrow(Argument<Int128> a) { return a.high == (static_cast<std::int64_t>(a.low) < 0 ? -1 : 0); }
bool is_narrow(const Share& a) { return is_narrow(a.numerator) && is_narrow(a.denominator); }

/// Covers three roundings on each side of a comparison.
constexpr float more = 1.0f + 0x1p-20f;

/// Exactly. Floats tell most often; but equal ones are no exception, as several axes often tell the same.
ESPALIER_SHARED_CODE bool is_less(const Share& a, const Share& b) {
    const float left = a.top * b.bottom, right = b.top * a.bottom;
    if (left * more < right) return true;
    if (right * more < left) return false;
    if (takes_shortcut() && is_narrow(a) && is_narrow(b)) {
        const auto word = [](const Int128& x) { return static_cast<std::int64_t>(x.low); };
        return multiply(word(a.numerator), word(b.denominator)) < multiply(word(b.numerator), word(a.denominator));
    }
    return compare_products(a.numerator, b.denominator, b.numerator, a.denominator) < 0;
}

using Narrow = SufficientNumber<std::int64_t, Int128>;

/// Along an axis: what box and triangle take up, and how far the box moves.
template <class Number>
struct Extents {
    Number box_low, box_high, low, high, way;
};

/// When box and triangle are not separated by any of the axes tried so far.
class Together {
public:
    /// Later than at that tick is never.
    explicit Together(SweepTick most) : most_(most) {}

    /// False when there is no such time.
    template <class Number>
    bool try_axis(unsigned axis, const Extents<Number>& extents) {
        const auto& [box_low, box_high, low, high, way] = extents;
        const bool is_before = box_high < low;
        const bool is_behind = high < box_low;
        const bool is_apart = is_before || is_behind;
        const bool runs_down = is_negative(way);
        if (is_zero(way)) return !is_apart;
        if (is_before ? runs_down : is_behind && !runs_down) return false;
        const Number speed = negate_if(way, runs_down);
        const Number to_enter = runs_down ? box_low - high : low - box_high;
        const Number to_leave = runs_down ? box_high - low : high - box_low;
        bool is_shorter = false;
        if (is_apart) {
            if (speed < to_enter) return false;
            const Share when = share<Number>(to_enter, speed);
            if (is_too_late(when)) return false;
            is_shorter = enter(axis, when);
        }
        if (to_leave < speed)  // else it is together until the end of the way
            is_shorter = leave(share<Number>(to_leave, speed)) || is_shorter;
        return !is_shorter || !has_enter_ || !has_leave_ || !is_less(leave_, enter_);
    }

    [[nodiscard]] unsigned last_axis() const { return last_axis_; }
    /// The first tick at or after the first contact.
    [[nodiscard]] SweepTick tick() const {
        return has_enter_ ? first_tick_from(enter_.numerator, enter_.denominator) : 0;
    }

private:
    /// Whether it is after the last tick that counts.
    [[nodiscard]] bool is_too_late(const Share& when) const {
        const float limit = share_of_way(most_) * when.bottom;
        if (when.top * more < limit) return false;
        return limit * more < when.top || multiply(when.denominator, std::int64_t{most_}) < when.numerator << tick_bits;
    }
    /// Whether this is the last to enter so far.
    bool enter(unsigned axis, const Share& when) {
        if (has_enter_ && !is_less(enter_, when)) return false;
        enter_ = when;
        last_axis_ = axis;
        return has_enter_ = true;
    }
    /// Whether this is the first to leave so far.
    bool leave(const Share& when) {
        if (has_leave_ && !is_less(when, leave_)) return false;
        leave_ = when;
        return has_leave_ = true;
    }

    SweepTick most_;
    bool has_enter_ = false;
    bool has_leave_ = false;
    unsigned last_axis_ = 0;
    Share enter_{};  ///< the last
    Share leave_{};  ///< the first
};

/// 0..2: coordinate axes; 3: the normal; 4..12: each side with each coordinate axis.
Integer3 axis_of(const IntegerTriangle& triangle, unsigned axis) {
    if (axis == 3) return normal_of(triangle);
    const unsigned k = axis < 3 ? axis : (axis - 4) % 3;
    const Integer3 unit = {k == 0 ? 1 : 0, k == 1 ? 1 : 0, k == 2 ? 1 : 0};
    if (axis < 3) return unit;
    const unsigned side = (axis - 4) / 3;
    return cross(unit, triangle.corner[(side + 1) % 3] - triangle.corner[side]);
}

bool try_normal(const MovingBox& box, const IntegerTriangle& triangle, Together& together) {
    const Integer3 axis = normal_of(triangle);
    const auto pick = [&](const Integer3& where_up, const Integer3& where_down) {
        return Integer3{axis.x < 0 ? where_down.x : where_up.x, axis.y < 0 ? where_down.y : where_up.y,
                        axis.z < 0 ? where_down.z : where_up.z};
    };
    const auto level = dot<Int128>(axis, triangle.corner[0]);
    return together.try_axis<Int128>(
        3, {dot<Int128>(axis, pick(box.low, box.high)), dot<Int128>(axis, pick(box.high, box.low)), level, level,
            dot<Int128>(axis, box.displacement)});
}

/// Box and triangle seen along a coordinate axis: a plane, in which a side's product with that axis is across the side.
struct SeenAlong {
    struct Place {
        std::int64_t first, second;
    };
    Place corner[3], low, high, way;

    SeenAlong(const MovingBox& box, const IntegerTriangle& triangle, int k)
        : low(seen(box.low, k)), high(seen(box.high, k)), way(seen(box.displacement, k)) {
        for (int i = 0; i < 3; ++i) corner[i] = seen(triangle.corner[i], k);
    }
    static Place seen(const Integer3& at, int k) {
        return k == 0 ? Place{at.y, at.z} : k == 1 ? Place{at.z, at.x} : Place{at.x, at.y};
    }
};

ESPALIER_SHARED_CODE bool try_side(const SeenAlong& seen, unsigned side, unsigned number, Together& together) {
    const auto& on_side = seen.corner[side];
    const auto& end = seen.corner[side == 2 ? 0 : side + 1];
    const auto& opposite = seen.corner[side == 0 ? 2 : side - 1];
    const std::int64_t first = on_side.second - end.second, second = end.first - on_side.first;
    const auto along = [&](std::int64_t at_first, std::int64_t at_second) {
        return dot<Narrow>(Integer3{first, second, 0}, Integer3{at_first, at_second, 0});
    };
    const auto &low = seen.low, &high = seen.high;
    const bool first_down = first < 0, second_down = second < 0;
    const Narrow one = along(on_side.first, on_side.second), other = along(opposite.first, opposite.second);
    const bool is_up = one < other;
    return together.try_axis<Narrow>(
        number, {along(first_down ? high.first : low.first, second_down ? high.second : low.second),
                 along(first_down ? low.first : high.first, second_down ? low.second : high.second),
                 is_up ? one : other, is_up ? other : one, along(seen.way.first, seen.way.second)});
}

ESPALIER_SHARED_CODE bool try_coordinate_axis(const MovingBox& box, const IntegerTriangle& triangle, int k,
                                              Together& together) {
    const auto [low, high] = span_of(triangle, k);
    const Extents<Narrow> extents = {box.low[k], box.high[k], low, high, box.displacement[k]};
    return together.try_axis(static_cast<unsigned>(k), extents);
}

bool try_axes(const MovingBox& box, const IntegerTriangle& triangle, Together& together) {
    for (int k = 0; k < 3; ++k)
        if (!try_coordinate_axis(box, triangle, k, together)) return false;
    if (!try_normal(box, triangle, together)) return false;
    const SeenAlong seen[3] = {{box, triangle, 0}, {box, triangle, 1}, {box, triangle, 2}};
    for (unsigned number = 4; number < 13; ++number)
        if (!try_side(seen[(number - 4) % 3], (number - 4) / 3, number, together)) return false;
    return true;
}

/// The part of the triangle that lies in a box, as a polygon of weights, cut down side by side (Sutherland and Hodgman
/// 1974).
class Clipped {
public:
    /// Keeps where the function that is so large at the corners is not negative.
    void keep_positive(const float* at_corner) {
        const auto at = [&](const Weights& w) {
            return at_corner[0] + (w.u * (at_corner[1] - at_corner[0]) + w.v * (at_corner[2] - at_corner[0]));
        };
        Weights kept[capacity];
        unsigned count = 0;
        for (unsigned i = 0; i < count_; ++i) {
            const Weights& from = corners_[i];
            const Weights& to = corners_[i + 1 < count_ ? i + 1 : 0];
            const float here = at(from);
            const float there = at(to);
            if (here >= 0.0f && count < capacity) kept[count++] = from;
            if ((here < 0.0f) == (there < 0.0f) || count == capacity) continue;
            const float along = here / (here - there);
            kept[count++] = {from.u + along * (to.u - from.u), from.v + along * (to.v - from.v)};
        }
        if (count == 0) return;  // by rounding alone: what touches is not cut away
        count_ = count;
        for (unsigned i = 0; i < count; ++i) corners_[i] = kept[i];
    }
    [[nodiscard]] Weights middle() const {
        Weights sum;
        for (unsigned i = 0; i < count_; ++i) {
            sum.u += corners_[i].u;
            sum.v += corners_[i].v;
        }
        const auto count = static_cast<float>(count_);
        return {flush_subnormal(sum.u / count), flush_subnormal(sum.v / count)};
    }

private:
    static constexpr unsigned capacity = 9;  // each of six planes cuts one corner more
    Weights corners_[capacity] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}};
    unsigned count_ = 3;
};

/// Returns what of the triangle is least far along an axis.
Feature nearest_feature(const IntegerTriangle& triangle, const Integer3& axis) {
    const Int128 at[3] = {dot<Int128>(axis, triangle.corner[0]), dot<Int128>(axis, triangle.corner[1]),
                          dot<Int128>(axis, triangle.corner[2])};
    unsigned nearest = 0;
    for (unsigned i = 0; i < 3; ++i)
        nearest |= at[i == 2 ? 0 : i + 1] < at[i] || at[i == 0 ? 2 : i - 1] < at[i] ? 0 : 1u << i;
    return feature_of_corners(nearest);
}

Weights middle_of_overlap(const MovingBox& box, const IntegerTriangle& triangle, std::int64_t tick) {
    Clipped clipped;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t way = box.displacement[k];
        float above_low[3], below_high[3];
        float largest = 0.0f;
        for (unsigned i = 0; i < 3; ++i) {
            const std::int64_t at = (triangle.corner[i][k] << tick_bits) - way * tick;
            above_low[i] = to_float(at - (box.low[k] << tick_bits));
            below_high[i] = to_float((box.high[k] << tick_bits) - at);
            largest = maximum(maximum(absolute(above_low[i]), absolute(below_high[i])), largest);
        }
        const float slack = to_float(magnitude(way)) + largest * 0x1p-20f;
        for (unsigned i = 0; i < 3; ++i) {
            above_low[i] += slack;
            below_high[i] += slack;
        }
        clipped.keep_positive(above_low);
        clipped.keep_positive(below_high);
    }
    return clipped.middle();
}

}  // namespace

SweepTick first_contact_tick(const MovingBox& box, const IntegerTriangle& triangle, SweepTick most) noexcept {
    Together together(most);
    if (!try_axes(box, triangle, together)) return no_contact;
    const SweepTick tick = together.tick();
    return tick <= most ? tick : no_contact;
}

SweepContact contact_at(const MovingBox& box, const IntegerTriangle& triangle, SweepTick tick) noexcept {
    Together together(tick);
    (void)try_axes(box, triangle, together);
    const Integer3 axis = axis_of(triangle, together.last_axis());
    const bool runs_down = dot<Int128>(axis, box.displacement).is_negative();
    return {middle_of_overlap(box, triangle, tick_before(tick)), to_unit(axis, runs_down ? 0x1p-30f : -0x1p-30f),
            nearest_feature(triangle, runs_down ? -axis : axis)};
}

}  // namespace espalier::detail
