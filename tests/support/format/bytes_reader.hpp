// Numbers out of the bytes of a blob, for the decoder.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

#include <espalier/format.hpp>

namespace espalier::tests::decoding {

class Bytes {
public:
    explicit Bytes(std::span<const std::byte> bytes) : bytes_(bytes) {}

    [[nodiscard]] std::uint32_t u8(std::size_t at) const {
        if (at >= bytes_.size()) throw std::runtime_error("decoder: read past the end at byte " + std::to_string(at));
        return std::to_integer<std::uint32_t>(bytes_[at]);
    }
    [[nodiscard]] std::uint32_t u16(std::size_t at) const { return u8(at) | u8(at + 1) << 8; }
    [[nodiscard]] std::uint32_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }
    [[nodiscard]] float f32(std::size_t at) const { return std::bit_cast<float>(u32(at)); }

    /// `width` bits, `bit` bits after the byte `at`, low bits first; one bit at a time, so that nobody has to trust a
    /// shift.
    [[nodiscard]] std::uint32_t field(std::size_t at, std::size_t bit, unsigned width) const {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < width; ++i, ++bit) value |= (u8(at + bit / 8) >> (bit % 8) & 1u) << i;
        return value;
    }

private:
    std::span<const std::byte> bytes_;
};

inline std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

/// How many bits a number takes: 0 for 0.
inline unsigned bits_of(std::uint32_t number) {
    unsigned count = 0;
    for (; number != 0; number /= 2) ++count;
    return count;
}

}  // namespace espalier::tests::decoding
