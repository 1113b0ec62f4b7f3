// Numbers of the format, written to any address.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/base/compiler.hpp>

namespace espalier::detail {

inline void store_u8(std::byte* at, std::uint32_t value) { *at = static_cast<std::byte>(value); }
inline void store_u16(std::byte* at, std::uint32_t value) {
    if constexpr (std::endian::native == std::endian::little) {
        const auto word = static_cast<std::uint16_t>(value);
        ESPALIER_COPY_BYTES(at, &word, sizeof word);
    } else {
        store_u8(at, value & 0xFFu);
        store_u8(at + 1, value >> 8 & 0xFFu);
    }
}
inline void store_u32(std::byte* at, std::uint32_t value) {
    store_u16(at, value & 0xFFFFu);
    store_u16(at + 2, value >> 16);
}

}  // namespace espalier::detail
