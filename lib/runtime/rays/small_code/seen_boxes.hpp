// Rays against the boxes of a packed node on small cores: as seen along the ray (seen_ray.hpp).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <runtime/blob/node.hpp>
#include <runtime/rays/small_code/seen_ray.hpp>

namespace espalier::detail {

/// The planes of a node along an axis across, seen along a ray: in 2^-fine of a step, in which they are within 2^28.
struct SeenPlanes {
    const std::byte *near_planes, *far_planes;
    std::int32_t plane;            ///< from one to the next; negative where they count against the axis
    std::int32_t slope;            ///< what a plane ahead takes away
    std::int32_t to_near, to_far;  ///< plane 0, and more than all of what is seen can round
};

ESPALIER_BEGIN_MAYBE_UNINITIALIZED  // what is ahead comes first
/// Children of `among` whose boxes the ray may meet no farther than `last_ahead`. Apart from the walk: its room on the
/// stack is free again when a leaf is visited.
ESPALIER_NOINLINE inline unsigned seen_children(const SeenRay& ray, const PackedNode& packed, std::int32_t last_ahead,
                                                unsigned among) {
    using namespace format::packed_node;
    const std::byte* const node = packed.bytes;
    SeenPlanes across[2];
    // Ahead, along the ray: where plane 0 is along the axis, -1 and 255 where the ray runs down along it.
    std::int32_t base_ahead, down_ahead, flip;
    int ahead_shift;
    const std::byte *begins, *ends;
    for (unsigned i = 3; i-- != 0;) {
        const unsigned k = ray.axis[i];
        const std::int32_t down = ray.down(k);
        const int shift = static_cast<int>(load_u16(node + shifts_at) >> (5 * k) & 31u);
        // What is not of the asset, as only boxes that mean nothing are, may come out as anything.
        // mutant(+ -> - 1, + -> right side dropped 1) equivalent: the base is at 0
        const std::uint32_t base_units = load_u16(node + base_at + std::size_t{2} * k) << ray.base_shift;
        const std::int32_t base = static_cast<std::int32_t>(base_units) - ray.origin[k];
        const std::byte* const low_planes = node + 8 * k + lo_at;
        constexpr auto to_high = static_cast<std::int32_t>(hi_at - lo_at);
        const std::byte* const near_planes = low_planes + (down & to_high);
        const std::byte* const far_planes = low_planes + to_high - (down & to_high);
        if (i == 2) {
            base_ahead = base;
            down_ahead = down;
            ahead_shift = shift;
            flip = down & 255;
            begins = near_planes;
            ends = far_planes;
            continue;
        }
        // mutant(> -> >=) equivalent: both sides are equal then
        const int fine = 20 - (shift > ahead_shift ? shift : ahead_shift);
        const int finer = fine - ray.fraction_bits;
        // Planes that are much farther apart than the asset is large tell nothing.
        if (finer < 0) return SeenChildren<PackedNode>::pack(among, static_cast<unsigned>(std::countr_zero(among)));
        const std::int32_t seen = SeenRay::negated_if(down, ray.across(i, base, base_ahead));
        // Plane 0 is no more than 2^30 away from a box that is met.
        // mutant(>> -> one less 1) equivalent: differs only in the lowest bit, which is shifted out
        if ((seen ^ seen >> 31) >> (30 - finer) != 0) return 0;
        const std::int32_t plane_0 = seen * (1 << finer);
        SeenPlanes& planes = across[i];
        planes.near_planes = near_planes;
        planes.far_planes = far_planes;
        planes.plane = SeenRay::negated_if(down, 1 << (shift + fine));
        planes.slope =
            SeenRay::negated_if(down ^ down_ahead, ray.slope[i]) >> (SeenRay::slope_bits - fine - ahead_shift);
        const std::int32_t slack = SeenRay::off * (1 << finer) + 258;
        planes.to_near = plane_0 + planes.slope * flip - slack;
        planes.to_far = plane_0 + planes.slope * flip + slack;
    }
    const int scale = ahead_shift + ray.fraction_bits;
    const std::int32_t start = SeenRay::negated_if(down_ahead, base_ahead);
    const std::int32_t first = ((ray.first_ahead - start) >> scale) + flip;
    const std::int32_t last = ((last_ahead - start) >> scale) + flip;
    unsigned met = 0;
    unsigned nearest = ~0u;
    const auto plane = [](const std::byte* planes, unsigned child) {
        return static_cast<std::int32_t>(load_u8(planes + child));
    };
    for (unsigned child = 0; among >> child != 0; ++child) {
        if ((among >> child & 1u) == 0) continue;
        std::int32_t begin = plane(begins, child) ^ flip;
        if (begin > last) continue;
        const std::int32_t end = plane(ends, child) ^ flip;
        count_axes(2);
        for (const SeenPlanes& planes : across) {
            // The ray has passed the near plane when the box ends, and not yet the far one when it begins.
            const std::int32_t near = plane(planes.near_planes, child) * planes.plane + planes.to_near;
            if (near > end * planes.slope) goto missed;
            const std::int32_t far = plane(planes.far_planes, child) * planes.plane + planes.to_far;
            if (far < begin * planes.slope) goto missed;
            if (near > begin * planes.slope) begin = quotient_below<8>(near, planes.slope);
        }
        if (begin <= last && end >= first) {
            met |= 1u << child;
            // mutant(<< -> one more) equivalent: the order of keys and the three bits of the child stay
            const unsigned key = static_cast<unsigned>(begin) << 3 | child;
            // mutant(< -> <=) equivalent: no two keys are equal, since each contains its child
            nearest = key < nearest ? key : nearest;
        }
    missed:;
    }
    return SeenChildren<PackedNode>::pack(met, nearest & 7u);
}
ESPALIER_END_MAYBE_UNINITIALIZED

}  // namespace espalier::detail
