// What all instruction sets share: loads and stores as copies of bytes, arithmetic by operators of the language.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/lanes/alone.hpp>
#endif

template <class To, class From>
inline To load_as(const From* from) {
    To result;
    __builtin_memcpy(&result, from, sizeof result);
    return result;
}
inline Ints load_ints(const std::uint32_t* from) { return load_as<Ints>(from); }
inline void store(float* to, Floats a) { __builtin_memcpy(to, &a, sizeof a); }
inline void store(std::uint32_t* to, Ints a) { __builtin_memcpy(to, &a, sizeof a); }
inline void prefetch(const std::byte* at) {
    if constexpr (lanes > 1) __builtin_prefetch(at);
}

/// Three axes, and a fourth element that often is of no meaning.
using Axes = Vector<float, 4>;
using AxisInts = Vector<std::int32_t, 4>;
template <class Vector>
inline void store_axes(void* to, Vector a) {
    __builtin_memcpy(to, &a, sizeof a);
}

[[gnu::always_inline]] inline Floats bytes_to_floats(const std::byte* at) { return to_floats(load_bytes(at)); }

/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = lanes > 4;

inline Floats splat(float x) { return x - Floats{}; }  // -0 too
inline SignedInts splat_integer(std::int32_t x) { return x + SignedInts{}; }
inline Floats add(Floats a, Floats b) { return a + b; }
inline SignedInts add(SignedInts a, SignedInts b) { return a + b; }
inline Ints add(Ints a, std::uint32_t b) { return a + b; }
inline Floats subtract(Floats a, Floats b) { return a - b; }
inline Floats multiply(Floats a, Floats b) { return a * b; }
inline Floats divide(Floats a, Floats b) { return a / b; }
inline Floats negate(Floats a) { return -a; }
inline SignedInts negate(SignedInts a) { return -a; }
template <int bits>
inline SignedInts shift_right(SignedInts a) {
    return a >> bits;
}
/// Numbers of 24 bits.
inline Ints with_high_bytes(Ints words, Ints bytes) { return words | bytes << 16; }

// These are templates so that an instruction set may have better ones of its own. (Of a number and 0, GCC makes two
// instructions where x86 has one.)

template <class Numbers>
inline Numbers magnitude(Numbers a) {
    return __builtin_bit_cast(Numbers, __builtin_bit_cast(Ints, a) & 0x7FFFFFFFu);
}
/// The second when one is not a number.
template <class Numbers>
inline Numbers smaller(Numbers a, Numbers b) {
    return a < b ? a : b;
}
template <class Numbers>
inline Numbers larger(Numbers a, Numbers b) {
    return a > b ? a : b;
}
template <class Numbers>
inline Numbers where_at_most(Numbers a, Numbers b, Numbers then, Numbers otherwise) {
    return a <= b ? then : otherwise;
}
/// One bit a lane: a <= b.
template <class Numbers>
inline unsigned at_most(Numbers a, Numbers b) {
    if constexpr (std::is_same_v<Numbers, Floats>) return bits_of(a <= b);
    else return ((1u << lanes) - 1) & ~bits_of(a > b);  // the comparison that processors have
}

/// The same numbers in the form that the slab test compares faster: floats, or their bits as integers. Integers order
/// numbers from 0 on, but not -0, as floats do, and negative ones below them.
inline Compared to_compared(Floats a) { return __builtin_bit_cast(Compared, a); }
inline void store_compared(float* to, Compared a) { store(to, __builtin_bit_cast(Floats, a)); }

/// Pairs of integers by vertex, in a table of floats.
template <class FloatTable>
struct PairTableIn : FloatTable {
    void set(unsigned number, Ints pair) { FloatTable::set(number, __builtin_bit_cast(Floats, pair)); }
    template <class Index>
    [[nodiscard]] Ints look_up(const Index& index) const {
        return __builtin_bit_cast(Ints, FloatTable::look_up(index));
    }
};
