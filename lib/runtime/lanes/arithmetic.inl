// What all instruction sets share: loads and stores as copies of bytes, arithmetic by operators of the language.

template <class To, class From>
inline To load_as(const From* from) {
    To result;
    ESPALIER_COPY_BYTES(&result, from, sizeof result);
    return result;
}
inline Ints load_ints(const std::uint32_t* from) { return load_as<Ints>(from); }
inline void store(float* to, Floats a) { ESPALIER_COPY_BYTES(to, &a, sizeof a); }
inline void store(std::uint32_t* to, Ints a) { ESPALIER_COPY_BYTES(to, &a, sizeof a); }
inline void prefetch(const std::byte* at) {
    if constexpr (lanes > 1) ESPALIER_PREFETCH(at);
}

/// Three axes, and a fourth element that often is of no meaning.
using Axes = Vector<float, 4>;
using AxisInts = Vector<std::int32_t, 4>;
template <class Vector>
inline void store_axes(void* to, Vector a) {
    ESPALIER_COPY_BYTES(to, &a, sizeof a);
}

ESPALIER_ALWAYS_INLINE inline Floats bytes_to_floats(const std::byte* at) { return to_floats(load_bytes(at)); }

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

/// Returns which of eight boxes touch another one, a bit for each. Of the eight, a row of numbers for each axis.
template <class Row>
inline unsigned eight_that_touch(const Row* low, const Row* high, const std::int32_t* box_low,
                                 const std::int32_t* box_high) {
    static_assert(sizeof(Row) == 8 * sizeof(std::int32_t));
    unsigned mask = 0;
    for (unsigned first = 0; first < 8; first += lanes) {
        auto apart = load_as<SignedInts>(&low[0][first]) > box_high[0];
        apart = apart | (load_as<SignedInts>(&high[0][first]) < box_low[0]);
        for (int k = 1; k < 3; ++k) {
            apart = apart | (load_as<SignedInts>(&low[k][first]) > box_high[k]);
            apart = apart | (load_as<SignedInts>(&high[k][first]) < box_low[k]);
        }
        mask |= (bits_of(apart) ^ ((1u << lanes) - 1u)) << first;
    }
    return mask;
}
/// Writes a pair of words for each bit of a mask of eight: the first one plus the number of the bit, and the second
/// one. There is room for eight. Returns how many they are.
template <class PairOfWords>
inline unsigned put_marked(PairOfWords* to, std::uint32_t first, std::uint32_t second, unsigned mask) {
    unsigned count = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
        to[count] = {first + i, second};
        count += mask >> i & 1u;
    }
    return count;
}

/// Writes the same first word and one of eight second ones for each bit of a mask.
template <class PairOfWords>
inline unsigned put_with_marked(PairOfWords* to, std::uint32_t first, const std::uint32_t* seconds, unsigned mask) {
    unsigned count = 0;
    for (; mask != 0; mask &= mask - 1) to[count++] = {first, seconds[std::countr_zero(mask)]};
    return count;
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

/// A node's frame: plane * scale + base is a lattice coordinate, exactly.
struct Frame {
    Floats scale[3];
    Floats base[3];
};
/// The planes of a node as tau along a ray: plane * scale + offset.
struct SlabFrame {
    Floats scale[3];
    Floats near_offset[3];
    Floats far_offset[3];
};
