// What instruction sets of four lanes share. They have no permutation over several registers: values by vertex are in
// memory, and the numbers of the vertices stay out of the lanes.

inline Ints unpack(const std::byte* stream, unsigned width, unsigned first) {
    const unsigned half = first / 4 % 2;
    const std::byte* at = stream + first / 8 * width + half * (width / 2);
    const UnpackEntry& entry = unpack_table[width];
    // Not all can shift lanes right by different counts: multiplying shifts each left to a common place.
    const Ints raised =
        shuffle_bytes(at, entry.shuffle + 16 * half) * load_ints(unpack_raise_table[width].data() + 4 * half);
    return raised >> unpack_raised_bits & load_ints(entry.mask);
}

inline Axes words_to_axes(const std::byte* at) { return to_floats(load_words(at)); }
inline Axes bytes_to_axes(std::uint32_t bytes) { return bytes_to_floats(reinterpret_cast<const std::byte*>(&bytes)); }

/// A vertex for each lane, and the three vertices of a triangle in each.
struct Numbers {
    std::uint32_t at[lanes];
};
struct CornerNumbers {
    Numbers a, b, c;
};
inline Numbers load_numbers(const std::byte* bytes) {
    return {{load_u8(bytes), load_u8(bytes + 1), load_u8(bytes + 2), load_u8(bytes + 3)}};
}
inline Numbers load_numbers(const std::uint32_t* from) { return {{from[0], from[1], from[2], from[3]}}; }

template <unsigned groups>
struct Table {
    alignas(16) float value[groups * lanes] = {};
    static unsigned groups_of(unsigned vertex_count) { return (vertex_count + lanes - 1) / lanes; }
    void set(unsigned number, Floats a) { store(value + lanes * number, a); }
    [[nodiscard]] Floats look_up(const Numbers& index) const { return look_up_among<groups>(index); }
    /// Where only the first groups are set.
    template <unsigned used>
    [[nodiscard]] Floats look_up_among(const Numbers& index) const {
        const auto at = [&](unsigned lane) {  // any index must stay inside
            constexpr std::uint32_t last = used * lanes - 1;
            const std::uint32_t number = index.at[lane];
            return value + (std::has_single_bit(used) ? number & last : number < last ? number : last);
        };
        return Floats{*at(0), *at(1), *at(2), *at(3)};
    }
};
template <unsigned groups>
using PairTable = PairTableIn<Table<groups>>;

#include <runtime/lanes/strip_corners_portable.inl>
