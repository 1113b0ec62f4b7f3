// Where a shape touches a triangle or is near it, in lattice steps: what the kernels of contacts return.
#pragma once

#include <espalier/base/function_ref.hpp>
#include <espalier/types.hpp>
#include <runtime/asset/internal_edges.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/uninitialised.hpp>
#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail::contacts {

/// Returns the direction of a vector, or zero for zero. No square overflows or vanishes.
inline Vec3 direction_of(const Vec3& a) {
    const float size = largest(a);
    if (!(size > 0.0f)) return {};
    return to_unit(Vec3{a.x / size, a.y / size, a.z / size});
}
inline Vec3 direction_of(const WideVector& a) { return direction_of(to_vector(a)); }
inline Vec3 direction_of(const Integer3& a) { return direction_of(to_vector(a)); }

/// The prism over a triangle in a direction that is not in its plane: what is on the inner side of all its planes.
struct Prism {
    static constexpr unsigned plane_count = 5;
    Vec3 on_plane[plane_count];
    Vec3 inward[plane_count];  ///< perpendicular to the direction

    Prism(const Vec3* corner, const Vec3& way) {
        float longest = -1.0f;
        for (unsigned i = 0; i < 3; ++i) {
            const Vec3 &start = corner[i], &end = corner[i == 2 ? 0 : i + 1];
            const Vec3 side = end - start, across = side - way * dot(way, side), normal = cross(way, side);
            on_plane[i] = start;
            inward[i] = dot(normal, corner[i == 0 ? 2 : i - 1] - start) < 0.0f ? normal * -1.0f : normal;
            const float length = dot(across, across);
            if (length <= longest) continue;
            // Also the ends of the longest side: at a sharp corner the sides alone leave much room for rounding.
            longest = length;
            on_plane[3] = start;
            inward[3] = across;
            on_plane[4] = end;
            inward[4] = across * -1.0f;
        }
    }

    /// Cuts the part of a segment that lies within, from shares first to last. False if nothing is left.
    bool clip(const Vec3& from, const Vec3& along, float& first, float& last) const {
        for (unsigned i = 0; i < plane_count; ++i) {
            const float at_from = dot(inward[i], from - on_plane[i]), slope = dot(inward[i], along);
            if (slope > 0.0f) first = maximum(first, -at_from / slope);
            else if (slope < 0.0f) last = minimum(last, -at_from / slope);
            else if (at_from < 0.0f) return false;
        }
        return first <= last;
    }
};

/// A place of the triangle, and how far the shape is from it.
struct Touch {
    Vec3 point;      ///< on the triangle
    Vec3 normal;     ///< unit length, from the triangle to the shape
    float distance;  ///< along the normal; below 0 the depth
    Feature feature;
};

/// The side of a triangle's plane on which the middle of a body lies, and the features of the triangle that only join
/// it there with others of one surface.
struct FacingSide {
    bool is_back = false;
    InternalFeatures internal;
    /// Whether the surface that goes on at a valley has the middle on this side too. Empty: none goes on.
    FunctionRef<bool(Feature feature)> faces;
    /// Sets whether the middle is behind the surface that is nearest to it, if that faces the way of `face`. Returns
    /// false if that is open. Empty: there is no other surface.
    FunctionRef<bool(const Vec3& face, bool& is_behind)> find_nearest_side;
    float flat_cosine = 0.0f;  ///< of the largest angle that counts as flat

    /// The normal of a face on the side of its plane where the middle is.
    [[nodiscard]] Vec3 own_normal(const Vec3& face) const { return face * (is_back ? -1.0f : 1.0f); }
    /// Whether a normal leans farther from that of a face than a surface that is flat there can bend.
    [[nodiscard]] bool is_bent(const Vec3& normal, const Vec3& face) const {
        return absolute(dot(normal, face)) < flat_cosine - 0x1p-18f;
    }
    [[nodiscard]] bool is_internal(Feature feature) const { return internal.have(feature, is_back); }
    [[nodiscard]] bool is_flat(Feature feature) const {
        return internal.have(feature, false) && internal.have(feature, true);
    }
    /// Sets whether the middle is behind the surface; returns false if that is open. At a flat feature the plane of one
    /// triangle does not decide it: it leads far beyond, over a plank that lies on the other slope of a ridge.
    bool finds_side(Feature feature, const Vec3& face, bool& is_behind) const {
        is_behind = is_back;
        return !find_nearest_side || !is_flat(feature) || find_nearest_side(face, is_behind);
    }
    /// Whether a place may keep its normal: it is on no internal feature, has the normal of the face, or belongs to a
    /// valley whose other slope has the middle behind it.
    [[nodiscard]] bool keeps(Feature feature, const Vec3& normal, const Vec3& face) const {
        if (!is_internal(feature)) return true;
        if (dot(own_normal(face), normal) > 1.0f - 0x1p-20f) return true;
        return faces && !is_flat(feature) && !faces(feature);
    }
};

/// Returns the normal of a face on one side or, where that would lead the middle back, the direction nearest to it that
/// does not. Of a middle straight behind the face none is nearest: what is left of the normal is rounding.
inline Vec3 outward_from(const Vec3& face, bool is_back, const Vec3& to_middle, float rounding, bool& is_turned) {
    const Vec3 outward = is_back ? face * -1.0f : face;
    const float level = dot(outward, to_middle);
    Vec3 turned;
    if (level < -rounding) turned = outward - to_middle * (level / dot(to_middle, to_middle));
    is_turned = largest(turned) > 0x1p-10f;
    return is_turned ? direction_of(turned) : outward;
}

/// A closest or deepest place comes first. If it is on an internal feature, or the way out of it led the body's middle
/// through the triangle, its normal is that of the facing side.
struct Touches {
    static constexpr unsigned most = 8;
    Uninitialised<Touch, most> touch;
    unsigned count = 0;
    float nearest = 0.0f;    ///< the distance of body and triangle, or minus the length of the shortest way out
    bool is_beside = false;  ///< the first place is on an internal feature, and the body is not over the triangle

    /// Adds a place on the face unless it is nearer than `apart` to one before it.
    void add(const Vec3& point, const Vec3& normal, float distance, float apart) {
        if (count == most) return;
        for (unsigned i = 0; i < count; ++i) {
            const Vec3 between = point - touch[i].point;
            if (dot(between, between) <= apart * apart) return;
        }
        touch[count++] = {point, normal, distance, Feature::face};
    }
};

/// The direction that separates most, from the triangle to the shape, and the gap along it: below 0 the least depth.
struct Separation {
    Vec3 normal;
    float gap = -infinity;

    [[nodiscard]] bool rules_out(float of_way) const { return of_way <= gap; }
    void offer(const Vec3& way, float of_way) {
        if (!rules_out(of_way)) *this = {way, of_way};
    }
};

/// Writes how a point touches the triangle, or is near it.
void touch_point(const RoundedPoint& point, const LatticeTriangle& triangle, const FacingSide& side, Touches& touches);

/// Writes the first of these places for a segment that is so far from the triangle.
void touch_nearest(const RoundedSegment& segment, const LatticeTriangle& triangle, const SegmentDistance& distance,
                   const FacingSide& side, Touches& touches);

/// Writes how a segment touches the triangle, or is near it: also where its ends are no farther than `reach`.
void touch_segment(const RoundedSegment& segment, const LatticeTriangle& triangle, const FacingSide& side, float reach,
                   Touches& touches);

/// A box of any orientation, its center an integer point.
struct BoxBody {
    Integer3 center;  ///< in units of 2^-fraction_bits steps
    int fraction_bits;
    Integer3 units[3];  ///< half axes
    Vec3 half[3];       ///< the same in lattice steps
    Vec3 face[3];       ///< unit normals of the faces; zero where the other two half axes are parallel
    float size;         ///< no part is farther from the center
};

/// Writes how a box touches the triangle, or is no farther away than `reach`; nothing if it is farther.
void touch_box(const BoxBody& box, const LatticeTriangle& triangle, const FacingSide& side, float reach,
               Touches& touches);

/// Returns the unit normal on the front of a triangle; of one without area any direction across it.
Vec3 front_of(const LatticeTriangle& triangle);

/// The corners of what two triangles have in common, and the shortest way out, in steps of the grid.
struct TrianglesTouch {
    static constexpr unsigned most = 6;

    Vec3 point[most];
    unsigned count = 0;
    Vec3 normal;         ///< unit length, along which b leaves a
    float depth = 0.0f;  ///< how far it has to go

    void add(const Vec3& at) {
        if (count != most) point[count++] = at;
    }
};

/// Finds where two triangles touch: no point if they do not. Their coordinates are below 2^25.
void touch_triangles(const LatticeTriangle& a, const LatticeTriangle& b, TrianglesTouch& touch) noexcept;

}  // namespace espalier::detail::contacts
