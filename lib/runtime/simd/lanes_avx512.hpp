// The vocabulary of the lanes for AVX-512: sixteen lanes for the triangles of a leaf and the children of a plain node.
// Packed nodes have eight children, and stay with AVX2.
#pragma once

#include <runtime/simd/lanes_avx2.hpp>

#define ESPALIER_AVX512 ESPALIER_AVX2 ",avx512f,avx512bw,avx512cd,avx512dq,avx512vl,avx512vbmi,avx512vbmi2"

#if defined(__x86_64__)

#if defined(__GNUC__) && !defined(__clang__)
// GCC's own intrinsics start from a register that they leave undefined on purpose (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif

ESPALIER_BEGIN_TARGET(ESPALIER_AVX512)
namespace espalier::detail::avx512 {

using avx2::Corner;
using avx2::load_low_corner;
using avx2::prefetch;
using avx2::RayLanesOf;

inline constexpr unsigned lanes = 16;
/// Whether single rays unpack all of a leaf for the exact kernel too.
inline constexpr bool keeps_unpacked = true;
struct Floats {
    __m512 v;
};
struct Ints {
    __m512i v;
};
/// A vertex for each lane, and the three vertices of a triangle in each.
using Numbers = Ints;
struct CornerNumbers {
    Numbers a, b, c;
};

struct SignedInts {
    __m512i v;
};
inline Floats splat(float x) { return {_mm512_set1_ps(x)}; }
inline void store(float* to, Floats a) { _mm512_storeu_ps(to, a.v); }
inline Floats add(Floats a, Floats b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Floats subtract(Floats a, Floats b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Floats multiply(Floats a, Floats b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Floats multiply_add(Floats a, Floats b, Floats c) { return {_mm512_fmadd_ps(a.v, b.v, c.v)}; }
inline Floats multiply_subtract(Floats a, Floats b, Floats c) { return {_mm512_fmsub_ps(a.v, b.v, c.v)}; }
inline Floats negate(Floats a) { return {_mm512_xor_ps(a.v, _mm512_set1_ps(-0.0f))}; }
inline Floats smaller(Floats a, Floats b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Floats larger(Floats a, Floats b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Floats divide(Floats a, Floats b) { return {_mm512_div_ps(a.v, b.v)}; }
inline Floats where_at_most(Floats a, Floats b, Floats then, Floats otherwise) {
    return {_mm512_mask_blend_ps(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ), otherwise.v, then.v)};
}
inline unsigned at_most(Floats a, Floats b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ); }
inline SignedInts smaller(SignedInts a, SignedInts b) { return {_mm512_min_epi32(a.v, b.v)}; }
inline SignedInts larger(SignedInts a, SignedInts b) { return {_mm512_max_epi32(a.v, b.v)}; }
inline unsigned at_most(SignedInts a, SignedInts b) {
    // As a number and not as a mask: GCC 12 stores masks in two bytes and loads four.
    return _cvtmask16_u32(_mm512_cmple_epi32_mask(a.v, b.v));
}
inline SignedInts to_compared(Floats a) { return {_mm512_castps_si512(a.v)}; }
inline void store_compared(float* to, SignedInts a) { _mm512_storeu_ps(to, _mm512_castsi512_ps(a.v)); }
inline Ints load_ints(const std::uint32_t* from) { return {_mm512_loadu_si512(from)}; }
inline void store(std::uint32_t* to, Ints a) { _mm512_storeu_si512(to, a.v); }
inline Floats to_floats(Ints a) { return {_mm512_cvtepi32_ps(a.v)}; }
inline Ints add(Ints a, std::uint32_t b) { return {_mm512_add_epi32(a.v, _mm512_set1_epi32(static_cast<int>(b)))}; }
inline Ints load_bytes(const std::byte* at) {
    return {_mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(at)))};
}
inline Numbers load_numbers(const std::byte* bytes) { return load_bytes(bytes); }
inline Numbers load_numbers(const std::uint32_t* from) { return load_ints(from); }
inline Ints load_words(const std::byte* at) {
    return {_mm512_cvtepu16_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)))};
}
inline Ints with_high_bytes(Ints words, Ints bytes) {
    return {_mm512_or_si512(words.v, _mm512_slli_epi32(bytes.v, 16))};
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
    const __m512i shifted = _mm512_srlv_epi32(spread, _mm512_load_si512(entry.shift));
    return {_mm512_and_si512(shifted, _mm512_set1_epi32(static_cast<int>((1u << width) - 1u)))};
}

/// Values by vertex, in registers.
template <unsigned groups>
struct Table {
    __m512 group[groups];
    static unsigned groups_of(unsigned) { return groups; }
    void set(unsigned number, Floats a) { group[number] = a.v; }
    /// By the low bits of each index; bits above those that number the vertices are ignored.
    [[nodiscard]] Floats look_up(Ints index) const {
        if constexpr (groups == 1) return {_mm512_permutexvar_ps(index.v, group[0])};
        else if constexpr (groups == 2) return {_mm512_permutex2var_ps(group[0], index.v, group[1])};
        else
            return {_mm512_mask_blend_ps(_mm512_test_epi32_mask(index.v, _mm512_set1_epi32(32)),
                                         _mm512_permutex2var_ps(group[0], index.v, group[1]),
                                         _mm512_permutex2var_ps(group[2], index.v, group[groups - 1]))};
    }
};
template <unsigned max_vertices, class Function>
constexpr auto with_table_groups(unsigned vertex_count, Function function) {
    if (vertex_count <= 16) return function(std::integral_constant<unsigned, 1>{});
    if (max_vertices <= 32 || vertex_count <= 32) return function(std::integral_constant<unsigned, 2>{});
    if (vertex_count <= 48) return function(std::integral_constant<unsigned, 3>{});
    return function(std::integral_constant<unsigned, 4>{});
}

/// The windows of a strip, sixteen at a time; all entries are decoded at once, as the bytes of one register.
class StripCorners {
public:
    [[gnu::always_inline]] explicit StripCorners(const StripLeaf& leaf) : pivots_(leaf.pivots) {
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
    [[gnu::always_inline]] CornerNumbers next() {
        // The last marked entry of this group that is not behind the window, or the last one of the groups before.
        const __m512i up_to_lane =
            _mm512_setr_epi32(1, 3, 7, 15, 31, 63, 127, 255, 511, 1023, 2047, 4095, 8191, 16383, 32767, 65535);
        const __m512i marked = _mm512_and_si512(_mm512_set1_epi32(static_cast<int>(pivots_ & 0xFFFF)), up_to_lane);
        const __m512i place = _mm512_sub_epi32(_mm512_set1_epi32(31), _mm512_lzcnt_epi32(marked));
        const __m512i here = to_lanes(entries_);
        const __m512i pivots =
            _mm512_mask_permutexvar_epi32(pivot_, _mm512_test_epi32_mask(marked, marked), place, here);
        const CornerNumbers numbers = {{pivots}, {to_lanes(entries_from(1))}, {to_lanes(entries_from(2))}};
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
#include <runtime/simd/predicted_points.inl>

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
/// Stores the vertices of a leaf, of which `open` has proved the numbers, axis by axis; more than there are.
inline void decode_points(const StripLeaf& leaf, std::uint32_t* x, std::uint32_t* y, std::uint32_t* z) {
    if (!fit_into_words(leaf)) return store_predicted_vertices(leaf, x, y, z);
    alignas(64) std::uint64_t words[format::max_leaf_entries];
    decode_words(leaf, predicted_from(leaf), words);
    const __m512i low = _mm512_set1_epi64((1 << axis_bits) - 1);
    for (unsigned first = 0; first < leaf.vertex_count; first += 8) {
        const __m512i eight = _mm512_load_si512(words + first);
        const auto put = [&](std::uint32_t* to, __m512i numbers) {
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + first),
                                _mm512_cvtepi64_epi32(_mm512_and_si512(numbers, low)));
        };
        put(x, eight);
        put(y, _mm512_srli_epi64(eight, axis_bits));
        put(z, _mm512_srli_epi64(eight, 2 * axis_bits));
    }
}
#endif

#include <runtime/simd/leaf_corners.inl>

}  // namespace espalier::detail::avx512
ESPALIER_END_TARGET

#endif
