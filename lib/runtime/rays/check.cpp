// Rays that need no walk: those that are refused, and those that hit nothing.
#include <cstddef>
#include <cstdint>

#include <runtime/base/float_bits.hpp>
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
        __builtin_memcpy(&result, reinterpret_cast<const std::byte*>(&ray) + std::size_t{4} * i, sizeof result);
        return result;
    };
    std::uint32_t any_direction = 0;
    for (unsigned i = 0; i < 8; ++i) {  // origin, direction, window: its ends alone may be infinite
        const std::uint32_t magnitude = magnitude_bits(number(i));
        if (magnitude > infinity_bits - (i < 6 ? 1 : 0)) return QueryStatus::invalid_argument;
        if (i - 3 < 3) any_direction |= magnitude;
    }
    if (any_direction == 0) return QueryStatus::invalid_argument;
    for (unsigned k = 0; k < 3; ++k)
        if (magnitude_bits(to_steps(blob, static_cast<int>(k), number(k))) >= magnitude_bits(0x1p120f))
            return QueryStatus::out_of_range;
    return QueryStatus::not_found;
}

}  // namespace espalier::detail
