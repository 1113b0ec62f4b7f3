// The same random numbers on every machine.
#pragma once

#include <cstdint>

namespace espalier::platform {

class Numbers {
public:
    std::uint32_t word() {  // xorshift32: no 64-bit arithmetic, for the smallest cores
        state_ ^= state_ << 13;
        state_ ^= state_ >> 17;
        state_ ^= state_ << 5;
        return state_;
    }
    /// Returns a number from 0 to 1.
    float fraction() { return static_cast<float>(word() >> 8) * 0x1p-24f; }
    /// Returns a number from -1 to 1.
    float signed_fraction() { return static_cast<float>(static_cast<std::int32_t>(word() >> 8) - 0x800000) * 0x1p-23f; }

private:
    std::uint32_t state_ = 0x9E3779B9u;
};

}  // namespace espalier::platform
