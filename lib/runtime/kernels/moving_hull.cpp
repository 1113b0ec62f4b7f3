// The kernel of convex hulls that move. Widths and proofs: docs/numerics.md.
#include <runtime/base/bits.hpp>
#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/point_triangle.hpp>

namespace espalier::detail {

namespace {

/// A point of the triangle seen from a point of the hull.
struct PointDifference {
    Integer3 at;
    std::uint32_t number;  ///< 64 for each corner, and that of the hull's point
};
/// Stands beside the line where all differences lie in one plane with it. Its weight is 0.
constexpr std::uint32_t auxiliary = 4 * max_hull_vertices;

Int128 triple_product(const Integer3& a, const Integer3& b, const Integer3& c) { return dot<Int128>(cross(a, b), c); }

/// How far the nearest corner is along an axis.
Int128 lowest_along(const Integer3& axis, const IntegerTriangle& triangle) {
    const Integer3(&c)[3] = triangle.corner;
    return span_of(dot<Int128>(axis, c[0]), dot<Int128>(axis, c[1]), dot<Int128>(axis, c[2])).low;
}

Integer3 unit_axis(int k, bool is_down) {
    Integer3 unit = {0, 0, 0};
    unit[k] = is_down ? -1 : 1;
    return unit;
}

/// The differences of all points of triangle and hull. Each is a difference of two points that are chosen separately.
class PointDifferences {
public:
    PointDifferences(const MovingHull& hull, const IntegerTriangle& triangle) : hull_(hull), triangle_(triangle) {}
    [[nodiscard]] const IntegerTriangle& triangle() const { return triangle_; }

    /// Returns the one that is least far along an axis, the first of several.
    [[nodiscard]] PointDifference lowest(const Integer3& axis) const {
        unsigned corner = 0, point = 0;
        Int128 least = dot<Int128>(axis, triangle_.corner[0]), most = dot<Int128>(axis, point_at(0));
        for (unsigned i = 1; i < 3; ++i) {
            const Int128 at = dot<Int128>(axis, triangle_.corner[i]);
            if (!(at < least)) continue;
            least = at;
            corner = i;
        }
        for (unsigned i = 1; i < hull_.point_count; ++i) {
            const Int128 at = dot<Int128>(axis, point_at(i));
            if (!(most < at)) continue;
            most = at;
            point = i;
        }
        return difference(corner, point);
    }
    /// Returns the one that is least far along an axis; of several, the one least far along the other.
    [[nodiscard]] PointDifference lowest(const Integer3& axis, const Integer3& other) const {
        const PointDifference some = lowest(axis);
        const Int128 level = dot<Int128>(axis, some.at);
        PointDifference best = some;
        for_each([&](const PointDifference& next) {
            if (dot<Int128>(axis, next.at) == level && dot<Int128>(other, next.at) < dot<Int128>(other, best.at))
                best = next;
            return false;
        });
        return best;
    }
    /// Stores the first one that is below a level along an axis. Whether there is one.
    [[nodiscard]] bool first_below(const Integer3& axis, const Int128& level, PointDifference& found) const {
        return for_each([&](const PointDifference& next) {
            found = next;
            return dot<Int128>(axis, next.at) < level;
        });
    }

private:
    [[nodiscard]] Integer3 point_at(unsigned i) const {
        const std::int32_t* at = hull_.point[i];
        return {at[0], at[1], at[2]};
    }
    [[nodiscard]] PointDifference difference(unsigned corner, unsigned point) const {
        return {triangle_.corner[corner] - point_at(point),
                corner * static_cast<std::uint32_t>(max_hull_vertices) + point};
    }
    /// Calls the function until it returns true.
    template <class Function>
    bool for_each(Function function) const {
        for (unsigned corner = 0; corner < 3; ++corner)
            for (unsigned point = 0; point < hull_.point_count; ++point)
                if (function(difference(corner, point))) return true;
        return false;
    }

    const MovingHull& hull_;
    const IntegerTriangle& triangle_;
};

/// Three differences around the line, or on it: seen along the line they go round it counterclockwise, and the line
/// passes through their triangle.
class Portal {
public:
    Portal(const MovingHull& hull, const IntegerTriangle& triangle)
        : differences_(hull, triangle), way_(hull.displacement) {
        if (is_zero(way_)) way_ = unit_axis(0, false);  // any line through the start
    }

    /// False when the line passes all differences by.
    [[nodiscard]] bool open() {
        // The line's own axis is not used: the other two are not along it.
        const int k = longest_axis(way_);
        PointDifference first;
        const Side side = beside(k, first);
        if (side == Side::apart) return false;
        if (side == Side::along) {
            const Integer3 one = unit_axis(k == 2 ? 0 : k + 1, false);
            const Integer3 other = unit_axis(k == 0 ? 2 : k - 1, way_[k] < 0);
            set(first, {first.at + one, auxiliary}, {first.at + other, auxiliary});
            return true;
        }
        // Goes round the line to the left.
        PointDifference last = first;
        bool is_first = true;
        for (;;) {
            const Integer3 right = cross(last.at, way_);
            const PointDifference next = differences_.lowest(right);
            if (!dot<Int128>(right, next.at).is_negative()) return open_at_border(last, right);
            if (!is_first && Int128(0) < triple_product(way_, next.at, first.at)) {
                set(first, last, next);
                return true;
            }
            last = next;
            is_first = false;
        }
    }

    enum class End { first, too_late, at_start, before_start };

    /// Exchanges differences until no other one is earlier: then the plane of the three separates hull and triangle.
    /// Ends before that when the time is surely after the tick, or not after the start.
    [[nodiscard]] End advance(SweepTick most) {
        for (unsigned count = 0;; ++count) {
            find_plane();
            if (!(Int128(0) < level_)) return level_.is_zero() ? End::at_start : End::before_start;
            PointDifference next;
            if (count < most_exchanges_by_depth) {
                next = differences_.lowest(normal_);
                bound_ = dot<Int128>(normal_, next.at);
                if (is_too_late(most)) return End::too_late;
                if (!(bound_ < level_)) return End::first;
            } else if (!differences_.first_below(normal_, level_, next)) {
                // Taking the first ends in any case (Bland 1977).
                bound_ = level_;
                return is_too_late(most) ? End::too_late : End::first;
            }
            exchange(next);
        }
    }
    /// Turns the line round.
    void reverse() {
        way_ = -way_;
        const PointDifference second = corner_[1];
        corner_[1] = corner_[2];
        corner_[2] = second;
    }

    /// The first tick at or after the one at which the line meets the plane, which is on the way.
    [[nodiscard]] SweepTick tick() const { return first_tick_from(level_, speed_); }
    /// The normal along which nothing is earlier than the contact, or than the tick.
    [[nodiscard]] PlaneAhead plane() const {
        return {normal_, lowest_along(normal_, differences_.triangle()) - bound_, speed_};
    }
    /// Whether the hull reaches the triangle's own plane at the time of the contact, exactly, and so not before.
    [[nodiscard]] bool is_reached_with(const PlaneAhead& face, const IntegerTriangle& triangle) const {
        const Int128 gap = dot<Int128>(face.normal, triangle.corner[0]) - face.hull_end;
        if (!(Int128(0) < gap) || !(Int128(0) < level_)) return false;
        return compare_scaled(Unsigned256::product(gap, speed_), Unsigned256::product(level_, face.speed), 0) == 0;
    }
    [[nodiscard]] SweepContact contact() const {
        Int128 weight[3] = {0, 0, 0};
        for (unsigned i = 0; i < 3; ++i) {
            const std::uint32_t number = corner_[i].number;
            if (number != auxiliary) weight[number / max_hull_vertices] += weight_of(i);
        }
        const float whole = to_float(speed_);
        return {{flush_subnormal(to_float(weight[1]) / whole), flush_subnormal(to_float(weight[2]) / whole)},
                to_unit(separating_normal(), -0x1p-30f),
                feature_of(weight[0].is_zero(), weight[1].is_zero(), weight[2].is_zero())};
    }

private:
    static constexpr unsigned most_exchanges_by_depth = 16;

    enum class Side { apart, along, beside };

    void set(const PointDifference& a, const PointDifference& b, const PointDifference& c) {
        corner_[0] = a;
        corner_[1] = b;
        corner_[2] = c;
    }
    /// Stores a difference that is not on the line, or any if all are. May see that all are on one side.
    [[nodiscard]] Side beside(int k, PointDifference& found) const {
        for (unsigned i = 0; i < 4; ++i) {
            const int other = (i & 1u) == 0 ? (k == 2 ? 0 : k + 1) : (k == 0 ? 2 : k - 1);
            const Integer3 axis = cross(way_, unit_axis(other, i >= 2));
            found = differences_.lowest(axis);
            const int where = sign(dot<Int128>(axis, found.at));
            if (where > 0) return Side::apart;
            if (where < 0) return Side::beside;
        }
        return Side::along;
    }
    /// For differences of which none is to the left of the last one: those in one plane with it and the line decide.
    [[nodiscard]] bool open_at_border(const PointDifference& last, const Integer3& right) {
        // Across the line, and along the border.
        const int k = longest_axis(right);
        const Integer3 unit = unit_axis(k, right[k] < 0);
        const Integer3 along = cross(way_, unit);
        const PointDifference other = differences_.lowest(right, along);
        if (Int128(0) < dot<Int128>(along, other.at)) return false;
        const PointDifference beyond = differences_.lowest(-right);
        const bool is_flat = dot<Int128>(right, beyond.at).is_zero();
        set(last, other, is_flat ? PointDifference{other.at + unit, auxiliary} : beyond);
        return true;
    }

    void find_plane() {
        normal_ = cross(corner_[1].at - corner_[0].at, corner_[2].at - corner_[0].at);
        level_ = dot<Int128>(normal_, corner_[0].at);
        speed_ = dot<Int128>(normal_, way_);
    }
    [[nodiscard]] bool is_too_late(SweepTick most) const {
        return multiply(speed_, std::int64_t{most}) < bound_ << tick_bits;
    }
    /// Returns the barycentric weight of a corner, times speed_, where the line meets the plane.
    [[nodiscard]] Int128 weight_of(unsigned i) const {
        return triple_product(way_, corner_[i == 2 ? 0 : i + 1].at, corner_[i == 0 ? 2 : i - 1].at);
    }
    /// Returns the normal of the plane, or, if all differences lie in one plane with the line, of a plane across that
    /// one.
    [[nodiscard]] Integer3 separating_normal() const {
        Integer3 side = {0, 0, 0};
        unsigned flat = 0;
        for (unsigned i = 0; i < 3; ++i) {
            if (corner_[i].number != auxiliary) continue;
            side = corner_[i == 0 ? 2 : i - 1].at - corner_[i == 2 ? 0 : i + 1].at;
            ++flat;
        }
        if (flat == 0) return normal_;
        if (flat == 2) {
            const int k = longest_axis(way_);
            return unit_axis(k, way_[k] < 0);
        }
        const Integer3 across = cross(way_, side);
        const int k = longest_axis(across);
        return cross(side, unit_axis(k, across[k] < 0));
    }
    /// Takes in another difference for the one that leaves the line inside: of several the one with the lowest number.
    void exchange(const PointDifference& next) {
        const Integer3 across = cross(way_, next.at);
        int side[3];
        for (unsigned i = 0; i < 3; ++i) side[i] = sign(dot<Int128>(across, corner_[i].at));
        unsigned out = 3;
        for (unsigned i = 0; i < 3; ++i) {
            const int after = side[i == 2 ? 0 : i + 1], before = side[i == 0 ? 2 : i - 1];
            if (after < 0 || before > 0) continue;
            if (after == 0 && before == 0 && weight_of(i).is_zero()) continue;  // no triangle would be left
            if (out == 3 || corner_[i].number < corner_[out].number) out = i;
        }
        corner_[out] = next;
    }

    PointDifferences differences_;
    Integer3 way_;
    PointDifference corner_[3]{};
    Integer3 normal_{};
    Int128 level_ = 0;  ///< of the plane along the normal: that of the line grows by speed_ on the whole way
    Int128 speed_ = 0;  ///< above 0
    Int128 bound_ = 0;  ///< the level of the difference that is least far along the normal
};

/// Whether the hull reaches the triangle along the plane's normal after that tick.
bool is_late_for(const PlaneAhead& plane, const IntegerTriangle& triangle, SweepTick most) {
    if (plane.speed.is_zero()) return false;
    const Int128 gap = lowest_along(plane.normal, triangle) - plane.hull_end;
    return multiply(plane.speed, std::int64_t{most}) < gap << tick_bits;
}

/// Returns the triangle's plane, its normal along the way.
PlaneAhead plane_of(const MovingHull& hull, const IntegerTriangle& triangle) {
    PlaneAhead plane;
    plane.normal = normal_of(triangle);
    plane.speed = dot<Int128>(plane.normal, hull.displacement);
    if (plane.speed.is_negative()) {
        plane.normal = -plane.normal;
        plane.speed = -plane.speed;
    }
    for (unsigned i = 0; i < hull.point_count; ++i) {
        const Integer3 point = {hull.point[i][0], hull.point[i][1], hull.point[i][2]};
        const Int128 end = dot<Int128>(plane.normal, point);
        if (i == 0 || plane.hull_end < end) plane.hull_end = end;
    }
    return plane;
}

}  // namespace

SweepTick first_contact_tick(const MovingHull& hull, const IntegerTriangle& triangle, SweepTick most,
                             PlaneAhead& plane) noexcept {
    if (takes_shortcut() && is_late_for(plane, triangle, most)) return no_contact;
    Portal portal(hull, triangle);
    if (!portal.open()) return no_contact;
    switch (portal.advance(is_zero(hull.displacement) ? 0 : most)) {
        case Portal::End::first:
            plane = portal.plane();
            return portal.tick();
        case Portal::End::too_late:
            plane = portal.plane();
            return no_contact;
        case Portal::End::at_start:
            return 0;
        default:
            // The line meets the differences before the start. Whether it leaves them after the start.
            portal.reverse();
            return portal.advance(0) == Portal::End::too_late ? no_contact : 0;
    }
}

SweepContact contact_at(const MovingHull& hull, const IntegerTriangle& triangle, SweepTick tick) noexcept {
    Portal portal(hull, triangle);
    (void)portal.open();
    (void)portal.advance(tick);
    SweepContact contact = portal.contact();
    // Where a corner of the hull meets a side, many planes separate: the triangle's is preferred.
    const PlaneAhead face = plane_of(hull, triangle);
    if (portal.is_reached_with(face, triangle)) contact.normal = to_unit(face.normal, -0x1p-30f);
    return contact;
}

}  // namespace espalier::detail
