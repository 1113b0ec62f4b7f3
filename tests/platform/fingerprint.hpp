// A hash of answers, bit for bit the same on every machine that gives the same answers. FNV-1a over little-endian words.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/types.hpp>

namespace espalier::platform {

class Fingerprint {
public:
    constexpr void add(std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8) {
            value_ = (value_ ^ ((word >> shift) & 0xFFu)) * 0x100000001B3u;
        }
    }
    constexpr void add(bool yes) { add(std::uint32_t{yes}); }
    constexpr void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    constexpr void add(const Vec3& vector) {
        add(vector.x);
        add(vector.y);
        add(vector.z);
    }
    [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325u;
};

}  // namespace espalier::platform
