// The bits of numbers: little-endian numbers read from bytes; floats taken apart and put together in integers, so that
// the result does not depend on flush-to-zero modes or a libm; and their square roots.
#pragma once

#include <bit>
#include <cfloat>
#include <cstddef>
#include <cstdint>

#include <runtime/base/options.hpp>

namespace espalier::detail {

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Espalier is exact: compile it without -ffast-math and -ffinite-math-only"
#endif
static_assert(sizeof(float) == 4, "float must be IEEE binary32");
static_assert(FLT_EVAL_METHOD == 0, "float arithmetic must be done in float: use SSE on 32-bit x86");

inline constexpr std::uint32_t magnitude_mask = 0x7FFFFFFFu;
inline constexpr std::uint32_t infinity_bits = 0x7F800000u;

constexpr std::uint32_t magnitude_bits(float x) { return std::bit_cast<std::uint32_t>(x) & magnitude_mask; }
constexpr bool is_nan(float x) { return magnitude_bits(x) > infinity_bits; }
constexpr bool is_finite(float x) { return magnitude_bits(x) < infinity_bits; }
constexpr bool is_negative(float x) { return std::bit_cast<std::uint32_t>(x) >> 31 != 0; }

/// 2^exponent, for exponents of normal numbers: -126 .. 127.
constexpr float power_of_two(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

/// A whole number below 2^24, exactly, without a float operation.
constexpr float whole_float(std::uint32_t number) {
    const int length = 32 - std::countl_zero(number);
    return number == 0
               ? 0.0f
               : std::bit_cast<float>((static_cast<std::uint32_t>(length + 125) << 23) + (number << (24 - length)));
}

/// Exponent of a normal number: |x| is in [2^e, 2^(e+1)).
constexpr int exponent_of(float x) { return static_cast<int>(magnitude_bits(x) >> 23) - 127; }
/// Returns the exponent for the bits of a magnitude that is not 0; that of a subnormal number is that of its highest
/// bit.
constexpr int exponent_of_bits(std::uint32_t magnitude) {
    return magnitude >= 0x00800000u ? static_cast<int>(magnitude >> 23) - 127 : 31 - std::countl_zero(magnitude) - 149;
}

/// Whether a finite number is a whole multiple of 2^exponent, which is at least 2^-100: of the numbers that are not 0,
/// no subnormal one is.
constexpr bool is_multiple_of_power(float x, int exponent) {
    const std::uint32_t magnitude = magnitude_bits(x);
    // The implicit bit stands above the others: no more than 23 of them are zeros.
    return magnitude == 0 || exponent_of(x) - 23 + std::countr_zero(magnitude | 0x00800000u) >= exponent;
}
/// A finite number taken apart: mantissa * 2^exponent, exactly, the mantissa below 2^24. It is 0 for 0 alone.
struct FloatParts {
    std::int64_t mantissa;
    int exponent;
};
/// Takes a finite number apart: it is mantissa * 2^exponent, also if it is subnormal or zero.
ESPALIER_SHARED_CODE constexpr FloatParts parts_of(float x) {
    const std::uint32_t bits = magnitude_bits(x);
    const int biased = static_cast<int>(bits >> 23);
    const std::int64_t fraction = bits & 0x007FFFFFu;
    const std::int64_t mantissa = biased == 0 ? fraction : fraction | 0x00800000;
    return {is_negative(x) ? -mantissa : mantissa, (biased == 0 ? 1 : biased) - 150};
}

/// Subnormal numbers count as zero.
constexpr float flush_subnormal(float x) { return magnitude_bits(x) < 0x00800000u ? 0.0f : x; }

/// x * 2^exponent, rounded once to nearest even, for every x and every exponent within 2^30.
ESPALIER_SHARED_CODE constexpr float scale_by_power_of_two(float x, int exponent) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t sign = bits & 0x80000000u;
    const std::uint32_t magnitude = bits & magnitude_mask;
    int biased = static_cast<int>(magnitude >> 23);
    const auto is_normal = [](int e) { return static_cast<std::uint32_t>(e) - 1u < 254u; };
    if (is_normal(biased) && is_normal(biased + exponent)) [[likely]]
        return std::bit_cast<float>(bits + (static_cast<std::uint32_t>(exponent) << 23));
    if (magnitude == 0 || magnitude >= infinity_bits) return x;
    std::uint32_t mantissa = magnitude & 0x007FFFFFu;
    if (biased == 0) {
        const int shift = std::countl_zero(mantissa) - 8;
        mantissa <<= shift;
        biased = 1 - shift;
    } else {
        mantissa |= 0x00800000u;
    }
    biased += exponent;
    if (biased >= 255) return std::bit_cast<float>(sign | infinity_bits);
    if (biased < 1) {  // without a digit before the point, and fewer behind it
        // mutant(< -> <=) equivalent: both sides are equal then
        const int shift = biased < -24 ? 25 : 1 - biased;
        mantissa = (mantissa + (1u << (shift - 1)) - 1u + (mantissa >> shift & 1u)) >> shift;
        biased = 1;
    }
    return std::bit_cast<float>(sign | ((static_cast<std::uint32_t>(biased - 1) << 23) + mantissa));
}

/// The nearest integer, ties to even, for |x| < 2^24. Relies on round-to-nearest: adding 2^23 leaves no fraction bits.
/// Without a branch on the sign, which no processor could foresee.
ESPALIER_SHARED_CODE inline float round_to_integer(float x) {
    const float big =
        std::bit_cast<float>((std::bit_cast<std::uint32_t>(x) & 0x80000000u) | 0x4B000000u);  // 2^23, x's sign
    const float rounded = (x + big) - big;
    // mutant(< -> <=) equivalent: x is 2^23 then, or its opposite, and rounds to itself
    return magnitude_bits(x) < 0x4B000000u ? rounded : x;
}

/// x cut off towards zero; |x| < 2^63. Small cores have no instruction for it, and compilers bring all of double
/// arithmetic along.
ESPALIER_SHARED_CODE inline std::int64_t to_integer(float x) {
    // mutant(never) work: computes the same integer without the instruction
    if (takes_shortcut()) return static_cast<std::int64_t>(x);
    const std::uint64_t mantissa = (magnitude_bits(x) & 0x007FFFFFu) | 0x00800000u;
    const int shift = exponent_of(x) - 23;
    // mutant(>= -> >, > -> >=) equivalent: a shift by 0 changes nothing, and one by 24 leaves nothing of the mantissa
    const std::uint64_t magnitude = shift >= 0 ? mantissa << shift : shift > -24 ? mantissa >> -shift : 0;
    return static_cast<std::int64_t>(is_negative(x) ? 0 - magnitude : magnitude);
}

/// The nearest float, ties to even, to a number in two's complement, low words first. For cores without wide registers:
/// the compiler's own conversion would bring all of its float addition along.
ESPALIER_NOINLINE inline float words_to_float(const std::uint32_t* words, int count) {
    std::int32_t top;
    std::uint32_t below = 0, rest = 0;
    do {  // what is the next one's sign, and no more, is left out
        top = static_cast<std::int32_t>(words[--count]);
        below = count != 0 ? words[count - 1] : 0;
    } while (count != 0 && top == static_cast<std::int32_t>(below) >> 31);
    // mutant(>> -> one less) equivalent: where the top two bits differ, bit 0 changes, and the leading zeros are the
    // same
    const int shift = std::countl_zero(static_cast<std::uint32_t>(top ^ top >> 31)) - 1;
    const int exponent = 32 * count - shift;
    rest = below << shift;
    for (; count > 1; --count) rest |= words[count - 2];
    // 31 bits, more than a float has, rounded down; whatever is below only matters as "not zero", on both sides of 0.
    const std::uint32_t kept =
        static_cast<std::uint32_t>(top) << shift | below >> 1 >> (31 - shift) | (rest != 0 ? 1u : 0u);
    return static_cast<float>(static_cast<std::int32_t>(kept)) * power_of_two(exponent);
}
/// The nearest float, ties to even.
#if ESPALIER_NATIVE_INT128
ESPALIER_SHARED_CODE inline float to_float(std::int64_t a) { return static_cast<float>(a); }
#else
ESPALIER_SHARED_CODE inline float to_float(std::int64_t a) {
    const auto bits = static_cast<std::uint64_t>(a);
    const std::uint32_t words[2] = {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
    return words_to_float(words, 2);
}
#endif

// For kernels of integers of 64 bits or more (wide_integer.hpp).
constexpr bool is_negative(std::int64_t a) { return a < 0; }
constexpr bool is_zero(std::int64_t a) { return a == 0; }
/// -a or a, without a branch.
constexpr std::int64_t negate_if(std::int64_t a, bool condition) {
    const auto mask = -static_cast<std::int64_t>(condition);
    return (a ^ mask) - mask;
}

/// Where either order is right: the second operand when one is not a number, as x86's instructions do.
// mutant(< -> <=) equivalent: equal numbers differ in the sign of 0 alone, which no caller passes on
inline float minimum(float a, float b) { return a < b ? a : b; }
// mutant(> -> >=) equivalent: equal numbers differ in the sign of 0 alone, which no caller passes on
inline float maximum(float a, float b) { return a > b ? a : b; }
inline float absolute(float x) { return ESPALIER_ABSOLUTE(x); }  // one instruction, and no call anywhere

// Correctly rounded square roots without a libm: the core's instruction where it has one.

/// For cores without the instruction: one result bit a step, exact. x is zero, or positive, normal and finite.
inline float square_root_in_integers(float x) {
    if (magnitude_bits(x) == 0) return x;
    int exponent = exponent_of(x);
    std::uint64_t radicand = (magnitude_bits(x) & 0x007FFFFFu) | 0x00800000u;
    if ((exponent & 1) != 0) {
        radicand <<= 1;
        --exponent;
    }
    // radicand * 2^25 lies in [2^48, 2^50): its root has 25 bits, one more than float keeps, and is never a tie.
    radicand <<= 25;
    std::uint64_t root = 0;
    // mutant(<< -> one more) equivalent: the square of 2^25 is above every radicand
    // mutant(<= -> <) equivalent: an exact root is even, and one less rounds up to the same
    for (std::uint64_t bit = std::uint64_t{1} << 24; bit != 0; bit >>= 1)
        if ((root | bit) * (root | bit) <= radicand) root |= bit;
    const std::uint32_t rounded = static_cast<std::uint32_t>((root >> 1) + (root & 1));
    return std::bit_cast<float>((static_cast<std::uint32_t>(exponent / 2 + 127 - 1) << 23) + rounded);
}

#if defined(__SSE2__) || defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & 4)) || defined(__riscv_flen) || \
    defined(__s390x__) || defined(__wasm__)
inline constexpr bool has_square_root = true;
#else
inline constexpr bool has_square_root = false;
#endif

/// The core's instruction. Where the compiler has to care for errno, its own way would also call libm's sqrtf.
inline float square_root_by_instruction(float x) {
    float root = x;
#if defined(__NO_MATH_ERRNO__)
    root = ESPALIER_SQUARE_ROOT(x);
#elif defined(__SSE2__)
    asm("sqrtss %1, %0" : "=x"(root) : "x"(x));
#elif defined(__aarch64__)
    asm("fsqrt %s0, %s1" : "=w"(root) : "w"(x));
#elif defined(__ARM_FP) && (__ARM_FP & 4)
    asm("vsqrt.f32 %0, %1" : "=t"(root) : "t"(x));
#elif defined(__riscv_flen)
    asm("fsqrt.s %0, %1" : "=f"(root) : "f"(x));
#elif defined(__s390x__)
    asm("sqebr %0, %1" : "=f"(root) : "f"(x));
#elif defined(__wasm__)
    asm("local.get %1\n\tf32.sqrt\n\tlocal.set %0" : "=r"(root) : "r"(x));
#endif
    return root;
}

/// The square root of zero or of a positive, normal and finite number.
inline float square_root(float x) {
    if constexpr (has_square_root) return square_root_by_instruction(x);
    else return square_root_in_integers(x);
}

// Numbers read from bytes that may lie anywhere: no alignment, any byte order of the machine. Compilers turn each of
// these into one load where the machine has one.

/// One instruction where the machine reads from any address; elsewhere several, which small code has only once.
#if defined(__arm__) && !defined(__ARM_FEATURE_UNALIGNED)
#define ESPALIER_LOAD inline
#else
#define ESPALIER_LOAD ESPALIER_ALWAYS_INLINE inline
#endif

inline std::uint32_t load_u8(const std::byte* at) { return std::to_integer<std::uint32_t>(*at); }
ESPALIER_LOAD std::uint32_t load_u16(const std::byte* at) { return load_u8(at) | load_u8(at + 1) << 8; }
ESPALIER_LOAD std::uint32_t load_u32(const std::byte* at) { return load_u16(at) | load_u16(at + 2) << 16; }
inline std::uint64_t load_u64(const std::byte* at) { return load_u32(at) | std::uint64_t{load_u32(at + 4)} << 32; }
ESPALIER_LOAD std::int16_t load_i16(const std::byte* at) { return static_cast<std::int16_t>(load_u16(at)); }
ESPALIER_LOAD std::int32_t load_i32(const std::byte* at) { return static_cast<std::int32_t>(load_u32(at)); }
ESPALIER_LOAD float load_f32(const std::byte* at) { return std::bit_cast<float>(load_u32(at)); }

#undef ESPALIER_LOAD

/// `count` bits from bit `bit` of a stream on, low bits first; count at most 25. Reads the 4 bytes from the one in
/// which the bits begin: the format's guard keeps that inside the blob.
ESPALIER_ALWAYS_INLINE inline std::uint32_t load_few_bits(const std::byte* stream, unsigned bit, unsigned count) {
    return (load_u32(stream + bit / 8) >> (bit % 8)) & ((1u << count) - 1u);
}
/// Field `index` of a stream of fields with that many bits.
inline std::uint32_t load_field(const std::byte* stream, unsigned width, unsigned index) {
    return load_few_bits(stream, width * index, width);
}

/// Loads up to 57 bits of a stream. Reads 8 bytes.
inline std::uint64_t load_bits(const std::byte* stream, unsigned bit, unsigned count) {
    return (load_u64(stream + bit / 8) >> (bit % 8)) & ((std::uint64_t{1} << count) - 1u);
}

/// Loads up to 63 bits of a stream. Reads 9 bytes.
inline std::uint64_t load_many_bits(const std::byte* stream, unsigned bit, unsigned count) {
    const std::byte* const at = stream + bit / 8;
    const std::uint64_t above = (std::uint64_t{load_u8(at + 8)} << 1) << (63 - bit % 8);
    return (load_u64(at) >> (bit % 8) | above) & ((std::uint64_t{1} << count) - 1u);
}

// Numbers of the format, written to any address.

inline void store_u8(std::byte* at, std::uint32_t value) { *at = static_cast<std::byte>(value); }
inline void store_u16(std::byte* at, std::uint32_t value) {
    if constexpr (std::endian::native == std::endian::little) {
        const auto word = static_cast<std::uint16_t>(value);
        ESPALIER_COPY_BYTES(at, &word, sizeof word);
    } else {
        store_u8(at, value & 0xFFu);
        store_u8(at + 1, value >> 8 & 0xFFu);
    }
}
inline void store_u32(std::byte* at, std::uint32_t value) {
    store_u16(at, value & 0xFFFFu);
    store_u16(at + 2, value >> 16);
}

}  // namespace espalier::detail
