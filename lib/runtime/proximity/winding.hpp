// How often a closed surface winds around a rounded point, counted along an axis.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// One of the six ways along the axes.
struct AxisDirection {
    int axis;  ///< 0..2
    bool up;
};

/// A point in the asset's box, and a way to leave it.
struct WindingRay {
    std::int64_t origin[3];  ///< in units of 2^-fraction_bits lattice steps; at most 2^24 of them from any vertex
    int fraction_bits;
    AxisDirection direction;
};

struct Winding {
    std::int32_t number = 0;
    bool on_surface = false;  ///< then the number means nothing

    [[nodiscard]] bool is_inside() const { return on_surface || number != 0; }
};

/// What crossing the triangle adds: the side on which the ray leaves counts 1, the one on which it enters -1. Of the
/// triangles around an edge or a corner that the ray meets, those count that a ray beside it crosses, the same one for
/// all of them. The point must not lie on the triangle.
std::int32_t crossing(const WindingRay& ray, const LatticeTriangle& triangle) noexcept;

/// Whether the point lies in the asset's box; if so, the ray by the nearest of its sides.
bool shortest_way_out(const BlobData& blob, const RoundedPoint& point, WindingRay& ray) noexcept;

/// The answer depends on the point alone, not on the direction.
Winding winding_number(const BlobData& blob, const WindingRay& ray) noexcept;

/// How often the surface winds around a point of the local space; 0 outside the asset's box.
Winding winding_around(const BlobData& blob, const Vec3& point) noexcept;

}  // namespace espalier::detail
