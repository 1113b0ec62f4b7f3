// Where two triangles touch. The corners of what they have in common are corners of one in the other, crossings of two
// sides, and sides that pierce a face: each is decided in integers, and is found once.
#include <runtime/contacts/nearest_pair.hpp>

namespace espalier::detail::contacts {

namespace {

/// The corners of a triangle without those that lie between others: three, or the ends of a segment, or a point.
struct Outline {
    Integer3 corner[3];
    unsigned count;
    Integer3 normal;  ///< zero without area

    explicit Outline(const LatticeTriangle& triangle) {
        const IntegerTriangle t = integer_triangle(triangle);
        normal = normal_of(t);
        count = 3;
        for (unsigned i = 0; i < 3; ++i) corner[i] = t.corner[i];
        if (!is_zero(normal)) return;
        // The longest side is the segment.
        unsigned longest = 0;
        std::int64_t most = -1;
        for (unsigned i = 0; i < 3; ++i) {
            const Integer3 side = end_of(i) - corner[i];
            if (dot(side, side) <= most) continue;
            most = dot(side, side);
            longest = i;
        }
        const Integer3 from = corner[longest], to = end_of(longest);
        corner[0] = from;
        corner[1] = to;
        count = most == 0 ? 1 : 2;
    }
    [[nodiscard]] const Integer3& end_of(unsigned side) const { return corner[side + 1 < count ? side + 1 : 0]; }
    [[nodiscard]] unsigned sides() const { return count == 3 ? 3 : count - 1; }

    [[nodiscard]] bool contains(const Integer3& point) const {
        const Integer3 off = point - corner[0];
        if (count == 1) return is_zero(off);
        if (count == 2) {
            const Integer3 along = corner[1] - corner[0];
            const std::int64_t at = dot(along, off);
            return is_zero(cross(along, off)) && at >= 0 && at <= dot(along, along);
        }
        if (!dot<Int128>(normal, off).is_zero()) return false;
        for (unsigned i = 0; i < 3; ++i)
            if (dot<Int128>(normal, cross(end_of(i) - corner[i], point - corner[i])).is_negative()) return false;
        return true;
    }
    [[nodiscard]] bool has_corner(const Integer3& point) const {
        for (unsigned i = 0; i < count; ++i)
            if (is_zero(point - corner[i])) return true;
        return false;
    }
};

Vec3 point_between(const Integer3& from, const Integer3& to, float share) {
    return to_vector(from) + to_vector(to - from) * share;
}

/// Adds where insides of two sides cross that are not parallel.
void add_crossing(const Integer3& p, const Integer3& p_end, const Integer3& q, const Integer3& q_end,
                  TrianglesTouch& touch) {
    const Integer3 along = p_end - p, other = q_end - q, between = q - p;
    const Integer3 normal = cross(along, other);
    if (is_zero(normal) || !dot<Int128>(normal, between).is_zero()) return;
    const Int128 whole = dot<Int128>(normal, normal), zero = 0;
    const Int128 at = dot<Int128>(normal, cross(between, other));
    const Int128 at_other = dot<Int128>(normal, cross(between, along));
    if (!(zero < at && at < whole && zero < at_other && at_other < whole)) return;
    touch.add(point_between(p, p_end, to_float(at) / to_float(whole)));
}

/// Adds where the inside of a side passes through the inside of a face.
void add_piercing(const Integer3& from, const Integer3& to, const Outline& face, TrianglesTouch& touch) {
    const Int128 at_from = dot<Int128>(face.normal, from - face.corner[0]);
    const Int128 at_to = dot<Int128>(face.normal, to - face.corner[0]);
    if (sign(at_from) * sign(at_to) >= 0) return;
    for (unsigned i = 0; i < 3; ++i) {
        const Integer3 across = cross(to - from, face.corner[i] - from);
        const int side = sign(dot<Int128>(across, face.end_of(i) - from));
        // The side goes up through the face or down, and passes all of its sides on the left or on the right.
        if (side != sign(at_to)) return;
    }
    touch.add(point_between(from, to, to_float(at_from) / to_float(at_from - at_to)));
}

void add_from(const Outline& p, const Outline& q, TrianglesTouch& touch) {
    if (q.count != 3) return;
    for (unsigned i = 0; i < p.sides(); ++i) add_piercing(p.corner[i], p.end_of(i), q, touch);
}

void find_points(const Outline& p, const Outline& q, TrianglesTouch& touch) {
    for (unsigned i = 0; i < p.count; ++i)
        if (q.contains(p.corner[i])) touch.add(to_vector(p.corner[i]));
    for (unsigned i = 0; i < q.count; ++i)
        if (!p.has_corner(q.corner[i]) && p.contains(q.corner[i])) touch.add(to_vector(q.corner[i]));
    for (unsigned i = 0; i < p.sides(); ++i)
        for (unsigned j = 0; j < q.sides(); ++j)
            add_crossing(p.corner[i], p.end_of(i), q.corner[j], q.end_of(j), touch);
    add_from(p, q, touch);
    add_from(q, p, touch);
}

/// Looks for the direction, from b to a, along which two triangles are least deep in each other: across the faces, or
/// across a side of each (Gottschalk, Lin and Manocha 1996).
class LeastDepth {
public:
    LeastDepth(const LatticeTriangle& a, const LatticeTriangle& b) {
        for (int i = 0; i < 3; ++i) {
            a_[i] = to_vector(corner_on_grid(a, i, 0) - corner_on_grid(a, 0, 0));
            b_[i] = to_vector(corner_on_grid(b, i, 0) - corner_on_grid(a, 0, 0));
        }
        try_direction_apart(front_of(a));
        try_direction_apart(front_of(b));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) try_direction_apart(direction_of(cross(side_from(a, i), side_from(b, j))));
    }
    [[nodiscard]] const Separation& best() const { return best_; }

private:
    void try_direction_apart(const Vec3& unit) {
        if (!(dot(unit, unit) > 0.0f)) return;
        const Span<float> ours = along(unit, a_), theirs = along(unit, b_);
        if (theirs.low - ours.high > best_.gap) best_ = {unit * -1.0f, theirs.low - ours.high};
        if (ours.low - theirs.high > best_.gap) best_ = {unit, ours.low - theirs.high};
    }
    static Span<float> along(const Vec3& unit, const Vec3* corner) {
        return span_of(dot(unit, corner[0]), dot(unit, corner[1]), dot(unit, corner[2]));
    }

    Vec3 a_[3], b_[3];  ///< from a's first corner
    Separation best_;
};

}  // namespace

// Out of line: its stack is not needed beside the walk.
ESPALIER_NOINLINE void touch_triangles(const LatticeTriangle& a, const LatticeTriangle& b,
                                       TrianglesTouch& touch) noexcept {
    touch.count = 0;
    find_points(Outline(a), Outline(b), touch);
    if (touch.count == 0) return;
    const Separation separation = LeastDepth(a, b).best();
    touch.normal = separation.normal * -1.0f;
    touch.depth = maximum(-separation.gap, 0.0f);
}

}  // namespace espalier::detail::contacts
