// A hash of answers, bit for bit the same on every machine that gives the same answers. FNV-1a over little-endian
// words.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier::platform {

class Fingerprint {
public:
    constexpr void add(std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8) add_byte((word >> shift) & 0xFFu);
    }
    constexpr void add(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) add_byte(std::to_integer<std::uint32_t>(byte));
    }
    constexpr void add(bool yes) { add(std::uint32_t{yes}); }
    constexpr void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    constexpr void add(const Vec3& vector) {
        add(vector.x);
        add(vector.y);
        add(vector.z);
    }
    constexpr void add(const Vec3d& vector) {
        for (const double number : {vector.x, vector.y, vector.z}) {
            const auto bits = std::bit_cast<std::uint64_t>(number);
            add(static_cast<std::uint32_t>(bits));
            add(static_cast<std::uint32_t>(bits >> 32));
        }
    }
    /// Statuses enter by the numbers that they had when golden.txt was recorded; those of found and not found are one.
    constexpr void add(QueryStatus status) {
        add(std::uint32_t{status == QueryStatus::invalid_argument ? 1u
                          : status == QueryStatus::out_of_range   ? 2u
                          : status == QueryStatus::not_closed     ? 3u
                          : status == QueryStatus::work_limit     ? 5u
                          : status == QueryStatus::output_full    ? 6u
                                                                  : 0u});
    }
    constexpr void add(const Fingerprint& part) {
        add(static_cast<std::uint32_t>(part.value_));
        add(static_cast<std::uint32_t>(part.value_ >> 32));
    }
    /// Several, one after the other.
    template <class First, class Second, class... More>
    constexpr void add(const First& first, const Second& second, const More&... more) {
        add(first), add(second), (add(more), ...);
    }
    [[nodiscard]] constexpr std::uint64_t value() const { return value_; }

private:
    constexpr void add_byte(std::uint32_t byte) { value_ = (value_ ^ byte) * 0x100000001B3u; }

    std::uint64_t value_ = 0xCBF29CE484222325u;
};

}  // namespace espalier::platform
