// CRC-32 as in IEEE 802.3 (reflected, polynomial 0xEDB88320): finds accidents, not attackers.
#pragma once

#include <array>

#include <runtime/base/bits.hpp>

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

constexpr std::uint32_t checksum_step(std::uint32_t state, std::uint32_t byte) {
    state ^= byte;
    for (unsigned bit = 0; bit < 8; bit += checksum_bits)
        state = (state >> checksum_bits) ^ checksum_table[state & ((1u << checksum_bits) - 1u)];
    return state;
}

/// The effect of a byte that others follow: row k, when k bytes do. Eight bytes are then eight independent look-ups
/// (Kounavis and Berry 2005). 8 KB, where code is cheaper than time.
inline constexpr std::array<std::array<std::uint32_t, 256>, 8> checksum_rows = [] {
    std::array<std::array<std::uint32_t, 256>, 8> rows{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        rows[0][i] = checksum_step(i, 0);
        for (unsigned k = 1; k < 8; ++k) rows[k][i] = checksum_step(rows[k - 1][i], 0);
    }
    return rows;
}();

inline std::uint32_t checksum_step_of_eight(std::uint32_t state, std::uint32_t low, std::uint32_t high) {
    low ^= state;
    state = 0;
    for (unsigned k = 0; k < 4; ++k)
        state ^= checksum_rows[7 - k][low >> (8 * k) & 255u] ^ checksum_rows[3 - k][high >> (8 * k) & 255u];
    return state;
}

/// The state behind some more bytes.
ESPALIER_SHARED_CODE inline std::uint32_t checksum_steps(std::uint32_t state, const std::byte* at,
                                                         const std::byte* end) {
    for (; takes_shortcut(end - at >= 8); at += 8)
        state = checksum_step_of_eight(state, load_u32(at), load_u32(at + 4));
    for (; at != end; ++at) state = checksum_step(state, load_u8(at));
    return state;
}

/// Returns the checksum of a whole blob, or of the remap file beside it, with the checksum field of the header taken as
/// zero. Both have at least 16 bytes.
inline std::uint32_t checksum_of_blob(std::span<const std::byte> bytes) {
    constexpr std::byte zeros[4] = {};
    const std::byte* const field = bytes.data() + format::header::checksum_at;
    std::uint32_t state = checksum_steps(0xFFFFFFFFu, bytes.data(), field);
    state = checksum_steps(state, zeros, zeros + sizeof zeros);
    return ~checksum_steps(state, field + sizeof zeros, bytes.data() + bytes.size());
}

}  // namespace espalier::detail
