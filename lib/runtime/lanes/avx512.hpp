// The vocabulary of the lanes for AVX-512: sixteen lanes for the triangles of a leaf and the children of a plain node.
// Packed nodes have eight children, and stay with AVX2.
#pragma once

#include <runtime/lanes/avx2.hpp>

#define ESPALIER_AVX512 ESPALIER_AVX2 ",avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx512vbmi,avx512vbmi2"

#if defined(__x86_64__)

ESPALIER_BEGIN_TARGET(ESPALIER_AVX512)
namespace espalier::detail::avx512 {

inline constexpr unsigned lanes = 16;
using Floats = Vector<float, lanes>;
using Ints = Vector<std::uint32_t, lanes>;
using SignedInts = Vector<std::int32_t, lanes>;
using Compared = SignedInts;

ESPALIER_ALWAYS_INLINE inline Ints load_bytes(const std::byte* at) {
    return Ints(_mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at))));
}
inline Ints load_words(const std::byte* at) {
    return Ints(_mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at))));
}
/// Converts numbers below 2^31.
inline Floats to_floats(Ints a) { return _mm512_cvtepi32_ps(__m512i(a)); }
unsigned bits_of(SignedInts) = delete;  // comparisons give masks

#include <runtime/lanes/arithmetic.inl>

inline Floats smaller(Floats a, Floats b) { return _mm512_min_ps(a, b); }
inline Floats larger(Floats a, Floats b) { return _mm512_max_ps(a, b); }
inline Floats square_roots(Floats a) { return _mm512_sqrt_ps(a); }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a, b, c); }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return _mm512_fmsub_ps(a, b, c); }
inline unsigned at_most(Floats a, Floats b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
inline unsigned at_most(SignedInts a, SignedInts b) {
    // Returned as a number, because GCC 12 stores a mask in two bytes and loads four.
    return _cvtmask16_u32(_mm512_cmple_epi32_mask(__m512i(a), __m512i(b)));
}

/// Boxes of eight children: comparisons of half a register that give masks, one after the other.
inline unsigned eight_that_touch(const std::int32_t (*low)[8], const std::int32_t (*high)[8],
                                 const std::int32_t* box_low, const std::int32_t* box_high) {
    const auto row = [](const std::int32_t* at) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)); };
    __mmask8 mask = _mm256_cmple_epi32_mask(row(low[0]), _mm256_set1_epi32(box_high[0]));
    mask = _mm256_mask_cmpge_epi32_mask(mask, row(high[0]), _mm256_set1_epi32(box_low[0]));
    for (int k = 1; k < 3; ++k) {
        mask = _mm256_mask_cmple_epi32_mask(mask, row(low[k]), _mm256_set1_epi32(box_high[k]));
        mask = _mm256_mask_cmpge_epi32_mask(mask, row(high[k]), _mm256_set1_epi32(box_low[k]));
    }
    return _cvtmask8_u32(mask);
}
template <class PairOfWords>
requires(sizeof(PairOfWords) == sizeof(std::uint64_t)) inline unsigned put_marked(PairOfWords* to, std::uint32_t first,
                                                                                  std::uint32_t second, unsigned mask) {
    const __m512i counting = _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0);
    const __m512i both = _mm512_set1_epi64(static_cast<long long>(std::uint64_t{second} << 32 | first));
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(_cvtu32_mask8(mask), _mm512_add_epi64(both, counting)));
    return static_cast<unsigned>(std::popcount(mask));
}

template <class PairOfWords>
requires(sizeof(PairOfWords) ==
         sizeof(std::uint64_t)) inline unsigned put_with_marked(PairOfWords* to, std::uint32_t first,
                                                                const std::uint32_t* seconds, unsigned mask) {
    const __m512i high = _mm512_cvtepu32_epi64(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(seconds)));
    const __m512i both = _mm512_or_si512(_mm512_slli_epi64(high, 32), _mm512_set1_epi64(first));
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi64(_cvtu32_mask8(mask), both));
    return static_cast<unsigned>(std::popcount(mask));
}

/// Where the fields of one width lie in a stream: lane by lane, the bytes that hold it and how far to shift them.
struct WideUnpackEntry {
    alignas(64) std::uint8_t bytes[64];
    alignas(64) std::uint32_t shift[16];
};
inline constexpr std::array<WideUnpackEntry, max_unpack_width + 1> wide_unpack_table = [] {
    std::array<WideUnpackEntry, max_unpack_width + 1> table{};
    for (unsigned width = 0; width <= max_unpack_width; ++width)
        for (unsigned lane = 0; lane < 16; ++lane) {
            table[width].shift[lane] = lane * width % 8;
            for (unsigned byte = 0; byte < 4; ++byte)
                table[width].bytes[4 * lane + byte] = static_cast<std::uint8_t>(lane * width / 8 + byte);
        }
    return table;
}();
/// Reads 64 bytes: the guard behind the leaves is there for it.
inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const WideUnpackEntry& entry = wide_unpack_table[width];
    const __m512i spread =
        _mm512_permutexvar_epi8(_mm512_load_si512(entry.bytes), _mm512_loadu_si512(stream + first / 8 * width));
    return Ints(spread) >> load_ints(entry.shift) & ((1u << width) - 1u);
}

/// In the first `count` of three registers or fewer.
template <unsigned count>
inline Floats look_up_in(const Floats* group, Ints index) {
    const auto numbers = __m512i(index);
    if constexpr (count == 1) return _mm512_permutexvar_ps(numbers, group[0]);
    else if constexpr (count == 2) return _mm512_permutex2var_ps(group[0], numbers, group[1]);
    else
        return _mm512_mask_blend_ps(_mm512_test_epi32_mask(numbers, _mm512_set1_epi32(32)),
                                    _mm512_permutex2var_ps(group[0], numbers, group[1]),
                                    _mm512_permutex2var_ps(group[2], numbers, group[count - 1]));
}
#include <runtime/lanes/tables.inl>

/// The windows of a strip, sixteen at a time; all entries are decoded at once, as the bytes of one register.
class StripCorners {
public:
    ESPALIER_ALWAYS_INLINE explicit StripCorners(const StripLeaf& leaf) : pivots_(leaf.pivots) {
        alignas(64) static constexpr std::array<std::uint8_t, 64> counting = [] {
            std::array<std::uint8_t, 64> numbers{};
            for (unsigned i = 0; i < 64; ++i) numbers[i] = static_cast<std::uint8_t>(i);
            return numbers;
        }();
        // References: eight to a word, each word from the byte in which its first one begins.
        const __m512i number = _mm512_load_si512(counting.data());
        const __m512i word = _mm512_srli_epi16(_mm512_and_si512(number, _mm512_set1_epi8(0x38)), 3);
        const __m512i in_word = _mm512_and_si512(number, _mm512_set1_epi8(7));
        // At most 7 times 6: multiplying pairs of bytes carries nothing from one to the other.
        const __m512i width = _mm512_set1_epi16(static_cast<short>(leaf.reference_width));
        const __m512i stream = _mm512_loadu_si512(leaf.marks + leaf.references_at / 8);
        const __m512i words =
            _mm512_permutexvar_epi8(_mm512_add_epi8(_mm512_mullo_epi16(word, width), in_word), stream);
        const __m512i offset = _mm512_add_epi8(_mm512_mullo_epi16(in_word, width),
                                               _mm512_set1_epi8(static_cast<char>(leaf.references_at % 8)));
        const __m512i references =
            _mm512_and_si512(_mm512_multishift_epi64_epi8(offset, words),
                             _mm512_set1_epi8(static_cast<char>((1u << leaf.reference_width) - 1u)));
        entries_ =
            _mm512_mask_expand_epi8(_mm512_maskz_expand_epi8(leaf.first_uses, number), ~leaf.first_uses, references);
        number_ = number;
    }
    /// The vertices that all entries name, a byte each.
    [[nodiscard]] __m512i entries() const { return entries_; }
    [[nodiscard]] __m512i number() const { return number_; }
    void keep_entries(std::uint8_t* to) const { _mm512_storeu_si512(to, entries_); }
    ESPALIER_ALWAYS_INLINE CornerNumbers next() {
        // The last marked entry of this group that is not behind the window, or the last one of the groups before.
        const __m512i up_to_lane =
            _mm512_setr_epi32(1, 3, 7, 15, 31, 63, 127, 255, 511, 1023, 2047, 4095, 8191, 16383, 32767, 65535);
        const __m512i marked = _mm512_and_si512(_mm512_set1_epi32(static_cast<int>(pivots_ & 0xFFFF)), up_to_lane);
        const __m512i place = _mm512_sub_epi32(_mm512_set1_epi32(31), _mm512_lzcnt_epi32(marked));
        const __m512i here = to_lanes(entries_);
        const __m512i pivots =
            _mm512_mask_permutexvar_epi32(pivot_, _mm512_test_epi32_mask(marked, marked), place, here);
        const CornerNumbers numbers = {Ints(pivots), Ints(to_lanes(entries_from(1))), Ints(to_lanes(entries_from(2)))};
        pivot_ = _mm512_permutexvar_epi32(_mm512_set1_epi32(15), pivots);
        pivots_ >>= 16;
        entries_ = entries_from(16);
        return numbers;
    }

private:
    static __m512i to_lanes(__m512i bytes) { return _mm512_cvtepu8_epi32(_mm512_castsi512_si128(bytes)); }
    [[nodiscard]] __m512i entries_from(char place) const {
        return _mm512_permutexvar_epi8(_mm512_add_epi8(number_, _mm512_set1_epi8(place)), entries_);
    }

    std::uint64_t pivots_;
    __m512i number_;   ///< 0, 1 .. 63
    __m512i entries_;  ///< those of this group and the following
    __m512i pivot_ = _mm512_setzero_si512();
};

#if ESPALIER_PREDICTED_STRIPS
/// An axis of eight vertices.
template <unsigned shift>
inline void store_fields(std::uint32_t* to, const std::uint64_t* words) {
    const auto fields = load_as<Vector<std::uint64_t, 8>>(words) >> shift;
    const __m512i low = _mm512_set1_epi64(vertex_word::field(vertex_word::axis_bits, 0));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvtepi64_epi32(_mm512_and_si512(__m512i(fields), low)));
}
#include <runtime/lanes/predicted_points.inl>

inline PredictedFrom predicted_from(const StripLeaf& leaf) {
    const StripCorners strip(leaf);
    const __m512i entries = strip.entries();
    const __m512i number = strip.number();
    const __m512i zero = _mm512_setzero_si512();
    // The last marked entry up to each: among the eight of its word, and of the words before.
    __m512i marked = _mm512_maskz_mov_epi8(leaf.pivots, number);
    marked = _mm512_max_epu8(marked, _mm512_slli_epi64(marked, 8));
    marked = _mm512_max_epu8(marked, _mm512_slli_epi64(marked, 16));
    marked = _mm512_max_epu8(marked, _mm512_slli_epi64(marked, 32));
    __m512i last = _mm512_alignr_epi64(_mm512_srli_epi64(marked, 56), zero, 7);
    last = _mm512_max_epu8(last, _mm512_alignr_epi64(last, zero, 7));
    last = _mm512_max_epu8(last, _mm512_alignr_epi64(last, zero, 6));
    last = _mm512_max_epu8(last, _mm512_alignr_epi64(last, zero, 4));
    const __m512i word = _mm512_and_si512(number, _mm512_set1_epi8(0x38));
    const __m512i pivots =
        _mm512_permutexvar_epi8(_mm512_max_epu8(marked, _mm512_permutexvar_epi8(word, last)), entries);
    const auto from_before = [&](__m512i of_entries, char places) {
        return _mm512_permutexvar_epi8(_mm512_sub_epi8(number, _mm512_set1_epi8(places)), of_entries);
    };
    const __mmask64 predicted = format::predicted_strip::predicted_entries(leaf.windows);
    const __m512i none = _mm512_set1_epi8(PredictedFrom::none);
    PredictedFrom from;
    const auto put = [&](std::uint8_t* to, __m512i numbers) {
        const __m512i or_none = _mm512_mask_blend_epi8(predicted, none, numbers);
        _mm512_store_si512(to, _mm512_maskz_compress_epi8(leaf.first_uses, or_none));
    };
    put(from.pivot, from_before(pivots, 2));
    put(from.before, from_before(entries, 1));
    put(from.opposite, _mm512_mask_blend_epi8(leaf.pivots << 2, from_before(entries, 2), from_before(pivots, 3)));
    return from;
}
#endif

/// A coordinate of vertices on another grid: (row . vertex + moved) >> fraction_bits, below 2^24 and exact.
inline Floats place_on_axis(const std::int32_t* row, std::int64_t moved, int fraction_bits, const Ints* vertex) {
    const __m128i shift = _mm_cvtsi32_si128(fraction_bits);
    const auto place = [&](auto half) {
        __m512i sum = _mm512_set1_epi64(moved);
        for (int k = 0; k < 3; ++k)
            sum = _mm512_add_epi64(sum, _mm512_mul_epi32(half(__m512i(vertex[k])), _mm512_set1_epi32(row[k])));
        return _mm512_sra_epi64(sum, shift);
    };
    const __m512i even = place([](__m512i all) { return all; });
    const __m512i odd = place([](__m512i all) { return _mm512_srli_epi64(all, 32); });
    return _mm512_cvtepi32_ps(_mm512_mask_blend_epi32(0xAAAA, even, _mm512_slli_epi64(odd, 32)));
}

using avx2::RayLanesOf;  // and with it the slab test of packed nodes, which is found by its argument
using avx2::shift_left_each;
using avx2::words_to_axes;
#include <runtime/lanes/axes.inl>
#include <runtime/lanes/leaves.inl>

}  // namespace espalier::detail::avx512
ESPALIER_END_TARGET

#endif
