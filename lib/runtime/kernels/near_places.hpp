// Which places of a segment and a triangle may be the nearest, by floats. The exact products of a place take ten times
// as long, and of eight places one or two are in question (docs/numerics.md, *Segments and triangles*).
#pragma once

#include <runtime/base/vector.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// The ends of the segment, beside the triangle, and the sides of the triangle, beside the segment.
class NearPlaces {
public:
    /// All of them.
    NearPlaces() = default;
    /// `w` are the corners and d the other end, seen from one end of the segment, below 2^31 in each coordinate; `t` is
    /// the triangle.
    NearPlaces(const OriginRelative& t, const Integer3& d, const Integer3* w) {
        constexpr float scale = 0x1p-15f;  // products of four coordinates are finite then
        const Vec3 way = to_vector(d) * scale;
        const Vec3 corner[3] = {to_vector(w[0]) * scale, to_vector(w[1]) * scale, to_vector(w[2]) * scale};
        float reach = largest(way), most = infinity;  // the distance is less than that
        for (const Vec3& at : corner) reach = maximum(reach, largest(at));
        Vec3 apart;  // the shortest way from a side to the segment
        float side_least[3], end_least[2] = {0.0f, 0.0f}, rounding = reach * 0x1p-15f;
        for (unsigned i = 0; i < 3; ++i) {
            const Vec3 &start = corner[i], &end = corner[i == 2 ? 0 : i + 1];
            const Vec3 shortest = shortest_way(start, end - start, way);
            const float length = square_root(dot(shortest, shortest));
            side_least[i] = gap_along(shortest, length, way, maximum(dot(shortest, start), dot(shortest, end)));
            if (length < most) apart = shortest;
            most = minimum(length, most);
        }
        const float beyond = maximum(maximum(dot(apart, corner[0]), dot(apart, corner[1])), dot(apart, corner[2]));
        const Vec3 end_from[2] = {{}, way};
        for (unsigned i = 0; i < 2 && most > 0.0f; ++i) end_least[i] = (dot(apart, end_from[i]) - beyond) / most;

        const Vec3 ab = to_vector(t.ab), ac = to_vector(t.ac), normal = cross(ab, ac);
        const float area = square_root(dot(normal, normal)), size = maximum(dot(ab, ab), dot(ac, ac));
        if (area * 64.0f > size) {  // of a needle the normal would be rounding
            rounding += rounding * (size / area);
            for (unsigned i = 0; i < 2; ++i) {
                const float height = absolute(dot(normal, end_from[i] - corner[0])) / area;
                bool is_over = true;
                for (unsigned side = 0; side < 3; ++side) {
                    const Vec3 &start = corner[side], &end = corner[side == 2 ? 0 : side + 1];
                    is_over = is_over && dot(cross(normal, end - start), end_from[i] - start) >= 0.0f;
                }
                if (is_over) most = minimum(height, most);
                end_least[i] = maximum(height, end_least[i]);
            }
        }
        for (unsigned i = 0; i < 2; ++i) end[i] = end_least[i] <= most + rounding;
        for (unsigned i = 0; i < 3; ++i) side[i] = side_least[i] <= most + rounding;
    }

    bool end[2] = {true, true};
    bool side[3] = {true, true, true};

private:
    static float share_of(float part, float whole) { return whole > 0.0f ? minimum(maximum(part / whole, 0.0f), 1.0f) : 0.0f; }
    /// From the side that leads from `start` along `side` to the segment from 0 to `way` (Ericson 2005, 5.1.9).
    static Vec3 shortest_way(const Vec3& start, const Vec3& side, const Vec3& way) {
        const float way_way = dot(way, way), side_side = dot(side, side), both = dot(way, side);
        const float on_way = dot(start, way), on_side = dot(start, side);
        float along = share_of(on_way * side_side - on_side * both, way_way * side_side - both * both);
        const float on_edge = share_of(along * both - on_side, side_side);
        along = share_of(on_edge * both + on_way, way_way);
        return way * along - (start + side * on_edge);
    }
    /// Returns by how much the segment is ahead of what reaches to `beyond` in a direction, of which all but the sense
    /// is open: no distance is shorter.
    static float gap_along(const Vec3& direction, float length, const Vec3& way, float beyond) {
        return length > 0.0f ? (minimum(dot(direction, way), 0.0f) - beyond) / length : 0.0f;
    }
};

}  // namespace espalier::detail
