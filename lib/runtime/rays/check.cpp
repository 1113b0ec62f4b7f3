// Rays that need no walk: those that are refused, and those that hit nothing.
#include <bit>
#include <cstddef>
#include <cstdint>

#include <runtime/base/bits.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/rays/queries.hpp>

namespace espalier::detail {

QueryStatus status_without_walk(const BlobData& blob, const Ray& ray) {
    return blob.bytes == nullptr ? QueryStatus::not_open : refusal_or_miss(blob, ray);
}

QueryStatus refusal_or_miss(const BlobData& blob, const Ray& ray) {
    static_assert(offsetof(Ray, direction) == 12 && offsetof(Ray, t_min) == 24 && offsetof(Ray, culling) == 32);
    const auto number = [&](unsigned i) {
        float result;
        ESPALIER_COPY_BYTES(&result, reinterpret_cast<const std::byte*>(&ray) + std::size_t{4} * i, sizeof result);
        return result;
    };
    // Twice the magnitude's bits: the sign is shifted out.
    const auto magnitude = [&](unsigned i) { return std::bit_cast<std::uint32_t>(number(i)) << 1; };
    constexpr std::uint32_t infinite = infinity_bits << 1;
    std::uint32_t any_direction = 0;
    for (unsigned i = 0; i < 6; ++i) {  // the origin, then the direction
        if (magnitude(i) >= infinite) return QueryStatus::invalid_argument;
        if (i >= 3) any_direction |= magnitude(i);
    }
    if (any_direction == 0 || magnitude(6) > infinite || magnitude(7) > infinite) return QueryStatus::invalid_argument;
    for (unsigned k = 0; k < 3; ++k)
        if (magnitude_bits(to_steps(blob, static_cast<int>(k), number(k))) >= magnitude_bits(0x1p120f))
            return QueryStatus::out_of_range;
    return QueryStatus::not_found;
}

}  // namespace espalier::detail
