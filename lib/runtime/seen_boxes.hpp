// Rays against the boxes of a node on small cores: as seen along the ray (seen_ray.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include <runtime/codec_node.hpp>
#include <runtime/seen_ray.hpp>

namespace espalier::detail {

/// Where each child's box begins and ends ahead, in planes, counted along the ray. Where it begins becomes where the
/// ray can be inside at first.
struct AheadPlanes {
    std::uint8_t begin[format::max_children];
    std::uint8_t end[format::max_children];
};

/// A node, as a ray looks at it.
struct SeenNode {
    const std::byte* bytes;
    std::uint32_t shifts;
    int fine;            ///< in 2^-fine of a step the planes lie within 2^28
    int slope_drop;      ///< from a slope to what a plane ahead takes away, in the same units
    std::int32_t slack;  ///< more than all of what is seen across can round
    std::int32_t start;  ///< plane 0 ahead
    std::int32_t flip;   ///< 255 where planes count against the axis
    std::int32_t last;   ///< the plane beyond which nothing is asked for

    [[nodiscard]] int shift(const SeenAxis& axis) const { return static_cast<int>(shifts >> (5u * axis.axis) & 31u); }
};

/// Children of `mask` whose boxes the ray meets as seen across one axis.
[[gnu::noinline]] inline unsigned seen_across(const SeenNode& node, const SeenAxis& axis, unsigned mask,
                                              AheadPlanes& ahead) {
    const std::int32_t seen = axis.across(axis.base(node.bytes), node.start);
    // Plane 0 is no more than 2^30 away from a box that is met.
    const int finer = node.fine - SeenRay::box_bits;
    if ((static_cast<std::uint32_t>(seen) + (1u << (30 - finer))) >> (31 - finer) != 0) return 0;
    const std::int32_t slope = axis.slope >> node.slope_drop;
    const std::int32_t plane_0 = seen * (1 << finer) + slope * node.flip;
    const std::int32_t to_near = plane_0 - node.slack, to_far = plane_0 + node.slack;
    std::int32_t plane = 1 << (node.shift(axis) + node.fine);
    if (axis.runs_down()) plane = -plane;
    const std::byte* near_planes = node.bytes + axis.near_at;
    const std::byte* far_planes = node.bytes + axis.far_at;
    unsigned met = 0;
    for (unsigned child = 0; mask >> child != 0; ++child) {
        if ((mask >> child & 1u) == 0) continue;
        // The ray has passed the near plane when the box ends, and not yet the far one when it begins.
        const std::int32_t near = static_cast<std::int32_t>(load_u8(near_planes + child)) * plane + to_near;
        if (near > ahead.end[child] * slope) continue;
        const std::int32_t far = static_cast<std::int32_t>(load_u8(far_planes + child)) * plane + to_far;
        const std::int32_t begin = ahead.begin[child] * slope;
        if (far < begin) continue;
        if (near > begin) {
            const std::int32_t later = near / slope;
            if (later > node.last) continue;
            ahead.begin[child] = static_cast<std::uint8_t>(later);
        }
        met |= 1u << child;
    }
    return met;
}

/// Children of `among` whose boxes the ray may meet before `limit`. Apart from the walk: its room on the stack is free
/// again when a leaf is visited.
[[gnu::noinline]] inline unsigned seen_children(const SeenRay& ray, const std::byte* bytes, float limit, unsigned among,
                                                AheadPlanes& ahead) {
    const SeenAxis& forth = ray.seen[2];
    SeenNode node;
    node.bytes = bytes;
    node.shifts = load_u16(bytes + format::node::shifts_at);
    node.start = forth.base(bytes);
    node.flip = forth.runs_down() ? 255 : 0;
    const int scale = node.shift(forth) + SeenRay::box_bits;
    const std::int32_t first = ((ray.first_ahead - node.start) >> scale) + node.flip;
    node.last = ((ray.ahead_at(limit) + ray.off - node.start) >> scale) + node.flip;
    const std::byte* begins = bytes + forth.near_at;
    const std::byte* ends = bytes + forth.far_at;
    unsigned mask = 0;
    for (unsigned child = 0; among >> child != 0; ++child) {
        if ((among >> child & 1u) == 0) continue;
        const auto begin = static_cast<std::int32_t>(load_u8(begins + child)) ^ node.flip;
        const auto end = static_cast<std::int32_t>(load_u8(ends + child)) ^ node.flip;
        ahead.begin[child] = static_cast<std::uint8_t>(begin);
        ahead.end[child] = static_cast<std::uint8_t>(end);
        if (begin <= node.last && end >= first) mask |= 1u << child;
    }
    if (mask == 0) return 0;
    node.fine = 20 - node.shift(forth);
    for (unsigned i = 0; i < 2; ++i)
        if (20 - node.shift(ray.seen[i]) < node.fine) node.fine = 20 - node.shift(ray.seen[i]);
    node.slope_drop = SeenAxis::slope_bits - node.fine - node.shift(forth);
    node.slack = ray.off * (1 << (node.fine - SeenRay::box_bits)) + 258;
    mask = seen_across(node, ray.seen[0], mask, ahead);
    return mask == 0 ? 0 : seen_across(node, ray.seen[1], mask, ahead);
}

}  // namespace espalier::detail
