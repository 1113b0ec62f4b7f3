// Boxes and vertices seen along a ray, for small cores: in integers alone. Coordinates count from the
// ray's origin in its own units. "Ahead" is the axis with the longest component of its direction, the other two are
// "across". A place is seen across at its coordinate less slope times its coordinate ahead: the ray stays at 0, and
// what it meets must lie around 0. docs/numerics.md bounds what is rounded.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/node.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/lattice/round_ray.hpp>

namespace espalier::detail {

/// A ray, and how it looks at the lattice. The axis ahead is axis[2].
struct SeenRay : IntegerRay {
    static constexpr int slope_bits = 30;
    /// By how many units at most what is seen is off its place.
    static constexpr std::int32_t off = 4;

    std::int32_t slope[2];     ///< along axis[0] and axis[1] for each unit along axis[2], in 2^-slope_bits, towards 0
    std::int32_t first_ahead;  ///< nothing before that is hit
    int base_shift;            ///< from a node's base to the ray's units
    float ahead_per_tau;

    /// Prepares the ray for packed nodes and for leaves. Returns true: no ray is refused.
    bool prepare(const BlobData& blob) {
        const float inverse = look_ahead(blob);
        // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
        for (unsigned i = 0; i < 2; ++i) look_across(i, inverse);
        return true;
    }
    /// Prepares all but the slopes. Returns the inverse of the direction ahead.
    float look_ahead(const BlobData& blob) {
        const auto forth = static_cast<float>(direction[axis[2]]);
        ahead_per_tau = absolute(forth) * power_of_two(fraction_bits);
        first_ahead = ahead_at(tau_min) - off;
        base_shift = fraction_bits + static_cast<int>(format::unit_shift(blob.bits));
        return 1.0f / forth;
    }
    /// Sets the slope along axis[i].
    void look_across(unsigned i, float inverse) {
        slope[i] =
            static_cast<std::int32_t>(static_cast<float>(direction[axis[i]]) * inverse * power_of_two(slope_bits));
    }
    /// -1 for an axis that the ray runs down along, 0 for another one.
    // mutant(>> -> one less) equivalent: directions are below 2^25, so bit 30 equals the sign
    [[nodiscard]] std::int32_t down(unsigned k) const { return direction[k] >> 31; }
    /// For -1 and 0.
    static std::int32_t negated_if(std::int32_t down, std::int32_t number) {
        return static_cast<std::int32_t>((static_cast<std::uint32_t>(number) ^ static_cast<std::uint32_t>(down)) -
                                         static_cast<std::uint32_t>(down));
    }
    /// Where a place along axis[i] is seen across, which is `forth` along axis[2]; all from the origin. The product of
    /// slope and 4 * forth has what is wanted in its high word.
    [[nodiscard]] std::int32_t across(unsigned i, std::int32_t place, std::int32_t forth) const {
        static_assert(slope_bits == 30);
        const auto scaled = static_cast<std::int32_t>(static_cast<std::uint32_t>(forth) << 2);
        const auto away = static_cast<std::uint32_t>((std::int64_t{slope[i]} * scaled) >> 32);
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(place) - away);
    }
    /// How far ahead the ray is at tau, give or take `off`. Nothing on the lattice is 2^26 ahead.
    [[nodiscard]] ESPALIER_NOINLINE std::int32_t ahead_at(float tau) const {
        const float ahead = tau * ahead_per_tau;
        // mutant(< -> <=) equivalent: both sides are equal then
        return ahead < 0x1p26f ? static_cast<std::int32_t>(ahead) : 1 << 26;
    }
    /// Nothing of interest is farther ahead, when nothing is after tau.
    [[nodiscard]] std::int32_t last_ahead(float tau) const { return ahead_at(tau) + off; }
};

/// Returns a / b, which is below 2^bits, for numbers above 0.
template <unsigned bits>
constexpr std::int32_t quotient_by_bits(std::int32_t a, std::int32_t b) {
    std::int32_t quotient = 0;
    for (unsigned bit = bits; bit-- != 0;) {
        if (a >> bit < b) continue;
        a -= b << bit;
        quotient |= 1 << bit;
    }
    return quotient;
}
/// Returns the same quotient, by a division instruction where the core has one: the compiler's function takes 460
/// bytes.
template <unsigned bits>
constexpr std::int32_t quotient_below(std::int32_t a, std::int32_t b) {
#if defined(__ARM_ARCH_PROFILE) && !defined(__ARM_FEATURE_IDIV)
    return quotient_by_bits<bits>(a, b);
#else
    return a / b;
#endif
}

/// Children of a node, a bit each, and above them the number of the one that the ray can be in first.
template <class Node>
struct SeenChildren {
    static unsigned pack(unsigned children, unsigned nearest) { return nearest << Node::max_children | children; }
    static unsigned children(unsigned packed) { return packed & every_child_of<Node>; }
    static unsigned nearest(unsigned packed) { return packed >> Node::max_children; }
};

/// Two signed numbers of 16 bits.
using SeenVertex = std::uint32_t;

/// How a ray looks at a leaf: which of its triangles it may hit are those that are not clearly beside it.
struct SeenLeaf {
    int finer;           ///< a unit of the ray's is 2^finer of those in which the leaf measures 2^29 at most
    std::int32_t error;  ///< of the edge functions of a triangle that is hit

    /// For a leaf that measures 2^size_bits of the ray's units: 2^29 at most, as all do that a ray has to do with.
    explicit SeenLeaf(int size_bits) {
        // mutant(< -> <=, > -> >=) equivalent: both sides are equal then
        const int bits = size_bits < 4 ? 4 : size_bits > 29 ? 29 : size_bits;
        finer = 29 - bits;
        // What one coordinate of a triangle that is hit is off by: it is within 2^14 of those that are kept.
        const std::int32_t off = 1 + ((1 << 15) >> bits);
        error = off * ((1 << 16) + 6 * off);
    }
    /// A vertex, from the ray's origin: across and ahead.
    [[nodiscard]] SeenVertex vertex(const SeenRay& ray, std::int32_t x, std::int32_t y, std::int32_t ahead) const {
        constexpr std::uint32_t half = 1u << 15;  // of what is cut off
        const std::uint32_t seen_x = (static_cast<std::uint32_t>(ray.across(0, x, ahead)) << finer) + half;
        const std::uint32_t seen_y = (static_cast<std::uint32_t>(ray.across(1, y, ahead)) << finer) + half;
        return seen_x >> 16 | (seen_y & 0xFFFF0000u);
    }
    /// Whether a triangle with these corners may be hit.
    [[nodiscard]] bool allows(SeenVertex a, SeenVertex b, SeenVertex c) const {
        const std::int32_t u = scalar::cross_pairs(b, c), v = scalar::cross_pairs(c, a), w = scalar::cross_pairs(a, b);
        return (u >= -error && v >= -error && w >= -error) || (u <= error && v <= error && w <= error);
    }
};

}  // namespace espalier::detail
