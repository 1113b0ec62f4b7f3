// Rays against the boxes of a node on small cores: as seen along the ray (seen_ray.hpp). docs/numerics.md bounds what
// is rounded.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <runtime/base/bits.hpp>
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

/// A ray with what the boxes of plain nodes need. Their planes are coordinates, so that what a ray prepares once holds
/// for every node. Planes ahead count down from 65535 where the ray runs down along that
/// axis: it then passes them in ascending order.
struct SeenPlainRay : SeenRay {
    static constexpr int fine = 14;  ///< across, places are in 2^-fine of a plane

    /// Where a node has the planes of an axis that the ray passes first, and the others.
    struct Rows {
        std::uint8_t near_at, far_at;
    };
    struct RowsAcross : Rows {
        std::int16_t plane;    ///< from one to the next; negative where the ray runs down
        std::uint16_t slope;   ///< what a plane ahead takes away
        std::int32_t to_near;  ///< plane 0, less `slack`

        /// Returns where a plane is, modulo 2^32: within 2^31 where the ray meets anything.
        [[nodiscard]] std::int32_t place(const std::byte* at) const {
            return static_cast<std::int32_t>(load_u16(at) * static_cast<std::uint32_t>(plane) +
                                             static_cast<std::uint32_t>(to_near));
        }
    };

    RowsAcross across_rows[2];
    Rows ahead_rows;
    std::uint16_t flip;         ///< every bit where planes ahead count down
    std::int32_t origin_ahead;  ///< the ray's units from the first plane ahead
    std::int32_t slack;         ///< more than all that is rounded

    /// Returns false if the ray passes the lattice by.
    [[nodiscard]] bool prepare(const BlobData& blob) {
        const float inverse = look_ahead(blob);
        const std::int32_t down_ahead = down(axis[2]);
        flip = static_cast<std::uint16_t>(down_ahead);
        // A high plane stands for all places up to the next one's.
        const std::int32_t last_place = (1 << 16 << base_shift) - (1 << fraction_bits);
        origin_ahead = negated_if(down_ahead, origin[axis[2]]) + (down_ahead & last_place);
        const int finer = fine - base_shift;
        slack = (off << finer) + (4 << fine);
        for (unsigned i = 0;; ++i) {
            using namespace format::plain_node;
            constexpr auto to_high = static_cast<std::int32_t>(hi_at - lo_at);
            const unsigned k = axis[i];
            const std::int32_t is_down = down(k);
            const auto low_at = static_cast<std::int32_t>(row_bytes * k + lo_at);
            Rows& rows = i == 2 ? ahead_rows : across_rows[i];
            rows.near_at = static_cast<std::uint8_t>(low_at + (is_down & to_high));
            rows.far_at = static_cast<std::uint8_t>(low_at + (~is_down & to_high));
            if (i == 2) return true;
            look_across(i, inverse);
            const std::int32_t seen = negated_if(is_down, across(i, -origin[k], -origin[axis[2]]));
            // A plane that is met is within 2^17 planes of plane 0.
            if (((seen ^ seen >> 31) - 2 * off) >> (base_shift + 17) > 0) return false;
            constexpr int cut = slope_bits - fine;
            const std::int32_t rounded = (negated_if(is_down ^ down_ahead, slope[i]) + (1 << (cut - 1))) >> cut;
            RowsAcross& row = across_rows[i];
            row.plane = static_cast<std::int16_t>(negated_if(is_down, 1 << fine));
            row.slope = static_cast<std::uint16_t>(rounded);
            row.to_near = static_cast<std::int32_t>((static_cast<std::uint32_t>(seen) << finer) +
                                                    static_cast<std::uint32_t>(rounded * flip - slack));
        }
    }
};

/// Returns the children of `among` whose boxes the ray may meet no farther than `last_ahead`, as for a packed node.
ESPALIER_NOINLINE inline unsigned seen_children(const SeenPlainRay& ray, const PlainNode& node, std::int32_t last_ahead,
                                                unsigned among) {
    const std::int32_t first = (ray.first_ahead + ray.origin_ahead) >> ray.base_shift;
    const std::int32_t last = (last_ahead + ray.origin_ahead) >> ray.base_shift;
    unsigned met = 0;
    std::uint32_t nearest = ~std::uint32_t{0};
    const std::byte* rows = node.bytes;
    for (unsigned child = 1; child <= among; child <<= 1, rows += 2) {
        if ((among & child) == 0) continue;
        std::int32_t begin = static_cast<std::int32_t>(load_u16(rows + ray.ahead_rows.near_at) ^ ray.flip);
        if (begin > last) continue;
        const std::int32_t end = static_cast<std::int32_t>(load_u16(rows + ray.ahead_rows.far_at) ^ ray.flip);
        count_axes(2);
        for (const SeenPlainRay::RowsAcross& row : ray.across_rows) {
            // The ray has passed the near plane when the box ends, and not yet the far one when it begins.
            const std::int32_t near = row.place(rows + row.near_at);
            if (near > end * row.slope) goto missed;
            const std::int32_t passed = begin * row.slope;
            const std::int32_t far = row.place(rows + row.far_at);
            if (far < passed - 2 * ray.slack) goto missed;
            if (near > passed) begin = quotient_below<16>(near, row.slope);
        }
        if (begin <= last && end >= first) {
            met |= child;
            const std::uint32_t key = static_cast<std::uint32_t>(begin) << 16 | child;
            // mutant(< -> <=) equivalent: no two keys are equal, since each contains its child
            nearest = key < nearest ? key : nearest;
        }
    missed:;
    }
    return SeenChildren<PlainNode>::pack(met, static_cast<unsigned>(std::countr_zero(nearest)));
}

}  // namespace espalier::detail
