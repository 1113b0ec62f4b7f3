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

/// In force as long as it lives, in this thread.
class FloatMode {
public:
    explicit FloatMode(unsigned flags) : before_(_mm_getcsr()) { _mm_setcsr(before_ | flags); }
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

}  // namespace espalier::tests
