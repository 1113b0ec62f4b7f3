// What the x86 instruction sets share.

// GCC makes more than one instruction of a comparison with a constant.
inline Axes smaller(Axes a, Axes b) { return Axes(_mm_min_ps(a, b)); }
inline Axes larger(Axes a, Axes b) { return Axes(_mm_max_ps(a, b)); }
inline AxisInts round_to_integers(Axes a) { return AxisInts(_mm_cvtps_epi32(a)); }

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    // Words of 64 bits have no arithmetic shift here: 2^62 keeps them above zero, and is taken away again modulo 2^32.
    constexpr std::uint64_t above = std::uint64_t{1} << 62;
    const auto place = [&](int lane) {
        WideInts sum = WideInts{} + (static_cast<std::uint64_t>(moved) + above);
        for (int k = 0; k < 3; ++k) sum += multiply_even(__builtin_bit_cast(WideInts, vertex[k]) >> 32 * lane, row[k]);
        return sum >> fraction_bits;
    };
    const WideInts both = (place(0) & 0xFFFFFFFFu) | place(1) << 32;
    return to_floats(__builtin_bit_cast(Ints, both) - static_cast<std::uint32_t>(above >> fraction_bits));
}
