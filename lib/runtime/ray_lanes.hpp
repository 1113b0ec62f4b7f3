// What the slab tests of all instruction sets share: a ray prepared once for all the nodes that it visits.
#pragma once

#include <array>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>
#include <runtime/as_if_changed.hpp>
#include <runtime/lattice_ray.hpp>

namespace espalier::detail {

/// Which planes of a node a ray enters and leaves through, as offsets into the node: for each axis, by the direction's
/// sign.
struct alignas(8) PlaneOrder {
    std::uint8_t near_at[3];
    std::uint8_t far_at[3];
};
/// By the signs of the direction: bit k is set where axis k runs down.
inline constexpr std::array<PlaneOrder, 8> plane_orders = [] {
    using namespace format::node;
    // mutant(< -> <= 1) compiler: writes behind a table at compile time, which is an error
    std::array<PlaneOrder, 8> orders{};
    for (unsigned signs = 0; signs < 8; ++signs)
        for (unsigned k = 0; k < 3; ++k) {
            const bool down = (signs >> k & 1u) != 0;
            orders[signs].near_at[k] = static_cast<std::uint8_t>((down ? hi_at : lo_at) + 8 * k);
            orders[signs].far_at[k] = static_cast<std::uint8_t>((down ? lo_at : hi_at) + 8 * k);
        }
    return orders;
}();

/// tau of a plane is (base + plane * 2^shift - origin) * inverse; here it is plane * (2^shift * inverse) + (base *
/// inverse + offset), with offsets that move the planes outward by more than all of it can round (docs/numerics.md):
/// then a box that contains the hit is never refused. Vectors have a fourth element that means nothing.
struct RayLanes {
    alignas(16) float inverse[4];
    alignas(16) float base_inverse[4];  ///< the same for the units that a node's base counts in
    alignas(16) float near_offset[4];
    alignas(16) float far_offset[4];
    float tau_min;
    const PlaneOrder* planes;
};

inline void spread_ray(const BlobData& blob, const LatticeRay& ray, const RaySlope& slope, RayLanes& lanes) {
    unsigned signs = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const float middle = -origin_steps(ray, k) * slope.inverse[k];
        const float slack = absolute(slope.inverse[k]) * slope.slack_steps;
        lanes.inverse[k] = slope.inverse[k];
        lanes.base_inverse[k] = slope.inverse[k] * blob.base_unit;
        lanes.near_offset[k] = middle - slack;
        lanes.far_offset[k] = middle + slack;
        signs |= (static_cast<std::uint32_t>(ray.direction[k]) >> 31) << k;
    }
    lanes.tau_min = ray.tau_min;
    lanes.planes = &plane_orders[signs];
}

/// Whether the ray meets the asset's box, widened like the planes of a node.
inline bool meets_asset(const BlobData& blob, const LatticeRay& ray, const RayLanes& lanes) {
    float enter = ray.tau_min;
    float leave = infinity;
    for (unsigned k = 0; k < 3; ++k) {
        const float span = blob.extent_steps[k] * lanes.inverse[k];
        enter = maximum(minimum(span, 0.0f) + lanes.near_offset[k], enter);
        leave = minimum(maximum(span, 0.0f) + lanes.far_offset[k], leave);
    }
    return enter <= leave;
}

/// All that the queries need of a ray; `Lanes` are what the slab test needs.
template <class Lanes>
struct PreparedRayIn {
    LatticeRay ray;
    Lanes in_lanes;

    [[nodiscard]] const Lanes& lanes() const { return in_lanes; }
};
using PreparedRay = PreparedRayIn<RayLanes>;

/// False when the ray can hit nothing.
template <class Lanes>
inline bool prepare_ray(const BlobData& blob, const Ray& world, PreparedRayIn<Lanes>& prepared) {
    RaySlope slope;
    if (!round_ray(blob, world, prepared.ray, slope)) return false;
    spread_ray(blob, prepared.ray, slope, prepared.in_lanes);
    return meets_asset(blob, prepared.ray, prepared.in_lanes);
}

/// The same for a ray that was rounded before.
template <class Lanes>
inline bool prepare_ray(const BlobData& blob, const RayOnLattice& given, PreparedRayIn<Lanes>& prepared) {
    static_cast<IntegerRay&>(prepared.ray) = given.ray;
    float origin[3];
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (unsigned k = 0; k < 3; ++k) origin[k] = origin_steps(given.ray, k);
    RaySlope slope;
    set_slope(prepared.ray, std::bit_cast<float>(lattice_ray::reach_bits(origin, blob)), slope);
    spread_ray(blob, prepared.ray, slope, prepared.in_lanes);
    return meets_asset(blob, prepared.ray, prepared.in_lanes);
}

}  // namespace espalier::detail
