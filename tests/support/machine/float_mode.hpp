// The processor's ways with subnormal numbers, which a library cannot choose: game engines and audio code flush them.
#pragma once

#include <array>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace espalier::tests {

inline constexpr unsigned flush_to_zero = 0x8000;       // results
inline constexpr unsigned denormals_are_zero = 0x0040;  // operands

#if defined(__SSE2__)

inline constexpr std::array float_modes = {0u, flush_to_zero, denormals_are_zero, flush_to_zero | denormals_are_zero};

/// Just these flags, in force as long as it lives, in this thread.
class FloatMode {
public:
    explicit FloatMode(unsigned flags) : before_(_mm_getcsr()) {
        _mm_setcsr((before_ & ~(flush_to_zero | denormals_are_zero)) | flags);
    }
    ~FloatMode() { _mm_setcsr(before_); }
    FloatMode(const FloatMode&) = delete;
    FloatMode& operator=(const FloatMode&) = delete;

private:
    unsigned before_;
};

#else

inline constexpr std::array float_modes = {0u};

class FloatMode {
public:
    explicit FloatMode(unsigned) {}
    ~FloatMode() {}
};

#endif

// Arguments are made while a mode is in force, and must not depend on it. Volatile: compilers move arithmetic past the
// change of mode.

inline float plain_sum(float a, float b) {
    const FloatMode plain(0);
    const volatile float x = a, y = b;
    const volatile float sum = x + y;
    return sum;
}

inline float plain_product(float a, float b) {
    const FloatMode plain(0);
    const volatile float x = a, y = b;
    const volatile float product = x * y;
    return product;
}

}  // namespace espalier::tests
