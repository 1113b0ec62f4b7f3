// Random numbers that are the same on every machine and with every standard library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/shapes.hpp>

namespace espalier::tests {

/// SplitMix64 (Steele, Lea, Flood 2014): one addition and a mixing function; any seed is a good seed.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// Words of these bytes first, so that a fuzzer can choose what is drawn.
    Random(std::uint64_t seed, std::span<const std::byte> bytes) : state_(seed), bytes_(bytes) {}

    std::uint64_t next() {
        if (bytes_.size() >= 4) return from_bytes();
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

    Vec3 in_box(const Box& box) {
        const float x = box.min.x + (box.max.x - box.min.x) * unit();
        const float y = box.min.y + (box.max.y - box.min.y) * unit();
        const float z = box.min.z + (box.max.z - box.min.z) * unit();
        return {x, y, z};
    }

private:
    /// The same word high and low: whoever draws looks at one of the two.
    std::uint64_t from_bytes() {
        std::uint64_t word = 0;
        for (std::size_t i = 0; i < 4; ++i) word |= std::to_integer<std::uint64_t>(bytes_[i]) << (8 * i);
        bytes_ = bytes_.subspan(4);
        return word << 32 | word;
    }

    std::uint64_t state_;
    std::span<const std::byte> bytes_;
};

}  // namespace espalier::tests
