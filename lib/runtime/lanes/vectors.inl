// What instruction sets of several lanes share.
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
inline void prefetch(const std::byte* at) { __builtin_prefetch(at); }

/// Three axes, and a fourth element that often is of no meaning.
using Axes = Vector<float, 4>;
using AxisInts = Vector<std::int32_t, 4>;
template <class Vector>
inline void store_axes(void* to, Vector a) {
    __builtin_memcpy(to, &a, sizeof a);
}

inline Floats magnitude(Floats a) { return __builtin_bit_cast(Floats, __builtin_bit_cast(Ints, a) & 0x7FFFFFFFu); }
inline Floats bytes_to_floats(const std::byte* at) { return to_floats(load_bytes(at)); }

#include <runtime/lanes/arithmetic.inl>

/// Pairs of integers by vertex, in a table of floats.
template <class FloatTable>
struct PairTableIn : FloatTable {
    void set(unsigned number, Ints pair) { FloatTable::set(number, __builtin_bit_cast(Floats, pair)); }
    template <class Index>
    [[nodiscard]] Ints look_up(const Index& index) const {
        return __builtin_bit_cast(Ints, FloatTable::look_up(index));
    }
};
