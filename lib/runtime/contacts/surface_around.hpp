// What of the surface goes on at an edge or a corner of a triangle that a body touches: whether another triangle there
// has the body on its other side, or is nearer to it.
#pragma once

#include <espalier/lattice.hpp>
#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/contacts/bodies.hpp>
#include <runtime/contacts/nearest_pair.hpp>
#include <runtime/contacts/touch.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier::detail::contacts {

/// The squared sine of the largest angle that counts as flat; 0 without edge flags.
inline float flat_limit_of(const BlobData& blob) {
    if (blob.edge_flags == nullptr) return 0.0f;
    return static_cast<float>(load_u32(blob.edge_flags)) / static_cast<float>(format::edge_flags::max_flat_limit);
}

/// Hands the triangles at a corner to a callable.
template <class Take>
struct AtCorner : Each {
    Take& take;

    AtCorner(const BlobData& from, const TriangleVisitor& by_id, Take& with) : Each(from, by_id), take(with) {
        on_triangle = [](Each& self, std::uint32_t index, const LatticeTriangle& triangle) {
            return static_cast<AtCorner&>(self).take(index, triangle);
        };
    }
};

/// Calls `take(index, triangle)` for the triangles at a corner. Returns whether it stopped.
template <class Take>
bool visit_triangles_at(const BlobData& blob, const std::int32_t* corner, Take take) {
    // Where the leaf is not at hand, on small cores, the triangle is searched.
    const auto search = [&](TriangleId id) { return take(id.index, find_triangle(blob, id.index)); };
    AtCorner<Take> answer(blob, search, take);
    const LatticeBox at = {{corner[0], corner[1], corner[2]}, {corner[0], corner[1], corner[2]}};
    return find_overlaps_of<LatticeBox>(blob, &at, answer, exactly) == QueryStatus::stopped;
}

inline bool is_same_place(const std::int32_t* a, const std::int32_t* b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// An edge of a triangle, from corner `from` to corner `to`, or the corner `from`.
struct Part {
    bool is_edge;
    unsigned from, to, before;

    explicit Part(Feature feature) {
        const auto number = static_cast<unsigned>(feature);
        constexpr auto first_edge = static_cast<unsigned>(Feature::edge_ab),
                       first_vertex = static_cast<unsigned>(Feature::vertex_a);
        is_edge = number < first_vertex;
        from = number - (is_edge ? first_edge : first_vertex);
        to = from == 2 ? 0 : from + 1;
        before = from == 0 ? 2 : from - 1;
    }
};

/// A triangle, seen from the middle of a body.
struct SeenFromMiddle {
    Vec3 corner[3];
    Vec3 face;
    bool is_behind;  ///< the middle is behind its plane

    SeenFromMiddle(const Body& body, const LatticeTriangle& triangle) : face(face_normal_of(triangle)) {
        const OriginRelative seen = body.seen(triangle);
        is_behind = is_origin_behind(seen);
        corner[0] = to_vector(seen.a) * power_of_two(-body.fraction_bits);
        corner[1] = corner[0] + to_vector(seen.ab);
        corner[2] = corner[0] + to_vector(seen.ac);
    }
    /// How far the middle is from an edge, toward the inside of the triangle; times the length of the edge.
    [[nodiscard]] float inward_of(unsigned from) const {
        const unsigned to = from == 2 ? 0 : from + 1;
        return dot(cross(face, corner[to] - corner[from]), corner[from]) * -1.0f;
    }
};

/// The surface around one triangle that a body touches, for places on its internal features.
class SurfaceAround {
public:
    SurfaceAround(const BlobData& blob, Body& body, std::uint32_t index, const LatticeTriangle& triangle,
                  const FacingSide& side)
        : blob_(blob), body_(body), index_(index), triangle_(triangle), side_(side) {}

    /// Whether the surface that goes on at an edge or corner has the body's middle on the same side as the triangle: of
    /// an edge the other triangle there, of a corner the one that the middle is over.
    [[nodiscard]] bool faces(Feature feature) const {
        const Part part(feature);
        bool is_known = false, is_same_side = true;
        visit_triangles_at(blob_, triangle_.corner[part.from], [&](std::uint32_t, const LatticeTriangle& other) {
            unsigned at = 0;  // the corner that both have
            while (at < 2 && !is_same_place(other.corner[at], triangle_.corner[part.from])) ++at;
            const unsigned before = at == 0 ? 2 : at - 1;
            // Along an edge both run in opposite directions.
            if (part.is_edge && !is_same_place(other.corner[before], triangle_.corner[part.to])) return Visit::next;
            const SeenFromMiddle seen(body_, other);
            if (!part.is_edge && (seen.inward_of(at) < 0.0f || seen.inward_of(before) < 0.0f)) return Visit::next;
            is_known = true;
            is_same_side = seen.is_behind == side_.is_back;
            return Visit::stop;
        });
        return is_known ? is_same_side : !side_.is_back;  // what is behind a ridge of tiles is nearly always above it
    }

    /// Whether another triangle has a place that is the same edge or corner: one that is nearer, or as near with a
    /// lower index. Where the surface goes on in another blob only the direction decides, and the face's replaces it.
    bool has_nearer(Touches& touches) const {
        Touch& place = touches.touch[0];
        const Part part(place.feature);
        const unsigned corners = 1u << part.from | (part.is_edge ? 1u << part.to : 0u);
        unsigned joined_edges = 0;  // a bit for each edge that another triangle has
        const auto is_nearer = [&](std::uint32_t index, const LatticeTriangle& other) {
            unsigned same = 0;
            for (unsigned i = 0; i < 3; ++i)
                for (const auto& corner : other.corner)
                    same |= is_same_place(triangle_.corner[i], corner) ? 1u << i : 0u;
            if (index == index_ || (same & corners) != corners) return Visit::next;
            joined_edges |= same & (same >> 1 | same << 2);
            Touches of_other;
            body_.touch(other, FacingSide{}, touches.nearest, of_other);
            if (of_other.count == 0) return Visit::next;
            const bool comes_first =
                of_other.nearest < touches.nearest || (of_other.nearest == touches.nearest && index < index_);
            return comes_first ? Visit::stop : Visit::next;
        };
        if (visit_triangles_at(blob_, triangle_.corner[part.from], is_nearer)) return true;
        const unsigned edges = 1u << part.from | (part.is_edge ? 0u : 1u << part.before);
        if ((edges & ~joined_edges) == 0) return false;
        // Over an edge between flat faces a direction leans by less than the angle between them; over the tip of many
        // it may lean by more.
        const Vec3 outward = face_normal_of(triangle_) * (side_.is_back ? -1.0f : 1.0f);
        const float lean = dot(outward, place.normal),
                    least = part.is_edge ? 1.0f - flat_limit() : minimum(1.0f - flat_limit(), 0.5f);
        if (lean < 0.0f || lean * lean < least - 0x1p-12f) return true;
        place.normal = outward;
        touches.count = 1;  // the others were along the direction that is replaced
        return false;
    }

private:
    [[nodiscard]] float flat_limit() const { return flat_limit_of(blob_); }

    const BlobData& blob_;
    Body& body_;
    std::uint32_t index_;
    const LatticeTriangle& triangle_;
    FacingSide side_;
};

}  // namespace espalier::detail::contacts
