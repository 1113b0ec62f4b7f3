// Random numbers that are the same on every machine and with every standard library.
#pragma once

#include <cstdint>

#include <espalier/types.hpp>

namespace espalier::tests {

/// SplitMix64 (Steele, Lea, Flood 2014): one addition and a mixing function; any seed is a good seed.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15u;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }

    /// 0 .. limit - 1; the bias is below limit / 2^64.
    std::uint32_t below(std::uint32_t limit) { return static_cast<std::uint32_t>((next() >> 32) * limit >> 32); }

    /// low .. high, both included.
    std::int32_t between(std::int32_t low, std::int32_t high) {
        const auto width = static_cast<std::uint32_t>(static_cast<std::int64_t>(high) - low + 1);
        return static_cast<std::int32_t>(low + static_cast<std::int64_t>(below(width)));
    }

    /// A multiple of 2^-24 in [0, 1).
    float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }

    /// A multiple of 2^-23 in [-1, 1).
    float signed_unit() { return static_cast<float>(next() >> 40) * 0x1p-23f - 1.0f; }

    bool coin() { return (next() >> 63) != 0; }

    Vec3 in_cube(float half_side) {
        const float x = signed_unit() * half_side;
        const float y = signed_unit() * half_side;
        const float z = signed_unit() * half_side;
        return {x, y, z};
    }

private:
    std::uint64_t state_;
};

}  // namespace espalier::tests
