// CRC-32 as in IEEE 802.3 (reflected, polynomial 0xEDB88320): finds accidents, not attackers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/format.hpp>
#include <runtime/bytes.hpp>

namespace espalier::detail {

/// So many at once: 64 bytes of table suit a small core's flash. By two, code is 56 bytes less, and a microcontroller
/// opens a blob with half as many instructions again.
inline constexpr unsigned checksum_bits = 4;

/// The effect of each value of the low bits.
inline constexpr std::array<std::uint32_t, 1 << checksum_bits> checksum_table = [] {
    std::array<std::uint32_t, 1 << checksum_bits> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
        std::uint32_t value = i;
        for (unsigned bit = 0; bit < checksum_bits; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320u : 0u);
        table[i] = value;
    }
    return table;
}();

inline std::uint32_t checksum_step(std::uint32_t state, std::uint32_t byte) {
    state ^= byte;
    for (unsigned bit = 0; bit < 8; bit += checksum_bits)
        state = (state >> checksum_bits) ^ checksum_table[state & ((1u << checksum_bits) - 1u)];
    return state;
}

/// Of a whole blob, or of the remap file beside it, the checksum field of its header taken as zero.
inline std::uint32_t checksum_of_blob(std::span<const std::byte> bytes) {
    std::uint32_t state = 0xFFFFFFFFu;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const bool is_of_field = i - format::header::checksum_at < 4;
        state = checksum_step(state, is_of_field ? 0 : load_u8(bytes.data() + i));
    }
    return ~state;
}

}  // namespace espalier::detail
