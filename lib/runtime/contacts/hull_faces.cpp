// The faces of a convex hull by gift wrapping (Chand and Kapur 1970), in integers: no plane is in doubt.
#include <bit>

#include <runtime/contacts/hull_body.hpp>

namespace espalier::detail::contacts {

namespace {

using Vertices = std::uint64_t;  ///< a bit for each

/// Differences of vertices stay below 2^30, products of two below 2^61, and of three below 2^93.
class Wrapping {
public:
    explicit Wrapping(HullBody& hull) : hull_(hull), all_(0) {
        for (unsigned i = 0; i < hull.vertex_count; ++i) {
            bool is_new = true;
            for (unsigned j = 0; j < i && is_new; ++j) is_new = !is_zero(hull.units_at(i) - hull.units_at(j));
            if (is_new) all_ |= Vertices{1} << i;
        }
    }

    void run() {
        hull_.face_count = 0;
        hull_.first[0] = 0;
        unsigned start = 0, end = 0;
        find_edge(start, end);
        corners_ = Vertices{1} << start | Vertices{1} << end;
        if (start == end) return;
        unsigned beside = start;
        if (!find_beside(start, end, beside)) {
            const unsigned both[2] = {start, end};
            return add_face(both, 2);
        }
        wrap(start, end, beside);
        // Each half-edge without its other half has another face there. No two faces share a half-edge, so that this
        // ends with the last one.
        for (unsigned face = 0; face < hull_.face_count; ++face) {
            for (unsigned i = hull_.first[face]; i < hull_.first[face + 1u]; ++i) {
                const unsigned a = hull_.from[i], b = hull_.from[hull_.next(face, i)];
                if ((seen_[b] >> a & 1u) == 0 && find_beside(b, a, beside)) wrap(b, a, beside);
            }
        }
    }
    /// Leaves only the corners.
    void remove_others() {
        std::uint8_t number[max_hull_vertices];
        unsigned count = 0;
        for (unsigned i = 0; i < hull_.vertex_count; ++i) {
            if ((corners_ >> i & 1u) == 0) continue;
            number[i] = static_cast<std::uint8_t>(count);
            for (unsigned k = 0; k < 3; ++k) hull_.vertex[count][k] = hull_.vertex[i][k];
            ++count;
        }
        hull_.vertex_count = count;
        const unsigned half_edges = hull_.first[hull_.face_count];
        for (unsigned i = 0; i < half_edges; ++i) hull_.from[i] = number[hull_.from[i]];
    }

private:
    [[nodiscard]] Integer3 between(unsigned a, unsigned b) const { return hull_.units_at(b) - hull_.units_at(a); }
    template <class Function>
    void for_each(Vertices set, Function function) const {
        for (; set != 0; set &= set - 1) function(static_cast<unsigned>(std::countr_zero(set)));
    }

    /// Finds an edge: seen along z, all vertices are on the left of it or on it, and of those none is below it.
    void find_edge(unsigned& start, unsigned& end) const {
        start = static_cast<unsigned>(std::countr_zero(all_));
        for_each(all_, [&](unsigned i) {
            const Integer3 d = between(start, i);
            if (d.x != 0 ? d.x < 0 : d.y != 0 ? d.y < 0 : d.z < 0) start = i;
        });
        end = start;
        for_each(all_, [&](unsigned i) {
            const Integer3 best = between(start, end), d = between(start, i);
            const std::int64_t best_run = best.x + magnitude(best.y), run = d.x + magnitude(d.y);
            if (run == 0 || best_run == 0) {  // above the start
                if (run > 0 || (best_run == 0 && d.z > best.z)) end = i;
                return;
            }
            const std::int64_t left = best.x * d.y - best.y * d.x, lower = best.z * run - d.z * best_run;
            if (left < 0 || (left == 0 && (lower > 0 || (lower == 0 && run > best_run)))) end = i;
        });
    }
    /// Finds a vertex that is not on the line through two others.
    [[nodiscard]] bool find_beside(unsigned a, unsigned b, unsigned& found) const {
        const Integer3 edge = between(a, b);
        for (Vertices rest = all_; rest != 0; rest &= rest - 1) {
            found = static_cast<unsigned>(std::countr_zero(rest));
            if (!is_zero(cross(edge, between(a, found)))) return true;
        }
        return false;
    }
    /// Adds the face on the left of an edge of the hull.
    void wrap(unsigned a, unsigned b, unsigned beside) {
        const Integer3 edge = between(a, b);
        Integer3 normal = cross(edge, between(a, beside));
        Vertices in_plane = 0;
        for_each(all_, [&](unsigned i) {
            const Integer3 to = between(a, i);
            const int side = sign(dot<Int128>(normal, to));
            if (side < 0) return;
            if (side > 0) {
                normal = cross(edge, to);
                in_plane = 0;
            }
            in_plane |= Vertices{1} << i;
        });
        // What came before the last turn lies behind the plane, but for the edge.
        in_plane |= Vertices{1} << a | Vertices{1} << b;
        unsigned polygon[max_hull_vertices], count = 0;
        polygon[count++] = a;
        for (unsigned last = b; last != a && count < max_hull_vertices;) {
            polygon[count++] = last;
            unsigned next = a;
            for_each(in_plane & ~(Vertices{1} << last), [&](unsigned i) {
                const Integer3 best = between(last, next), to = between(last, i);
                const int side = sign(triple(normal, best, to));
                // Among several on one line take the farthest: all others lie on the same side of the last one.
                if (side < 0 || (side == 0 && dot<Int128>(best, best) < dot<Int128>(best, to))) next = i;
            });
            last = next;
        }
        add_face(polygon, count);
    }
    /// Returns a number with the sign of dot(normal, cross(u, v)), of vectors across the normal: along its longest
    /// axis.
    static std::int64_t triple(const Integer3& normal, const Integer3& u, const Integer3& v) {
        const Integer3 across = cross(u, v);
        const int k = longest_axis(normal);
        return normal[k] < 0 ? -across[k] : across[k];
    }
    void add_face(const unsigned* polygon, unsigned count) {
        const unsigned begin = hull_.first[hull_.face_count];
        if (hull_.face_count == HullBody::most_faces || begin + count > HullBody::most_half_edges) return;
        for (unsigned i = 0; i < count; ++i) {
            const unsigned a = polygon[i], b = polygon[i + 1 == count ? 0 : i + 1];
            hull_.from[begin + i] = static_cast<std::uint8_t>(a);
            seen_[a] |= Vertices{1} << b;
            corners_ |= Vertices{1} << a;
        }
        hull_.first[++hull_.face_count] = static_cast<std::uint16_t>(begin + count);
    }
    HullBody& hull_;
    Vertices all_;
    Vertices corners_ = 0;
    Vertices seen_[max_hull_vertices] = {};  ///< where half-edges of each vertex lead
};

/// Returns the corner behind the edge from a to b, in the face that lies on the left of it.
std::uint8_t corner_behind(const HullBody& hull, unsigned a, unsigned b) {
    for (unsigned face = 0; face < hull.face_count; ++face) {
        for (unsigned i = hull.first[face]; i < hull.first[face + 1u]; ++i) {
            const unsigned end = hull.next(face, i);
            if (hull.from[i] == a && hull.from[end] == b) return hull.from[hull.next(face, end)];
        }
    }
    return static_cast<std::uint8_t>(a);
}

}  // namespace

Integer3 HullBody::normal_of_face(unsigned face) const {
    const unsigned begin = first[face];
    if (first[face + 1u] - begin < 3) return {0, 0, 0};
    const Integer3 a = units_at(from[begin]);
    return cross(units_at(from[begin + 1]) - a, units_at(from[begin + 2]) - a);
}

// Out of line: its stack is not needed beside the walk.
ESPALIER_NOINLINE void find_faces(HullBody& hull) noexcept {
    Wrapping wrapping(hull);
    wrapping.run();
    wrapping.remove_others();
    for (unsigned face = 0; face < hull.face_count; ++face) {
        for (unsigned i = hull.first[face]; i < hull.first[face + 1u]; ++i) {
            const unsigned a = hull.from[i], b = hull.from[hull.next(face, i)];
            hull.across[i] = corner_behind(hull, b, a);
        }
    }
}

}  // namespace espalier::detail::contacts
