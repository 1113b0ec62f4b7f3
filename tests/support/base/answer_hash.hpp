// A hash of answers, bit by bit: to compare many answers by one number.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/types.hpp>

namespace espalier::tests {

/// FNV-1a over words.
class AnswerHash {
public:
    void add(std::uint32_t word) {
        for (int i = 0; i < 4; ++i) {
            value_ ^= word >> (8 * i) & 255u;
            value_ *= 0x100000001B3u;
        }
    }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    void add(Vec3 v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    /// Several, one after the other.
    template <class First, class Second, class... More>
    void add(const First& first, const Second& second, const More&... more) {
        add(first), add(second), (add(more), ...);
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325u;
};

}  // namespace espalier::tests
