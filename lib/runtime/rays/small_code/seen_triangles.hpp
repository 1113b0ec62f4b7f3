// Which triangles of a leaf a ray may hit, on small cores: those that are not clearly beside it as seen along it
// (seen_ray.hpp).
#pragma once

#include <cstdint>
#if defined(__ARM_FEATURE_SIMD32)
#include <arm_acle.h>  // pairs of 16 bits in one instruction
#endif

#include <runtime/base/bits.hpp>
#include <runtime/blob/leaf_kinds.hpp>
#include <runtime/rays/small_code/seen_ray.hpp>

namespace espalier::detail {

/// Two signed numbers of 16 bits.
using SeenVertex = std::uint32_t;

/// x of p times y of q less y of p times x of q.
inline std::int32_t cross(SeenVertex p, SeenVertex q) {
#if defined(__ARM_FEATURE_SIMD32)
    return __smusdx(static_cast<std::int32_t>(p), static_cast<std::int32_t>(q));
#else
    const auto x = [](SeenVertex pair) { return std::int32_t{static_cast<std::int16_t>(pair)}; };
    const auto y = [](SeenVertex pair) { return static_cast<std::int32_t>(pair) >> 16; };
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x(p) * y(q)) - static_cast<std::uint32_t>(y(p) * x(q)));
#endif
}

/// How a ray looks at a leaf.
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
        const std::int32_t u = cross(b, c), v = cross(c, a), w = cross(a, b);
        return (u >= -error && v >= -error && w >= -error) || (u <= error && v <= error && w <= error);
    }
};

}  // namespace espalier::detail
