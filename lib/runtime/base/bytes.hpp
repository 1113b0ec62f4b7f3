// Reading little-endian numbers from bytes that may lie anywhere: no alignment, any byte order of the machine.
// Compilers turn each of these into one load where the machine has one.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace espalier::detail {

static_assert(sizeof(float) == 4, "float must be IEEE binary32");

/// One instruction where the machine reads from any address; elsewhere several, which small code has only once.
#if defined(__arm__) && !defined(__ARM_FEATURE_UNALIGNED)
#define ESPALIER_LOAD inline
#else
#define ESPALIER_LOAD [[gnu::always_inline]] inline
#endif

inline std::uint32_t load_u8(const std::byte* at) { return std::to_integer<std::uint32_t>(*at); }
ESPALIER_LOAD std::uint32_t load_u16(const std::byte* at) { return load_u8(at) | load_u8(at + 1) << 8; }
ESPALIER_LOAD std::uint32_t load_u32(const std::byte* at) { return load_u16(at) | load_u16(at + 2) << 16; }
inline std::uint64_t load_u64(const std::byte* at) { return load_u32(at) | std::uint64_t{load_u32(at + 4)} << 32; }
ESPALIER_LOAD std::int16_t load_i16(const std::byte* at) { return static_cast<std::int16_t>(load_u16(at)); }
ESPALIER_LOAD std::int32_t load_i32(const std::byte* at) { return static_cast<std::int32_t>(load_u32(at)); }
ESPALIER_LOAD float load_f32(const std::byte* at) { return std::bit_cast<float>(load_u32(at)); }

#undef ESPALIER_LOAD

/// `count` bits from bit `bit` of a stream on, low bits first; count at most 25. Reads the 4 bytes from the one in
/// which the bits begin: the format's guard keeps that inside the blob.
[[gnu::always_inline]] inline std::uint32_t load_few_bits(const std::byte* stream, unsigned bit, unsigned count) {
    return (load_u32(stream + bit / 8) >> (bit % 8)) & ((1u << count) - 1u);
}
/// Field `index` of a stream of fields with that many bits.
inline std::uint32_t load_field(const std::byte* stream, unsigned width, unsigned index) {
    return load_few_bits(stream, width * index, width);
}

/// The same for at most 57 bits. Reads 8 bytes.
inline std::uint64_t load_bits(const std::byte* stream, unsigned bit, unsigned count) {
    return (load_u64(stream + bit / 8) >> (bit % 8)) & ((std::uint64_t{1} << count) - 1u);
}

/// The same for at most 63 bits. Reads 9 bytes.
inline std::uint64_t load_many_bits(const std::byte* stream, unsigned bit, unsigned count) {
    const std::byte* const at = stream + bit / 8;
    const std::uint64_t above = (std::uint64_t{load_u8(at + 8)} << 1) << (63 - bit % 8);
    return (load_u64(at) >> (bit % 8) | above) & ((std::uint64_t{1} << count) - 1u);
}

}  // namespace espalier::detail
