// The vertices of a predicted strip for instruction sets that spread bits over a word (BMI2): a vertex is one word,
// with 21 bits for each axis. Sums and differences of such words are those of all axes at once: no result is below 0 or
// too large, as `open` proves, and what intermediate ones borrow from the next axis they give back.

/// For each vertex, by the number of another: the pivot, the entry before and the corner opposite of the edge between
/// both. All three are `none` where the vertex is not predicted.
struct PredictedFrom {
    static constexpr unsigned none = format::max_leaf_entries - 1;
    static_assert(none >= StripLeaf::max_vertices);

    // What is stored eight entries at a time may pass the last one.
    alignas(64) std::uint8_t pivot[format::max_leaf_entries + 8];
    alignas(64) std::uint8_t before[format::max_leaf_entries + 8];
    alignas(64) std::uint8_t opposite[format::max_leaf_entries + 8];
};

using vertex_word::axis_bits;
using vertex_word::FieldChoices;
using vertex_word::fit_into_words;

constexpr std::uint64_t every_byte = 0x0101010101010101;

/// The choice of each vertex, eight bytes at a time.
ESPALIER_ALWAYS_INLINE inline void decode_choices(const StripLeaf& leaf, std::uint8_t* choices) {
    const std::uint64_t predicted =
        _pext_u64(format::predicted_strip::predicted_entries(leaf.windows), leaf.first_uses);
    unsigned at = leaf.predicted.choices_at;
    for (unsigned first = 0; first < leaf.vertex_count; first += 8) {
        const std::uint64_t here = _pdep_u64(predicted >> first, every_byte);
        const std::uint64_t eight = _pdep_u64(load_u32(leaf.marks + at / 8) >> (at % 8), 7 * here) |
                                    (every_byte - here) * FieldChoices::not_predicted;
        ESPALIER_COPY_BYTES(choices + first, &eight, sizeof eight);
        at += 3 * static_cast<unsigned>(std::popcount(here));
    }
}

/// The vertices as words, one after the other.
ESPALIER_ALWAYS_INLINE inline void decode_words(const StripLeaf& leaf, const PredictedFrom& from,
                                                std::uint64_t* words) {
    const FieldChoices fields(leaf);
    std::uint8_t choices[format::max_leaf_entries];
    decode_choices(leaf, choices);
    words[PredictedFrom::none] = 0;
    std::uint64_t at = leaf.predicted.numbers_at;
    const unsigned count = leaf.vertex_count;
    for (unsigned i = 0; i < count; ++i) {
        const unsigned choice = choices[i];
        const std::uint64_t stream = load_u64(leaf.marks + at / 8) >> (at % 8);
        const std::uint64_t residual = _pdep_u64(stream, fields.spread[choice]) - fields.half[choice];
        at += fields.bits[choice];
        words[i] = (words[from.pivot[i]] - words[from.opposite[i]] + residual) + words[from.before[i]];
    }
}

PredictedFrom predicted_from(const StripLeaf& leaf);  // of the instruction set

/// Stores the vertices of a leaf, of which `open` has proved the numbers, axis by axis; more than there are.
inline void decode_points(const StripLeaf& leaf, std::uint32_t* x, std::uint32_t* y, std::uint32_t* z) {
    if (!fit_into_words(leaf)) return store_predicted_vertices(leaf, x, y, z);
    alignas(64) std::uint64_t words[format::max_leaf_entries];
    decode_words(leaf, predicted_from(leaf), words);
    for (unsigned first = 0; first < leaf.vertex_count; first += 8) {
        store_fields<0>(x + first, words + first);
        store_fields<axis_bits>(y + first, words + first);
        store_fields<2 * axis_bits>(z + first, words + first);
    }
}
