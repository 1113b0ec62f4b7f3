// Where a shape touches a triangle or is near it, in lattice steps: what the kernels of contacts return.
#pragma once

#include <espalier/types.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail::contacts {

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(const Vec3& a, float by) { return {a.x * by, a.y * by, a.z * by}; }
constexpr float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float largest(const Vec3& a) { return maximum(maximum(absolute(a.x), absolute(a.y)), absolute(a.z)); }

/// Returns the direction of a vector, or zero for zero. No square overflows or vanishes.
inline Vec3 direction_of(const Vec3& a) {
    const float size = largest(a);
    if (!(size > 0.0f)) return {};
    return to_unit(Vec3{a.x / size, a.y / size, a.z / size});
}
inline Vec3 direction_of(const WideVector& a) {
    return direction_of(Vec3{to_float(a.x), to_float(a.y), to_float(a.z)});
}
inline Vec3 direction_of(const Integer3& a) { return direction_of(Vec3{to_float(a.x), to_float(a.y), to_float(a.z)}); }

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

/// A closest or deepest place comes first.
struct Touches {
    static constexpr unsigned most = 8;
    Touch touch[most];
    unsigned count = 0;

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
};

/// Writes how a point touches the triangle, or is near it.
void touch_point(const RoundedPoint& point, const LatticeTriangle& triangle, Touches& touches);

/// Writes how a segment touches the triangle, or is near it: also where its ends are no farther than `reach`.
void touch_segment(const RoundedSegment& segment, const LatticeTriangle& triangle, float reach, Touches& touches);

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
void touch_box(const BoxBody& box, const LatticeTriangle& triangle, float reach, Touches& touches);

/// Returns the unit normal on the front of a triangle; of one without area any direction across it.
Vec3 front_of(const LatticeTriangle& triangle);

}  // namespace espalier::detail::contacts
