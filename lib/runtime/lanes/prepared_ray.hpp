// What the slab tests of all instruction sets share: a ray prepared once for all the nodes that it visits.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/lattice/round_ray.hpp>

namespace espalier::detail {

/// Which planes of a node a ray enters and leaves through, as offsets into the node: for each axis, by the direction's
/// sign.
struct alignas(8) PlaneOrder {
    std::uint8_t near_at[3];
    std::uint8_t far_at[3];
};
/// By the signs of the direction: bit k is set where axis k runs down.
constexpr std::array<PlaneOrder, 8> order_planes(std::size_t lo_at, std::size_t hi_at, std::size_t row_bytes) {
    std::array<PlaneOrder, 8> orders{};
    for (unsigned signs = 0; signs < 8; ++signs)
        for (unsigned k = 0; k < 3; ++k) {
            const bool down = (signs >> k & 1u) != 0;
            orders[signs].near_at[k] = static_cast<std::uint8_t>((down ? hi_at : lo_at) + row_bytes * k);
            orders[signs].far_at[k] = static_cast<std::uint8_t>((down ? lo_at : hi_at) + row_bytes * k);
        }
    return orders;
}
inline constexpr std::array<PlaneOrder, 8> packed_plane_orders =
    order_planes(format::packed_node::lo_at, format::packed_node::hi_at, format::packed_node::row_bytes);
inline constexpr std::array<PlaneOrder, 8> plain_plane_orders =
    order_planes(format::plain_node::lo_at, format::plain_node::hi_at, format::plain_node::row_bytes);

/// tau of a plane is (base + plane * 2^shift - origin) * inverse; here it is plane * (2^shift * inverse) + (base *
/// inverse + offset), with offsets that move the planes outward by more than all of it can round (docs/numerics.md):
/// then a box that contains the hit is never refused. Vectors have a fourth element that means nothing, where registers
/// load them.
struct RayLanes {
    static constexpr unsigned axes = small_code ? 3 : 4;

    alignas(register_alignment) float inverse[axes];
    alignas(register_alignment) float base_inverse[axes];  ///< the same for the units of a node's base or planes
    alignas(register_alignment) float near_offset[axes];
    alignas(register_alignment) float far_offset[axes];
    float tau_min;  ///< not -0
    PlaneOrder planes;

    static constexpr const std::array<PlaneOrder, 8>& plane_orders() { return packed_plane_orders; }
    /// How far boxes reach beyond their planes, in lattice steps.
    static float box_slack(const BlobData&) { return 0.0f; }
    /// Sets an axis but for its offsets.
    void set_inverse(const BlobData& blob, unsigned k, float of_step) {
        inverse[k] = of_step;
        base_inverse[k] = of_step * blob.base_unit;
    }
    /// Where coordinate 0 and the asset's other end are on an axis, but for the offsets.
    [[nodiscard]] static float low(unsigned) { return 0.0f; }
    [[nodiscard]] float high(const BlobData& blob, unsigned k) const { return blob.extent_steps[k] * inverse[k]; }
};
/// RayLanes for plain nodes, whose planes are coordinates: tau is plane * base_inverse + offset.
struct PlainRayLanes : RayLanes {
    static constexpr const std::array<PlaneOrder, 8>& plane_orders() { return plain_plane_orders; }
    /// High planes stand for all coordinates up to the next one's.
    static float box_slack(const BlobData& blob) { return blob.base_unit - 1.0f; }
};

template <class Lanes>
inline void spread_ray(const BlobData& blob, const LatticeRay& ray, const RaySlope& slope, Lanes& lanes) {
    const float slack_steps = slope.slack_steps + Lanes::box_slack(blob);
    unsigned signs = 0;
    for (unsigned k = 0; k < 3; ++k) {
        lanes.set_inverse(blob, k, slope.inverse[k]);
        const float middle = -origin_steps(ray, k) * slope.inverse[k] - lanes.low(k);
        const float slack = absolute(slope.inverse[k]) * slack_steps;
        lanes.near_offset[k] = middle - slack;
        lanes.far_offset[k] = middle + slack;
        signs |= (static_cast<std::uint32_t>(ray.direction[k]) >> 31) << k;
    }
    lanes.tau_min = ray.tau_min + 0.0f;
    lanes.planes = Lanes::plane_orders()[signs];
}

/// Whether the ray meets the asset's box, widened like the planes of a node.
template <class Lanes>
inline bool meets_asset(const BlobData& blob, const LatticeRay& ray, const Lanes& lanes) {
    float enter = ray.tau_min;
    float leave = infinity;
    for (unsigned k = 0; k < 3; ++k) {
        const float low = lanes.low(k), high = lanes.high(blob, k);
        enter = maximum(minimum(high, low) + lanes.near_offset[k], enter);
        leave = minimum(maximum(high, low) + lanes.far_offset[k], leave);
    }
    return enter <= leave;
}

/// What the slab tests of a kind of node need, where an instruction set has no way of its own.
template <class Node>
using RayLanesOf = std::conditional_t<std::is_same_v<Node, PlainNode>, PlainRayLanes, RayLanes>;

/// Completes a ray that is rounded. False when it can hit nothing.
template <class Lanes>
inline bool complete(const BlobData& blob, const RaySlope& slope, PreparedRayIn<Lanes>& prepared) {
    // mutant(< -> <=) sanitizer: reads behind an array; the fourth element is unused
    for (unsigned k = 0; k < 3; ++k) prepared.ray.zero[k] = -origin_steps(prepared.ray, k);
    spread_ray(blob, prepared.ray, slope, prepared.in_lanes);
    return meets_asset(blob, prepared.ray, prepared.in_lanes);
}

/// False when the ray can hit nothing.
template <class Lanes>
inline bool prepare_ray(const BlobData& blob, const Ray& ray, PreparedRayIn<Lanes>& prepared) {
    RaySlope slope;
    return round_ray(blob, ray, prepared.ray, slope) && complete(blob, slope, prepared);
}

/// Prepares a ray that was rounded before.
template <class Lanes>
inline bool prepare_ray(const BlobData& blob, const RayOnLattice& given, PreparedRayIn<Lanes>& prepared) {
    static_cast<IntegerRay&>(prepared.ray) = given.ray;
    float origin[3];
    for (unsigned k = 0; k < 3; ++k) origin[k] = origin_steps(given.ray, k);
    RaySlope slope;
    set_slope(prepared.ray, std::bit_cast<float>(lattice_ray::reach_bits(origin, blob)), slope);
    return complete(blob, slope, prepared);
}

}  // namespace espalier::detail
