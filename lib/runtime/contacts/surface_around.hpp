// What of the surface goes on at an edge or a corner of a triangle that a body touches: whether another triangle there
// has the body on its other side, or is nearer to it.
#pragma once

#include <span>

#include <espalier/advanced/lattice.hpp>
#include <espalier/overlap.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/base/uninitialised.hpp>
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

/// Returns the number of the corner of a triangle that is that place, or 3.
inline unsigned corner_at(const LatticeTriangle& triangle, const std::int32_t* place) {
    unsigned at = 0;
    while (at < 3 && !is_same_place(triangle.corner[at], place)) ++at;
    return at;
}
constexpr unsigned corner_after(unsigned corner) { return corner == 2 ? 0 : corner + 1; }
constexpr unsigned corner_before(unsigned corner) { return corner == 0 ? 2 : corner - 1; }

/// An edge of a triangle, from corner `from` to corner `to`, or the corner that is both.
struct Part {
    bool is_edge;
    unsigned from, to;

    explicit Part(Feature feature) {
        const auto number = static_cast<unsigned>(feature);
        constexpr auto first_edge = static_cast<unsigned>(Feature::edge_ab),
                       first_vertex = static_cast<unsigned>(Feature::vertex_a);
        is_edge = number < first_vertex;
        from = number - (is_edge ? first_edge : first_vertex);
        to = is_edge ? corner_after(from) : from;
    }
};

/// A triangle near a body.
struct NearTriangle {
    std::uint32_t index;
    LatticeTriangle triangle;
    float nearest = -infinity;  ///< Touches::nearest, once it is known
};

/// The triangles near a body, in storage order, as far as there is room. A round body is no farther from what meets at
/// its nearest place of a triangle than from that triangle: if all are here, no walk has to find them again.
template <class Near = NearTriangle, unsigned room = 32>
class NearTriangles {
public:
    static constexpr unsigned most = small_code ? 1 : room;

    void add(const Near& near) { near_[count_++] = near; }
    [[nodiscard]] bool are_full() const { return count_ == most; }
    void clear() { count_ = 0; }
    [[nodiscard]] std::span<Near> all() { return {near_.data(), count_}; }

private:
    Uninitialised<Near, most> near_;
    unsigned count_ = 0;
};

/// Returns the end of an edge where probably fewer triangles meet, because this one has the larger angle there: at the
/// tip of a cone of thousands each would else look at all others.
inline const std::int32_t* less_crowded(const LatticeTriangle& triangle, const Part& part) {
    const std::int32_t *const from = triangle.corner[part.from], *const to = triangle.corner[part.to];
    const auto squared = [beyond = triangle.corner[corner_before(part.from)]](const std::int32_t* end) {
        float sum = 0.0f;
        for (int k = 0; k < 3; ++k) {
            const auto side = static_cast<float>(beyond[k] - end[k]);
            sum += side * side;
        }
        return sum;
    };
    return squared(to) < squared(from) ? to : from;
}

/// Calls `take(NearTriangle&)` for the triangles at one end of a part of a triangle, and maybe for others, in storage
/// order: those that are known to be all, or the ones that a walk finds. Returns whether it stopped.
template <class Near, class Take>
bool visit_around(const BlobData& blob, std::span<Near> all, const LatticeTriangle& triangle, const Part& part,
                  Take take) {
    if (takes_shortcut(!all.empty())) {
        for (Near& other : all)
            if (take(other) == Visit::stop) return true;
        return false;
    }
    return visit_triangles_at(blob, less_crowded(triangle, part),
                              [&](std::uint32_t index, const LatticeTriangle& found) {
                                  NearTriangle other = {index, found};
                                  return take(other);
                              });
}

/// The triangles of a blob at a corner: whether an internal edge there has no second one, because the surface goes on
/// in another blob, and how far their faces lean from one of them.
class Fan {
public:
    explicit Fan(const Vec3& face) : face_(face) {}

    void add(const LatticeTriangle& triangle, unsigned at, InternalFeatures internal, bool is_back) {
        // Each edge is seen from both of its triangles, in opposite directions, so that pairs cancel.
        const unsigned before = corner_before(at);
        if (internal.have(edge_of(static_cast<int>(at)), is_back)) sum_ += mixed(triangle.corner[corner_after(at)]);
        if (internal.have(edge_of(static_cast<int>(before)), is_back)) sum_ -= mixed(triangle.corner[before]);
        const Vec3 face = face_normal_of(triangle);
        if (largest(face) > 0.0f) least_cosine_ = minimum(least_cosine_, dot(face, face_));
    }
    [[nodiscard]] bool goes_on() const { return sum_ != 0; }
    [[nodiscard]] float least_cosine() const { return least_cosine_; }

private:
    /// Spreads a place over all bits, so that sums of several hardly agree by chance (Steele, Lea and Flood 2014).
    static std::uint64_t mixed(const std::int32_t* place) {
        std::uint64_t bits = 0;
        for (int k = 0; k < 3; ++k) {
            bits = (bits ^ static_cast<std::uint32_t>(place[k])) * 0xbf58476d1ce4e5b9u;
            bits ^= bits >> 31;
        }
        return bits;
    }

    Vec3 face_;
    std::uint64_t sum_ = 0;
    float least_cosine_ = 1.0f;
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
        const unsigned to = corner_after(from);
        return dot(cross(face, corner[to] - corner[from]), corner[from]) * -1.0f;
    }
};

/// The surface around one triangle that a body touches, for places on its internal features.
class SurfaceAround {
public:
    /// `near` are all triangles near the body, or none if that is not known.
    SurfaceAround(const Blob& blob, Body& body, std::uint32_t index, const LatticeTriangle& triangle,
                  const FacingSide& side, std::span<NearTriangle> near)
        : owner_(blob),
          blob_(data_of(blob)),
          body_(body),
          index_(index),
          triangle_(triangle),
          side_(side),
          near_(near) {}

    /// Whether the surface that goes on at an edge or corner has the body's middle on the same side as the triangle: of
    /// an edge the other triangle there, of a corner the one that the middle is over.
    [[nodiscard]] bool faces(Feature feature) const {
        const Part part(feature);
        const std::int32_t *const from = triangle_.corner[part.from], *const to = triangle_.corner[part.to];
        bool is_known = false, is_same_side = true;
        visit_around(blob_, near_, triangle_, part, [&](const NearTriangle& of_near) {
            const LatticeTriangle& other = of_near.triangle;
            const unsigned at = corner_at(other, from);
            if (at == 3) return Visit::next;
            const unsigned before = corner_before(at);
            // Along an edge both run in opposite directions.
            if (part.is_edge && !is_same_place(other.corner[before], to)) return Visit::next;
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
        const std::int32_t *const from = triangle_.corner[part.from], *const to = triangle_.corner[part.to];
        bool is_joined = false;  // the edge has another triangle
        Fan fan(face_normal_of(triangle_));
        const auto is_nearer = [&](NearTriangle& other) {
            const unsigned at = corner_at(other.triangle, from);
            if (at == 3 || corner_at(other.triangle, to) == 3) return Visit::next;
            const InternalFeatures internal = internal_features(owner_, TriangleId{other.index});
            if (!part.is_edge) fan.add(other.triangle, at, internal, side_.is_back);
            if (other.index == index_) return Visit::next;
            is_joined = true;
            if (other.nearest == -infinity) {
                Touches of_other;
                body_.touch(other.triangle, FacingSide{}, touches.nearest, of_other);
                other.nearest = of_other.count == 0 ? infinity : of_other.nearest;
            }
            const bool comes_first =
                other.nearest < touches.nearest || (other.nearest == touches.nearest && other.index < index_);
            return comes_first ? Visit::stop : Visit::next;
        };
        if (visit_around(blob_, near_, triangle_, part, is_nearer)) return true;
        if (part.is_edge ? is_joined : !fan.goes_on()) return false;
        // What lies beyond leans by at most the flat angle from a face of this blob.
        const Vec3 outward = side_.own_normal(face_normal_of(triangle_));
        const float flat = side_.flat_cosine, least = fan.least_cosine();
        const auto sine_of = [](float cosine) { return square_root(maximum(1.0f - cosine * cosine, 0.0f)); };
        const float limit = least * flat - sine_of(least) * sine_of(flat);
        if (dot(outward, place.normal) < maximum(limit - 0x1p-12f, 0.0f)) return true;
        place.normal = outward;
        touches.count = 1;  // the others were along the direction that is replaced
        return false;
    }

private:
    const Blob& owner_;
    const BlobData& blob_;
    Body& body_;
    std::uint32_t index_;
    const LatticeTriangle& triangle_;
    FacingSide side_;
    std::span<NearTriangle> near_;
};

}  // namespace espalier::detail::contacts
