// The shapes of the caller, rounded onto the lattice: how each is kept, and the kernel that decides whether a triangle
// shares a point with it, exactly. The file of each shape has both; that of cones has their structure too.
#pragma once

#include <cstdint>

#include <espalier/advanced/lattice.hpp>
#include <espalier/shapes.hpp>
#include <runtime/traversal/volume.hpp>
#include <runtime/proximity/queries.hpp>

namespace espalier::detail {

/// An axis-aligned box, in units of 2^-7 steps: sums and differences of coordinates that are multiples of 2^-6. The
/// kernel tries thirteen possible separating axes, in integers (Akenine-Möller 2001 has them for floats).
template <>
struct Rounded<Box> : VolumeOf<Box, 0> {
    static constexpr int fraction_bits = 7;

    std::int64_t center[3];
    std::int64_t half[3];  ///< >= 0
};
QueryStatus round_volume(const BlobData& blob, const Box& local, Rounded<Box>& box) noexcept;
[[nodiscard]] bool meets(const Rounded<Box>& box, const LatticeTriangle& triangle) noexcept;

template <>
struct Rounded<LatticeBox> : Rounded<Box> {};
/// Moves the box onto the grid, which rounds nothing.
QueryStatus round_volume(const BlobData& blob, const LatticeBox& steps, Rounded<Box>& box) noexcept;

/// A capsule by its axis; what is within its radius overlaps it (kernels/segment_triangle.hpp).
template <>
struct Rounded<Capsule> : DistantSegment {};
QueryStatus round_volume(const BlobData& blob, const Capsule& local, Rounded<Capsule>& capsule) noexcept;

/// A convex set of half-spaces, bounded or not: normals whose largest coordinate is in [2^23, 2^24]; offsets within
/// 2^52.
template <>
struct Rounded<ConvexVolume> : VolumeOf<ConvexVolume, max_planes> {};
QueryStatus round_volume(const BlobData& blob, const ConvexVolume& local, Rounded<ConvexVolume>& set) noexcept;
[[nodiscard]] bool meets(const Rounded<ConvexVolume>& set, const LatticeTriangle& triangle) noexcept;

/// A box of any orientation, sheared and flat ones too: all points center + a * half[0] + b * half[1] + c * half[2]
/// with a, b, c in [-1, 1]. The kernel tries separating axes in integers (Gottschalk, Lin and Manocha 1996), completed
/// for shapes without volume (docs/numerics.md).
template <>
struct Rounded<OrientedBox> : VolumeOf<OrientedBox, small_code ? 6 : 0> {
    int fraction_bits;  ///< 0..6; what follows is in units of 2^-fraction_bits steps
    Integer3 center;
    Integer3 half[3];
    bool is_near;  ///< center and half axes stay below 2^23, seen from any vertex of the asset and added up
    float center_steps[4], half_steps[3][4];  ///< the same in lattice steps, exactly; the fourth numbers are zero

    WideVector face[3];  ///< normals of the faces: products of two half axes
    Int128 face_reach;   ///< how far each face is along its normal; zero for a flat box
};
/// Rounds all but the faces, and add_faces() those; round_volume() does both and, in small code, adds planes.
QueryStatus round_half_axes(const BlobData& blob, const OrientedBox& local, Rounded<OrientedBox>& box) noexcept;
void add_faces(Rounded<OrientedBox>& box) noexcept;
QueryStatus round_volume(const BlobData& blob, const OrientedBox& local, Rounded<OrientedBox>& box) noexcept;
[[nodiscard]] bool meets(const Rounded<OrientedBox>& box, const LatticeTriangle& triangle) noexcept;

/// A box in float, in lattice steps.
struct FloatOrientedBox {
    const Rounded<OrientedBox>& rounded;
    float normal[3][3];  ///< across two of the half axes each
    float face = 0.0f;   ///< how far each face is along its normal
    float size = 0.0f;   ///< at least the sum of the lengths of the half axes
    float spread[3];     ///< how far it reaches along each axis of space

    explicit FloatOrientedBox(const Rounded<OrientedBox>& box) : rounded(box) {
        const auto& half = box.half_steps;
        for (int i = 0; i < 3; ++i) {
            const float* const a = half[i == 2 ? 0 : i + 1];
            const float* const b = half[i == 0 ? 2 : i - 1];
            for (int k = 0; k < 3; ++k) {
                const int y = k == 2 ? 0 : k + 1, z = k == 0 ? 2 : k - 1;
                normal[i][k] = a[y] * b[z] - a[z] * b[y];
            }
        }
        for (int k = 0; k < 3; ++k) {
            face += normal[0][k] * half[0][k];
            spread[k] = absolute(half[0][k]) + absolute(half[1][k]) + absolute(half[2][k]);
            size += spread[k];
        }
        face = absolute(face);
    }
};

/// A triangle, also one without area.
template <>
struct Rounded<Triangle> : VolumeOf<Triangle, 5> {
    int fraction_bits;         ///< 0..6
    IntegerTriangle triangle;  ///< in units of 2^-fraction_bits steps
};
QueryStatus round_volume(const BlobData& blob, const Triangle& local, Rounded<Triangle>& corners) noexcept;
[[nodiscard]] bool meets(const Rounded<Triangle>& corners, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
