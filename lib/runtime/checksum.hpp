// CRC-32 as in IEEE 802.3 (reflected, polynomial 0xEDB88320): finds accidents, not attackers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/format.hpp>
#include <runtime/bytes.hpp>

namespace espalier::detail {

/// The effect of each low half byte: 64 bytes of table suit a small core's flash.
inline constexpr std::array<std::uint32_t, 16> checksum_table = [] {
    std::array<std::uint32_t, 16> table{};
    for (std::uint32_t i = 0; i < 16; ++i) {
        std::uint32_t value = i;
        for (int bit = 0; bit < 4; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320u : 0u);
        table[i] = value;
    }
    return table;
}();

inline std::uint32_t checksum_step(std::uint32_t state, std::uint32_t byte) {
    state ^= byte;
    state = (state >> 4) ^ checksum_table[state & 15u];
    return (state >> 4) ^ checksum_table[state & 15u];
}

/// Of a whole blob of at least a header's size, its checksum field taken as zero.
inline std::uint32_t checksum_of_blob(std::span<const std::byte> bytes) {
    constexpr std::size_t field = format::header::checksum_at;
    std::uint32_t state = 0xFFFFFFFFu;
    for (std::size_t i = 0; i < field; ++i) state = checksum_step(state, load_u8(bytes.data() + i));
    for (std::size_t i = 0; i < 4; ++i) state = checksum_step(state, 0);
    for (std::size_t i = field + 4; i < bytes.size(); ++i) state = checksum_step(state, load_u8(bytes.data() + i));
    return ~state;
}

}  // namespace espalier::detail
