// The kernel of two triangles: called once a candidate, not worth a copy in every instruction set.
#include <runtime/kernels/triangle_triangle.hpp>

namespace espalier::detail {

namespace {

// With an Integer3, of 64 bits, coordinates may differ by at most 2^20: 6 products of three such stay below 2^62.6.
// With a WideVector, of 128 bits, they may differ by less than 2^39: a normal's stay below 2^79, 3 products of one
// below 2^119.6.

/// Sign of the volume of four points: positive when d is on the side of a, b, c from which they go round
/// counterclockwise.
template <class Vector>
int volume(const Integer3& a, const Integer3& b, const Integer3& c, const Integer3& d) {
    return sign(dot(cross_in<Vector>(b - a, c - a), d - a));
}

bool boxes_meet(const IntegerTriangle& p, const IntegerTriangle& q) {
    for (int k = 0; k < 3; ++k) {
        const Span<std::int64_t> ours = span_of(p, k), theirs = span_of(q, k);
        if (ours.high < theirs.low || theirs.high < ours.low) return false;
    }
    return true;
}

/// Whether the sides of one triangle, seen along an axis, have a normal that separates the two.
bool is_separated_by_side(const IntegerTriangle& p, const IntegerTriangle& q, std::int64_t Integer3::*x,
                          std::int64_t Integer3::*y) {
    for (int k = 0; k < 3; ++k) {
        const Integer3& from = p.corner[k];
        const Integer3 edge = p.corner[k == 2 ? 0 : k + 1] - from;
        // Where a point is across the side: 0 for the side itself, so that only three points are left to test.
        const auto across = [&](const Integer3& point) {
            const Integer3 v = point - from;
            return sign(product_difference(edge.*x, v.*y, edge.*y, v.*x));
        };
        const int own = across(p.corner[k == 0 ? 2 : k - 1]);
        const int other = across(q.corner[0]);
        if (other == 0 || other == own) continue;
        if (across(q.corner[1]) == other && across(q.corner[2]) == other) return true;
    }
    return false;
}

/// For six points of one plane, of which `normal` is a normal, or all of one line: then it is zero.
ESPALIER_NOINLINE bool meet_in_plane(const IntegerTriangle& p, const IntegerTriangle& q, const WideVector& normal) {
    // Points of one line meet where their boxes do, others also need no side that separates them; seen along an axis
    // that the plane is not parallel to nothing of this changes.
    if (!boxes_meet(p, q)) return false;
    if (is_zero(normal)) return true;
    const auto x = normal.z.is_zero() && normal.y.is_zero() ? &Integer3::y : &Integer3::x;
    const auto y = !normal.z.is_zero() ? &Integer3::y : &Integer3::z;
    return !is_separated_by_side(p, q, x, y) && !is_separated_by_side(q, p, x, y);
}

/// The two ends of a triangle without area: the first and the last of its corners in lexicographic order.
void find_ends(const IntegerTriangle& segment, Integer3* ends) {
    const auto is_before = [](const Integer3& a, const Integer3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    ends[0] = ends[1] = segment.corner[0];
    for (int k = 1; k < 3; ++k) {
        if (is_before(segment.corner[k], ends[0])) ends[0] = segment.corner[k];
        if (is_before(ends[1], segment.corner[k])) ends[1] = segment.corner[k];
    }
}

/// For two triangles without area.
ESPALIER_NOINLINE bool segments_meet(const IntegerTriangle& p, const IntegerTriangle& q) {
    Integer3 s[2], t[2];
    find_ends(p, s);
    find_ends(q, t);
    if (volume<WideVector>(s[0], s[1], t[0], t[1]) != 0) return false;
    // Any three of the four points that are not on one line tell the plane.
    WideVector plane = wide_cross(s[1] - s[0], t[0] - s[0]);
    if (is_zero(plane)) plane = wide_cross(s[1] - s[0], t[1] - s[0]);
    if (is_zero(plane)) plane = wide_cross(t[1] - t[0], s[0] - t[0]);
    return meet_in_plane(p, q, plane);
}

/// For a triangle p without area, and q with some.
ESPALIER_NOINLINE bool segment_meets(const IntegerTriangle& p, const IntegerTriangle& q) {
    Integer3 s[2];
    find_ends(p, s);
    const WideVector normal = wide_cross(q.corner[1] - q.corner[0], q.corner[2] - q.corner[0]);
    const int from = sign(dot(normal, s[0] - q.corner[0]));
    const int to = sign(dot(normal, s[1] - q.corner[0]));
    if (from == 0 && to == 0) return meet_in_plane(p, q, normal);
    if (from == to) return false;
    bool left = false;
    bool right = false;
    for (int k = 0; k < 3; ++k) {
        const int side = volume<WideVector>(s[0], s[1], q.corner[k], q.corner[k == 2 ? 0 : k + 1]);
        left = left || side < 0;
        right = right || side > 0;
    }
    return !(left && right);
}

/// The corner that is alone on its side of a plane or, where there is none, the one in the plane. The line that both
/// planes share crosses the two sides at that corner, and each in one point. Not all of `sides` are 0.
unsigned lonely_corner(const int* sides) {
    const int sum = sides[0] + sides[1] + sides[2];
    const bool has_zero = sides[0] == 0 || sides[1] == 0 || sides[2] == 0;
    // + - 0: either of the two. + 0 0 and + - -: the +. - 0 0 and + + -: the -. + + 0 and - - 0: the 0.
    const int lonely = !has_zero ? -sum : sum == 0 ? 1 : sum == 2 || sum == -2 ? 0 : sum;
    return sides[0] == lonely ? 0u : sides[1] == lonely ? 1u : 2u;
}

/// A triangle turned so that the corner comes first.
struct Turned {
    const Integer3* a;
    const Integer3* b;
    const Integer3* c;
    Turned(const IntegerTriangle& t, unsigned first)
        : a(&t.corner[first]), b(&t.corner[first == 2 ? 0 : first + 1]), c(&t.corner[first == 0 ? 2 : first - 1]) {}
    void flip() {
        const Integer3* was = b;
        b = c;
        c = was;
    }
};

/// Whether a corner lies on the positive side, or the two others on the negative one.
bool is_above(const int* sides, unsigned corner) {
    return sides[corner] > 0 || (sides[corner] == 0 && sides[corner == 0 ? 1 : 0] < 0);
}

bool all_strictly_alike(const int* sides) { return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2]; }

/// Whether the triangles meet, unless one has no area or both lie in one plane.
struct Meeting {
    bool is_special = false;
    bool p_is_flat = false;
    bool q_is_flat = false;
    bool answer = false;
};

template <class Vector>
inline Meeting meet(const IntegerTriangle& p, const IntegerTriangle& q) {
    const auto sides_of = [](const IntegerTriangle& t, const Vector& normal, const Integer3& from, int* sides) {
        for (int k = 0; k < 3; ++k) sides[k] = sign(dot(normal, t.corner[k] - from));
    };
    int p_sides[3];
    int q_sides[3];
    const auto q_normal = cross_in<Vector>(q.corner[1] - q.corner[0], q.corner[2] - q.corner[0]);
    sides_of(p, q_normal, q.corner[0], p_sides);
    if (all_strictly_alike(p_sides)) return {};
    const auto p_normal = cross_in<Vector>(p.corner[1] - p.corner[0], p.corner[2] - p.corner[0]);
    sides_of(q, p_normal, p.corner[0], q_sides);
    if (all_strictly_alike(q_sides)) return {};
    if ((p_sides[0] | p_sides[1] | p_sides[2]) == 0 || (q_sides[0] | q_sides[1] | q_sides[2]) == 0)
        return {true, is_zero(p_normal), is_zero(q_normal)};
    // Both triangles cross the line that their planes share. Turn and flip each so that its first corner is above the
    // other and the two others are not: then p's part of the line reaches from side ab to side ac, q's the other way.
    const unsigned p_first = lonely_corner(p_sides);
    const unsigned q_first = lonely_corner(q_sides);
    Turned s(p, p_first);
    Turned t(q, q_first);
    if (!is_above(p_sides, p_first)) t.flip();
    if (!is_above(q_sides, q_first)) s.flip();
    return {false, false, false,
            volume<Vector>(*s.a, *s.b, *t.a, *t.b) <= 0 && volume<Vector>(*s.a, *s.c, *t.a, *t.c) >= 0};
}

ESPALIER_NOINLINE Meeting meet_wide(const IntegerTriangle& p, const IntegerTriangle& q) {
    return meet<WideVector>(p, q);
}

/// Whether all corners lie within 2^19 of the first one, along every axis.
[[maybe_unused]] bool are_near(const IntegerTriangle& p, const IntegerTriangle& q) {
    constexpr std::int64_t reach = std::int64_t{1} << 19;
    std::uint64_t any = 0;
    const auto add = [&](const Integer3& v) {
        const Integer3 d = v - p.corner[0];
        any |= static_cast<std::uint64_t>(d.x + reach) | static_cast<std::uint64_t>(d.y + reach) |
               static_cast<std::uint64_t>(d.z + reach);
    };
    add(p.corner[1]);
    add(p.corner[2]);
    for (const Integer3& v : q.corner) add(v);
    return any < 2 * static_cast<std::uint64_t>(reach);
}

/// For two triangles with area.
ESPALIER_NOINLINE bool meet_in_own_plane(const IntegerTriangle& p, const IntegerTriangle& q) {
    return meet_in_plane(p, q, wide_cross(q.corner[1] - q.corner[0], q.corner[2] - q.corner[0]));
}

}  // namespace

bool triangles_meet(const IntegerTriangle& p, const IntegerTriangle& q) noexcept {
    const Meeting meeting = takes_shortcut() && are_near(p, q) ? meet<Integer3>(p, q) : meet_wide(p, q);
    if (!meeting.is_special) return meeting.answer;
    if (meeting.p_is_flat && meeting.q_is_flat) return segments_meet(p, q);
    if (meeting.p_is_flat) return segment_meets(p, q);
    if (meeting.q_is_flat) return segment_meets(q, p);
    return meet_in_own_plane(p, q);
}

ESPALIER_NOINLINE bool triangles_meet(const LatticeTriangle& p, const LatticeTriangle& q) noexcept {
    return triangles_meet(integer_triangle(p), integer_triangle(q));
}

}  // namespace espalier::detail
