// One triangle's field in the section of original ids.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>

namespace espalier::detail {

/// The first corner in its low bits, where the profile has one, and the id above it. Requires ids, and a triangle that
/// there is.
inline std::uint64_t id_field(const BlobData& blob, std::uint32_t triangle) {
    const unsigned width = format::first_corner_bits(blob.profile) + blob.id_bits;
    const std::uint64_t bit = std::uint64_t{triangle} * width;
    std::uint64_t window = 0;  // the field may begin in any bit of a byte: up to six bytes
    for (unsigned i = 0; i < (bit % 8 + width + 7) / 8; ++i)
        window |= std::uint64_t{load_u8(blob.ids + bit / 8 + i)} << (8 * i);
    return (window >> (bit % 8)) & ((std::uint64_t{1} << width) - 1);
}

}  // namespace espalier::detail
