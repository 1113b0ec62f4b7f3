// A convex hull with its faces, as contacts need it: found once a query from the vertices, exactly.
#pragma once

#include <cstdint>

#include <espalier/shapes.hpp>
#include <runtime/contacts/touch.hpp>

namespace espalier::detail::contacts {

/// The corners of a convex hull, none of them in the hull of the others, and its faces: polygons, of which no two lie
/// in one plane. A hull that is flat has two, a segment one of two corners, and a point none.
struct HullBody {
    static constexpr unsigned most_faces = 2 * max_hull_vertices - 4;
    static constexpr unsigned most_half_edges = 6 * max_hull_vertices - 12;

    Integer3 middle;  ///< in units of 2^-fraction_bits steps
    int fraction_bits;
    float scale;  ///< one unit in steps
    float size;   ///< steps: no vertex is farther from the middle
    unsigned vertex_count;
    unsigned face_count;
    std::int32_t vertex[max_hull_vertices][3];  ///< units from the middle
    std::uint16_t first[most_faces + 1];        ///< the first half-edge of each face, and the number of all
    std::uint8_t from[most_half_edges];         ///< the corner where a half-edge begins; counterclockwise from outside
    std::uint8_t across[most_half_edges];       ///< the corner behind the edge in the face on its other side

    [[nodiscard]] Integer3 units_at(unsigned number) const {
        const std::int32_t* at = vertex[number];
        return {at[0], at[1], at[2]};
    }
    /// Without operators of vectors, which small cores would call: this is the innermost loop of contacts.
    [[nodiscard]] Vec3 at(unsigned number) const {
        const std::int32_t* at = vertex[number];
        return {static_cast<float>(at[0]) * scale, static_cast<float>(at[1]) * scale,
                static_cast<float>(at[2]) * scale};
    }
    /// Returns the half-edge behind another one in its face.
    [[nodiscard]] unsigned next(unsigned face, unsigned half_edge) const {
        return half_edge + 1u == first[face + 1] ? first[face] : half_edge + 1u;
    }
    /// Returns a normal of the face in units, outward; zero for a face of two corners.
    [[nodiscard]] Integer3 normal_of_face(unsigned face) const;
};

/// Sets the middle, and the vertices from there: those of the hull of at least one point on a grid of 2^-fraction_bits
/// steps.
template <class Point>
void set_vertices(HullBody& hull, const Point* points, unsigned count, int fraction_bits) {
    hull.fraction_bits = fraction_bits;
    hull.scale = power_of_two(-fraction_bits);
    hull.vertex_count = count;
    Integer3 sum = {0, 0, 0};
    for (unsigned i = 0; i < count; ++i) sum = sum + Integer3{points[i][0], points[i][1], points[i][2]};
    const auto number = static_cast<std::int64_t>(count);
    hull.middle = {sum.x / number, sum.y / number, sum.z / number};
    hull.size = 0.0f;
    for (unsigned i = 0; i < count; ++i) {
        const Integer3 from_middle = Integer3{points[i][0], points[i][1], points[i][2]} - hull.middle;
        for (int k = 0; k < 3; ++k) hull.vertex[i][k] = static_cast<std::int32_t>(from_middle[k]);
        hull.size = maximum(hull.size, to_float(sum_of_magnitudes(from_middle)) * hull.scale);
    }
}

/// Finds the faces of the hull of `vertex_count` vertices, which lie in units from the middle and differ by less than
/// 2^30. Those that are no corners are removed. Takes O(vertices^2).
void find_faces(HullBody& hull) noexcept;

/// Writes how a hull touches the triangle, or is no farther away than `reach`; nothing if it is farther.
void touch_hull(const HullBody& hull, const LatticeTriangle& triangle, const FacingSide& side, float reach,
                Touches& touches);

}  // namespace espalier::detail::contacts
