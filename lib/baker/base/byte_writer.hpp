// Little-endian numbers and bit fields at the end of a growing buffer.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/types.hpp>

namespace espalier::baker {

inline void put_u8(std::vector<std::byte>& bytes, std::uint32_t value) {
    bytes.push_back(static_cast<std::byte>(value));
}
inline void put_u16(std::vector<std::byte>& bytes, std::uint32_t value) {
    put_u8(bytes, value & 0xFF);
    put_u8(bytes, value >> 8 & 0xFF);
}
inline void put_u32(std::vector<std::byte>& bytes, std::uint32_t value) {
    put_u16(bytes, value & 0xFFFF);
    put_u16(bytes, value >> 16);
}
inline void put_f32(std::vector<std::byte>& bytes, float value) { put_u32(bytes, std::bit_cast<std::uint32_t>(value)); }

inline void set_u8(std::byte* at, std::uint32_t value) { *at = static_cast<std::byte>(value); }
inline void set_u16(std::byte* at, std::uint32_t value) {
    set_u8(at, value & 0xFF);
    set_u8(at + 1, value >> 8 & 0xFF);
}
inline void set_u24(std::byte* at, std::uint32_t value) {
    set_u16(at, value & 0xFFFF);
    set_u8(at + 2, value >> 16);
}
inline void set_u32(std::byte* at, std::uint32_t value) {
    set_u16(at, value & 0xFFFF);
    set_u16(at + 2, value >> 16);
}

inline void set_vec3d(std::byte* at, const Vec3d& place) {
    for (const double coordinate : {place.x, place.y, place.z}) {
        const auto bits = std::bit_cast<std::uint64_t>(coordinate);
        set_u32(at, static_cast<std::uint32_t>(bits));
        set_u32(at + 4, static_cast<std::uint32_t>(bits >> 32));
        at += 8;
    }
}

/// Zero bytes up to a multiple of `unit`, counted from the start of the buffer.
inline void pad_to(std::vector<std::byte>& bytes, std::size_t unit) {
    bytes.resize((bytes.size() + unit - 1) / unit * unit);
}

/// A row of fields, low bits first, filled up with zero bits to a whole byte when finished.
class BitStream {
public:
    explicit BitStream(std::vector<std::byte>& bytes) : bytes_(bytes) {}

    /// `width` at most 32; `value` below 2^width.
    void put(std::uint32_t value, unsigned width) {
        pending_ |= std::uint64_t{value} << count_;
        count_ += width;
        while (count_ >= 8) {
            put_u8(bytes_, static_cast<std::uint32_t>(pending_ & 0xFF));
            pending_ >>= 8;
            count_ -= 8;
        }
    }
    void finish() {
        if (count_ != 0) put_u8(bytes_, static_cast<std::uint32_t>(pending_));
        pending_ = 0;
        count_ = 0;
    }

private:
    std::vector<std::byte>& bytes_;
    std::uint64_t pending_ = 0;
    unsigned count_ = 0;
};

}  // namespace espalier::baker
