// Boxes and vertices as a ray on a small core sees them: along itself, in integers alone. Coordinates are turned so
// that the ray runs up along each axis. "Ahead" is the axis with the longest component of its direction, the other two
// are "across". A place is seen across at its coordinate less slope times how far ahead it is: the ray stays at 0, and
// what it meets must lie around 0. docs/numerics.md bounds what is rounded.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/lattice_ray.hpp>

namespace espalier::detail {

/// What a ray sees along an axis.
struct SeenAxis {
    std::int32_t base_step;  ///< of the units that a node's base counts in, negative where the ray runs down
    std::int32_t start;      ///< the origin, turned
    std::int32_t slope;      ///< steps across for each step ahead, in 2^-28, rounded down; none for the axis ahead
    std::uint8_t axis;
    std::uint8_t near_at, far_at;  ///< planes in a node

    [[nodiscard]] bool runs_down() const { return base_step < 0; }
    /// A node's base from the ray's origin. What is not of the asset, as only boxes that mean nothing are, may come out
    /// as anything.
    [[nodiscard]] std::int32_t base(const std::byte* node) const {
        return static_cast<std::int32_t>(load_u16(node + format::node::base_at + std::size_t{2} * axis) *
                                             static_cast<std::uint32_t>(base_step) -
                                         static_cast<std::uint32_t>(start));
    }
    /// What is seen across of a place, in its own units.
    [[nodiscard]] std::int32_t across(std::int32_t place, std::int32_t ahead) const {
        const auto away = static_cast<std::uint32_t>((std::int64_t{slope} * ahead) >> slope_bits);
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(place) - away);
    }
    static constexpr int slope_bits = 28;
};

/// A ray, and how it looks at the lattice.
struct SeenRay : LatticeRay {
    /// Boxes are seen in units of 2^-3 of a step, whatever the ray's own are.
    static constexpr int box_bits = 3;

    SeenAxis seen[3];  ///< two across, the last one ahead
    float ahead_per_tau;
    std::int32_t first_ahead;  ///< nothing before that is hit
    std::int32_t off;          ///< by how many units at most what is seen is off its place

    void look_ahead(const BlobData& blob) {
        const int base_bits = box_bits + (blob.bits > 16 ? blob.bits - 16 : 0);
        for (unsigned i = 0; i < 3; ++i) {
            SeenAxis& each = seen[i];
            const unsigned k = axis[i];
            const std::int32_t down = direction[k] >> 31;  // -1 or 0
            const int cut = fraction_bits - box_bits;
            const std::int32_t start = cut > 0 ? (origin[k] + (1 << cut >> 1)) >> cut : origin[k] * (1 << -cut);
            each.axis = static_cast<std::uint8_t>(k);
            each.base_step = ((1 << base_bits) ^ down) - down;
            each.start = (start ^ down) - down;
            const unsigned low = format::node::lo_at + 8 * k, high = format::node::hi_at + 8 * k;
            each.near_at = static_cast<std::uint8_t>(down != 0 ? high : low);
            each.far_at = static_cast<std::uint8_t>(low + high - each.near_at);
            each.slope = static_cast<std::int32_t>(absolute(shear[i & 1u]) * power_of_two(SeenAxis::slope_bits));
        }
        ahead_per_tau = absolute(static_cast<float>(direction[axis[2]])) * power_of_two(box_bits);
        off = 4 + (18 >> fraction_bits);
        first_ahead = ahead_at(tau_min) - off;
    }
    /// How far ahead the ray is at tau, give or take `off`. Nothing on the lattice is 2^28 ahead.
    [[nodiscard]] std::int32_t ahead_at(float tau) const {
        const float ahead = tau * ahead_per_tau;
        return ahead < 0x1p28f ? static_cast<std::int32_t>(ahead) : 1 << 28;
    }
};

}  // namespace espalier::detail
