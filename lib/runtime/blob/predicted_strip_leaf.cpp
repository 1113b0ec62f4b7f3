// The decoder of predicted strips.
#include <runtime/blob/vertex_word.hpp>

namespace espalier::detail {

#if ESPALIER_PREDICTED_STRIPS

namespace {

/// Where the data of a node's leaf begins: the leaves before it have their sizes in their descriptors.
const std::byte* predicted_strip_data(PackedNode node, const BlobData& blob, unsigned number) {
    using namespace format::predicted_strip;
    const std::byte* const descriptors = node.leaf_block(blob) + descriptors_at;
    const std::byte* data = descriptors + descriptor_bytes * std::size_t{node.leaf_children()};
    for (unsigned i = 0; i < number; ++i)
        data += load_u16(descriptors + descriptor_bytes * std::size_t{i}) & ((1u << entries_shift) - 1u);
    return data;
}

/// What a vertex is predicted from: entries of its strip, by their vertices.
class PredictedEntries {
public:
    explicit PredictedEntries(const StripLeaf& strip)
        : leaf_(strip),
          predicted_(format::predicted_strip::predicted_entries(strip.windows)),
          reference_at_(strip.references_at) {}

    /// Goes on to the entry; entries come in order. Returns whether it is the first use of a vertex.
    bool next(unsigned entry) {
        pivot_before_ = pivot_;
        // mutant(> -> >=) equivalent: entry 2 is not predicted, and entry 0 is the pivot before it too
        // mutant(without 1) sanitizer: shifts by more than a word has bits; no such entry is predicted
        turns_ = entry > 2 && (leaf_.pivots >> (entry - 2) & 1) != 0;
        if (turns_) pivot_ = entry - 2;
        if ((leaf_.first_uses >> entry & 1) != 0) {
            entries_[entry] = static_cast<std::uint8_t>(used_++);
            return true;
        }
        entries_[entry] = static_cast<std::uint8_t>(load_few_bits(leaf_.marks, reference_at_, leaf_.reference_width));
        reference_at_ += leaf_.reference_width;
        return false;
    }
    [[nodiscard]] bool is_predicted(unsigned entry) const { return (predicted_ >> entry & 1) != 0; }
    // The three corners of the parallelogram from which an entry is predicted, as vertices.
    [[nodiscard]] unsigned pivot_of() const { return entries_[pivot_]; }
    [[nodiscard]] unsigned before(unsigned entry) const { return entries_[entry - 1]; }
    [[nodiscard]] unsigned opposite(unsigned entry) const { return entries_[turns_ ? pivot_before_ : entry - 2]; }
    [[nodiscard]] unsigned vertex() const { return used_ - 1; }

private:
    const StripLeaf& leaf_;
    std::uint64_t predicted_;
    unsigned reference_at_, used_ = 0, pivot_ = 0, pivot_before_ = 0;
    bool turns_ = false;
    std::uint8_t entries_[format::max_leaf_entries];
};

/// Decodes the vertices of a leaf that fit. Returns as decode_predicted_vertices.
bool decode_words(const StripLeaf& leaf, PredictedVertices& vertices) {
    using namespace vertex_word;
    const FieldChoices fields(leaf);
    PredictedEntries entries(leaf);
    std::uint64_t words[format::predicted_strip::max_vertices];
    unsigned number_at = leaf.predicted.numbers_at, choice_at = leaf.predicted.choices_at;
    std::uint64_t all = 0;
    // mutant(< -> <=) sanitizer: behind the last of 64 entries it shifts by 64; behind fewer there is no first use
    for (unsigned entry = 0; entry < leaf.entry_count(); ++entry) {
        if (!entries.next(entry)) continue;
        unsigned choice = FieldChoices::not_predicted;
        std::uint64_t word = 0;
        if (entries.is_predicted(entry)) {
            choice = load_few_bits(leaf.marks, choice_at, 3);
            choice_at += 3;
            word = words[entries.pivot_of()] - words[entries.opposite(entry)] + words[entries.before(entry)] -
                   fields.half[choice];
        }
        word += fields.word(choice, load_u64(leaf.marks + number_at / 8) >> (number_at % 8));
        number_at += fields.bits[choice];
        all |= word;
        words[entries.vertex()] = word;
    }
    for (unsigned k = 0; k < 3; ++k)
        // mutant(< -> <=) sanitizer: behind the last of 56 vertices there is no word; behind fewer none is read
        for (unsigned i = 0; i < leaf.vertex_count; ++i)
            // mutant(<< -> one less) equivalent: of vertices that are kept each axis has at most 19 bits
            vertices.set(k, i, static_cast<std::uint32_t>(words[i] >> (axis_bits * k)) & ((1u << axis_bits) - 1u));
    return (all & ~fields_of(leaf.width)) == 0;
}

}  // namespace

void decode_predicted_marks(const BlobData& blob, PackedNode node, unsigned number, StripLeaf& leaf) {
    using namespace format::predicted_strip;
    leaf.node = node;
    leaf.number = static_cast<std::uint8_t>(number);
    leaf.blob = &blob;
    const std::byte* const data = predicted_strip_data(node, blob, number);
    leaf.marks = data;
    const unsigned marked =
        load_u16(node.leaf_block(blob) + descriptors_at + descriptor_bytes * std::size_t{number}) >> entries_shift;
    leaf.slot_count = static_cast<std::uint8_t>(marked + 1);
    leaf.pivots = load_many_bits(data, marks_at, marked) << 1 | 1u;
    leaf.first_uses = load_many_bits(data, marks_at + marked, marked) << 3 | 7u;
    leaf.vertex_count = static_cast<std::uint8_t>(std::popcount(leaf.first_uses));
    const unsigned joints = joint_count(data);
    std::uint64_t joined = 0;
    for (unsigned i = 0; i < joints; ++i)
        joined |= std::uint64_t{3} << load_few_bits(data, marks_at + 2 * marked + place_bits * i, place_bits);
    leaf.windows = ~joined & ~std::uint64_t{0} >> (63 - marked);
    leaf.references_at = static_cast<std::uint8_t>(references_at(marked + 3, joints));
    leaf.reference_width = static_cast<std::uint8_t>(format::strip_leaf::reference_width(leaf.vertex_count));
    leaf.predicted.choices_at = static_cast<std::uint16_t>(choices_at(marked + 3, joints, leaf.vertex_count));
    const auto predicted = static_cast<unsigned>(std::popcount(predicted_entries(leaf.windows) & leaf.first_uses));
    leaf.predicted.numbers_at = static_cast<std::uint16_t>(leaf.predicted.choices_at + 3 * predicted);
    unsigned longest = 0;
    for (int k = 0; k < 3; ++k) {
        const unsigned width = decode_axis(leaf, k);
        // mutant(> -> >=) equivalent: both sides are equal then
        longest = width > longest ? width : longest;
    }
    leaf.size_bits = static_cast<std::uint8_t>(longest);
}

bool decode_predicted_vertices(const StripLeaf& leaf, PredictedVertices& vertices) {
    // mutant(never) work: decodes axis by axis what fits into words
    // mutant(without 1) work: small code decodes by words, too, and gets the same vertices
    if (takes_shortcut() && vertex_word::fit_into_words(leaf)) return decode_words(leaf, vertices);
    const ResidualWidths widths(leaf);
    PredictedEntries entries(leaf);
    unsigned number_at = leaf.predicted.numbers_at, choice_at = leaf.predicted.choices_at;
    std::uint32_t outside = 0;
    // mutant(< -> <=) sanitizer: behind the last of 64 entries it shifts by 64; behind fewer there is no first use
    for (unsigned entry = 0; entry < leaf.entry_count(); ++entry) {
        if (!entries.next(entry)) continue;
        const bool is_predicted = entries.is_predicted(entry);
        for (unsigned k = 0; k < 3; ++k) {
            unsigned width = leaf.width[k];
            std::uint32_t point = 0;
            if (is_predicted) {
                width = load_few_bits(leaf.marks, choice_at++, 1) != 0 ? widths.large[k] : widths.small[k];
                point = vertices.get(k, entries.pivot_of()) + vertices.get(k, entries.before(entry)) -
                        vertices.get(k, entries.opposite(entry)) - (1u << width >> 1);
            }
            point += static_cast<std::uint32_t>(load_bits(leaf.marks, number_at, width));
            number_at += width;
            outside |= point >> leaf.width[k];
            vertices.set(k, entries.vertex(), point);
        }
    }
    return outside == 0;
}

void store_predicted_vertices(const StripLeaf& leaf, std::uint32_t* x, std::uint32_t* y, std::uint32_t* z) {
    PredictedVertices vertices;
    decode_predicted_vertices(leaf, vertices);
    std::uint32_t* const to[3] = {x, y, z};
    for (unsigned k = 0; k < 3; ++k)
        for (unsigned i = 0; i < leaf.vertex_count; ++i) to[k][i] = vertices.get(k, i);
}

void decode_predicted_strip(const BlobData& blob, PackedNode node, unsigned number, StripLeaf& leaf,
                            PredictedVertices& vertices) {
    decode_predicted_marks(blob, node, number, leaf);
    decode_predicted_vertices(leaf, vertices);
    use_vertices(vertices, leaf);
}

std::uint32_t first_of_predicted(const StripLeaf& leaf) {
    using namespace format::predicted_strip;
    const std::byte* const block = leaf.node.leaf_block(*leaf.blob);
    std::uint32_t first = load_u32(block);
    const std::byte* data = predicted_strip_data(leaf.node, *leaf.blob, 0);
    for (unsigned i = 0; i < leaf.number; ++i) {
        const unsigned descriptor = load_u16(block + descriptors_at + descriptor_bytes * std::size_t{i});
        first += (descriptor >> entries_shift) + 1 - 2 * joint_count(data);
        data += descriptor & ((1u << entries_shift) - 1u);
    }
    return first;
}

#endif

}  // namespace espalier::detail
