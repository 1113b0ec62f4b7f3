// Which part of a triangle is in all half-spaces, without ever computing a coordinate of it: constraints on the weights
// of the triangle's corners are added one by one, and points are named by the two constraints that cross there (a
// linear programme in two variables: Seidel 1991). Whether a point keeps to a third one is the sign of a determinant.
#include <runtime/overlap/rounded_shapes.hpp>

#include <bit>

#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/find.hpp>

namespace espalier::detail {

// Planes are moved into lattice units in integers: with floats the offset of an asset far from its local origin would
// lose most of its digits.

namespace {

/// Offsets are added up in units of 2^-16, so that cutting off what is below moves none of them noticeably.
constexpr int guard_bits = 16;
constexpr int longest_term = 120;

/// mantissa * 2^exponent in those units; where that is too long, as long as a term can be.
bool to_fixed_point(FloatParts parts, Int128& term) {
    const int shift = parts.exponent + guard_bits;
    const int length = 64 - std::countl_zero(static_cast<std::uint64_t>(magnitude(parts.mantissa)));
    if (parts.mantissa == 0 || shift < -63) return term = Int128(), true;
    if (shift <= 0) return term = Int128(parts.mantissa >> -shift), true;
    if (length + shift > longest_term) {
        const Int128 most = Int128(std::int64_t{1} << (longest_term - 64), 0);
        return term = negate_if(most, parts.mantissa < 0), false;
    }
    term = shift < 64 ? Int128(parts.mantissa) << shift : (Int128(parts.mantissa) << 63) << (shift - 63);
    return true;
}

/// With an offset beyond this, all boxes of a node lie on the same side of the plane.
constexpr std::int64_t farthest_offset = std::int64_t{1} << 52;

/// dot(n, origin + step * x) <= offset, divided by step and scaled by the power of two that makes n's largest
/// coordinate an integer of 24 bits. Only then are n's coordinates rounded: that turns the plane about lattice point 0.
bool round_half_space(const BlobData& blob, const FloatParts* normal, float world_offset, LatticePlane& plane) {
    int longest = -1000;
    for (int k = 0; k < 3; ++k)
        if (normal[k].mantissa != 0 && normal[k].exponent > longest) longest = normal[k].exponent;
    for (int k = 0; k < 3; ++k) {
        const int shift = longest - normal[k].exponent;
        const std::int64_t length = magnitude(normal[k].mantissa);
        const std::int64_t rounded = shift == 0   ? length
                                     : shift > 24 ? 0
                                                  : (length + (std::int64_t{1} << (shift - 1))) >> shift;
        plane.normal[k] = static_cast<std::int32_t>(negate_if(rounded, normal[k].mantissa < 0));
    }
    const int to_steps = -longest - blob.step_exponent;
    Int128 offset;
    FloatParts parts = parts_of(flush_subnormal(world_offset));
    parts.exponent += to_steps;
    to_fixed_point(parts, offset);
    for (int k = 0; k < 3; ++k) {
        const FloatParts origin = parts_of(blob.origin[k]);
        Int128 term;
        if (!to_fixed_point({normal[k].mantissa * origin.mantissa, normal[k].exponent + origin.exponent + to_steps},
                            term))
            return false;
        offset = offset - term;
    }
    offset = (offset + Int128(std::int64_t{1} << (guard_bits - 1))) >> guard_bits;
    plane.offset = Int128(farthest_offset) < offset    ? farthest_offset
                   : offset < Int128(-farthest_offset) ? -farthest_offset
                                                       : static_cast<std::int64_t>(offset.low);
    return true;
}

}  // namespace

QueryStatus round_volume(const BlobData& blob, const ConvexVolume& local, Rounded<ConvexVolume>& set) noexcept {
    if (local.planes.size() > max_planes) return QueryStatus::invalid_argument;
    set.plane_count = 0;
    bool is_empty = false;
    for (const Plane& plane : local.planes) {
        if (!is_finite(plane.normal) || is_nan(plane.offset)) return QueryStatus::invalid_argument;
        const auto parts = [](float x) { return parts_of(flush_subnormal(x)); };
        const FloatParts normal[3] = {parts(plane.normal.x), parts(plane.normal.y), parts(plane.normal.z)};
        if (normal[0].mantissa == 0 && normal[1].mantissa == 0 && normal[2].mantissa == 0)
            return QueryStatus::invalid_argument;
        if (!is_finite(plane.offset)) {
            is_empty = is_empty || is_negative(plane.offset);
            continue;  // or everything is behind it
        }
        LatticePlane rounded;
        if (!round_half_space(blob, normal, plane.offset, rounded)) return QueryStatus::out_of_range;
        set.add_plane(rounded);
    }
    set.bounded = false;
    set.is_enclosure = true;
    return is_empty ? QueryStatus::not_found : QueryStatus::ok;
}

namespace {

/// The half-space on the triangle, or a side of it: weights (wa, wb, wc) keep to it when
/// whole * (wa + wb + wc) + b * wb + c * wc >= 0.
struct Constraint {
    std::int64_t whole, b, c;
};

/// For numbers below 2^41: six products of three stay below 2^126.
struct Narrow {
    static int sign_of_volume(const Constraint& r, const Constraint& s, const Constraint& t) {
        return sign(dot(wide_cross({s.whole, s.b, s.c}, {t.whole, t.b, t.c}), {r.whole, r.b, r.c}));
    }
};

/// For numbers below 2^53: the products that are positive against those that are negative.
struct Wide {
    static int sign_of_volume(const Constraint& r, const Constraint& s, const Constraint& t) {
        Unsigned256 above{Int128()}, below{Int128()};
        const auto add = [&](const Int128& p, std::int64_t q) {
            Unsigned256& side = is_negative(p) != is_negative(q) ? below : above;
            side = side.plus(Unsigned256::product(magnitude(p), magnitude(q)));
        };
        const auto [whole, b, c] = wide_cross({s.whole, s.b, s.c}, {t.whole, t.b, t.c});
        add(whole, r.whole);
        add(b, r.b);
        add(c, r.c);
        return compare_scaled(above, below, 0);
    }
};

/// The constraints on one triangle, by number: the weights of a, b and c are not negative, and then the half-spaces.
/// Computed on demand: there may be many, and few of them matter.
struct Constraints {
    static constexpr unsigned sides = 3;

    const Rounded<ConvexVolume>& set;
    const LatticeTriangle& triangle;
    std::uint32_t crossing = 0;  ///< a bit for each half-space that has corners on either side of it

    [[nodiscard]] static std::int64_t room(const LatticePlane& plane, const std::int32_t* at) {
        std::int64_t room = plane.offset;
        for (int k = 0; k < 3; ++k) room -= std::int64_t{plane.normal[k]} * at[k];
        return room;
    }
    [[nodiscard]] Constraint of_half_space(unsigned i) const {
        const std::int64_t whole = room(set.planes[i], triangle.corner[0]);
        return {whole, room(set.planes[i], triangle.corner[1]) - whole,
                room(set.planes[i], triangle.corner[2]) - whole};
    }
    [[nodiscard]] Constraint operator[](unsigned number) const {
        if (number >= sides) return of_half_space(number - sides);
        const std::int64_t is_a = number == 0 ? 1 : 0;
        return {is_a, (number == 1 ? 1 : 0) - is_a, (number == 2 ? 1 : 0) - is_a};
    }
};

/// Whether some point of the triangle keeps to all constraints.
template <class Arithmetic>
ESPALIER_NOINLINE bool has_solution(const Constraints& constraints) {
    // A point that keeps to all constraints so far: corner a, and later where line `on` ends at constraint `last`.
    unsigned on = 0;
    unsigned last = 0;
    for (std::uint32_t left = constraints.crossing; left != 0; left &= left - 1) {
        const auto next = static_cast<unsigned>(std::countr_zero(left));
        const Constraint line = constraints.of_half_space(next);
        const auto volume = [&](const Constraint& before, unsigned after) {
            return Arithmetic::sign_of_volume(before, line, constraints[after]);
        };
        if ((on == 0 ? line.whole >= 0 : Arithmetic::sign_of_volume(line, constraints[on], constraints[last]) >= 0))
            continue;
        // Whatever keeps to this one too can be found on its line: from the point found so far to a better one all keep
        // to the others, and on the way one crosses the line. The triangle cuts a segment out of it, from side `first`
        // to side `last`, going round the line's normal counterclockwise; the other constraints shorten it.
        const bool is_inside[3] = {line.whole >= 0, line.whole + line.b >= 0, line.whole + line.c >= 0};
        const unsigned lonely = is_inside[1] == is_inside[2] ? 0u : is_inside[0] == is_inside[2] ? 1u : 2u;
        const unsigned after = lonely == 2 ? 0 : lonely + 1, before = lonely == 0 ? 2 : lonely - 1;
        unsigned first = is_inside[lonely] ? before : after;
        last = is_inside[lonely] ? after : before;
        on = Constraints::sides + next;
        const std::uint32_t earlier = constraints.crossing & ((1u << next) - 1u);
        for (std::uint32_t others = earlier; others != 0; others &= others - 1) {
            const unsigned other = static_cast<unsigned>(std::countr_zero(others));
            const Constraint constraint = constraints.of_half_space(other);
            const bool first_is_out = volume(constraint, first) > 0;
            const bool last_is_out = volume(constraint, last) < 0;
            if (first_is_out && last_is_out) return false;
            if (first_is_out) first = Constraints::sides + other;
            if (last_is_out) last = Constraints::sides + other;
        }
    }
    return true;
}

}  // namespace

bool meets(const Rounded<ConvexVolume>& set, const LatticeTriangle& triangle) noexcept {
    Constraints constraints = {set, triangle};
    bool is_narrow = true;
    for (unsigned i = 0; i < set.plane_count; ++i) {
        const Constraint constraint = constraints.of_half_space(i);
        const int inside = (constraint.whole >= 0 ? 1 : 0) + (constraint.whole + constraint.b >= 0 ? 1 : 0) +
                           (constraint.whole + constraint.c >= 0 ? 1 : 0);
        if (inside == 0) return false;
        if (inside == 3) continue;
        constexpr std::int64_t narrow = std::int64_t{1} << 41;
        is_narrow = is_narrow && magnitude(constraint.whole) < narrow && magnitude(constraint.b) < narrow &&
                    magnitude(constraint.c) < narrow;
        constraints.crossing |= 1u << i;
    }
    return takes_shortcut(is_narrow) ? has_solution<Narrow>(constraints) : has_solution<Wide>(constraints);
}

template QueryStatus find_overlaps_of<ConvexVolume>(const BlobData&, const void*, Each&, const WalkAccuracy&);

}  // namespace espalier::detail
