// Which part of a triangle is in all half-spaces, without ever computing a coordinate of it: constraints on the weights
// of the triangle's corners are added one by one, and points are named by the two constraints that cross there (a
// linear programme in two variables: Seidel 1991). Whether a point keeps to a third one is the sign of a determinant.
#include <runtime/lattice_half_spaces.hpp>

#include <runtime/wide_vector.hpp>

namespace espalier::detail {

namespace {

/// The half-space on the triangle, or a side of it: weights (wa, wb, wc) keep to it when
/// whole * (wa + wb + wc) + b * wb + c * wc >= 0.
struct Constraint {
    std::int64_t whole, b, c;
};

int sign(Int128 a) { return a.is_negative() ? -1 : a.is_zero() ? 0 : 1; }

/// For numbers below 2^41: six products of three stay below 2^126.
struct Narrow {
    static int sign_of_volume(const Constraint& r, const Constraint& s, const Constraint& t) {
        const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t u, std::int64_t v) {
            return multiply(p, v) - multiply(q, u);
        };
        return sign(multiply(minor(s.b, s.c, t.b, t.c), r.whole) + multiply(minor(s.c, s.whole, t.c, t.whole), r.b) +
                    multiply(minor(s.whole, s.b, t.whole, t.b), r.c));
    }
};

/// For numbers below 2^53: the products that are positive against those that are negative.
struct Wide {
    static int sign_of_volume(const Constraint& r, const Constraint& s, const Constraint& t) {
        Unsigned256 above{Int128()}, below{Int128()};
        const auto add = [&](std::int64_t p, std::int64_t q, std::int64_t u) {
            const Unsigned256 product =
                Unsigned256::product(Unsigned256(magnitude(multiply(p, q))), Unsigned256(Int128(magnitude(u))));
            Unsigned256& side = ((p < 0) != (q < 0)) != (u < 0) ? below : above;
            side = side.plus(product);
        };
        add(r.whole, s.b, t.c);
        add(-r.whole, s.c, t.b);
        add(r.b, s.c, t.whole);
        add(-r.b, s.whole, t.c);
        add(r.c, s.whole, t.b);
        add(-r.c, s.b, t.whole);
        return compare_scaled(above, below, 0);
    }
};

/// The sides of the triangle as constraints: the weights of a, b and c are not negative.
constexpr unsigned side_count = 3;
constexpr Constraint sides[side_count] = {{1, -1, -1}, {0, 1, 0}, {0, 0, 1}};

struct Constraints {
    Constraint list[side_count + Volume::max_planes] = {sides[0], sides[1], sides[2]};
    unsigned count = side_count;
};

/// Whether some point of the triangle keeps to all constraints. Each but the sides has corners on either side of it.
template <class Arithmetic>
bool has_solution(const Constraints& constraints) {
    const auto volume = [&](unsigned r, unsigned s, unsigned t) {
        return Arithmetic::sign_of_volume(constraints.list[r], constraints.list[s], constraints.list[t]);
    };
    // A point that keeps to all constraints so far: corner a, and later where line `on` ends at constraint `last`.
    unsigned on = 0;
    unsigned last = 0;
    for (unsigned next = side_count; next < constraints.count; ++next) {
        const Constraint& line = constraints.list[next];
        if ((on == 0 ? line.whole >= 0 : volume(next, on, last) >= 0)) continue;
        // Whatever keeps to this one too can be found on its line: from the point found so far to a better one all keep
        // to the others, and on the way one crosses the line. The triangle cuts a segment out of it, from side `first`
        // to side `last`, going round the line's normal counterclockwise; the other constraints shorten it.
        const bool is_inside[3] = {line.whole >= 0, line.whole + line.b >= 0, line.whole + line.c >= 0};
        const unsigned lonely = is_inside[1] == is_inside[2] ? 0u : is_inside[0] == is_inside[2] ? 1u : 2u;
        const unsigned after = lonely == 2 ? 0 : lonely + 1, before = lonely == 0 ? 2 : lonely - 1;
        unsigned first = is_inside[lonely] ? before : after;
        last = is_inside[lonely] ? after : before;
        for (unsigned other = side_count; other < next; ++other) {
            const bool first_is_out = volume(other, next, first) > 0;
            const bool last_is_out = volume(other, next, last) < 0;
            if (first_is_out && last_is_out) return false;
            if (first_is_out) first = other;
            if (last_is_out) last = other;
        }
        on = next;
    }
    return true;
}

[[gnu::noinline]] bool has_solution_wide(const Constraints& constraints) { return has_solution<Wide>(constraints); }

}  // namespace

bool meets(const LatticeHalfSpaces& set, const LatticeTriangle& triangle) noexcept {
    Constraints constraints;
    bool is_narrow = true;
    for (unsigned i = 0; i < set.plane_count; ++i) {
        const LatticePlane& plane = set.half_space[i];
        std::int64_t room[3];
        unsigned inside = 0;
        for (int corner = 0; corner < 3; ++corner) {
            room[corner] = plane.offset;
            for (int k = 0; k < 3; ++k) room[corner] -= std::int64_t{plane.normal[k]} * triangle.corner[corner][k];
            inside += room[corner] >= 0 ? 1 : 0;
        }
        if (inside == 0) return false;
        if (inside == 3) continue;
        const Constraint constraint = {room[0], room[1] - room[0], room[2] - room[0]};
        constexpr std::int64_t narrow = std::int64_t{1} << 41;
        is_narrow = is_narrow && magnitude(constraint.whole) < narrow && magnitude(constraint.b) < narrow &&
                    magnitude(constraint.c) < narrow;
        constraints.list[constraints.count++] = constraint;
    }
    return is_narrow ? has_solution<Narrow>(constraints) : has_solution_wide(constraints);
}

}  // namespace espalier::detail
