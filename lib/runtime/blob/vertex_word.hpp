// A vertex of a predicted strip as one word, with 21 bits for each axis. Sums and differences of such words are those
// of all axes at once: what intermediate ones borrow from the next axis they give back. A sum that is below 0 on an
// axis, or too large, has one of the upper two bits of a field set.
#pragma once

#include <runtime/blob/strip_leaf.hpp>

#if ESPALIER_PREDICTED_STRIPS

namespace espalier::detail::vertex_word {

/// Whether a leaf's numbers fit into words: a vertex takes at most 57 bits, and each number at most 19 of 21.
inline bool fit_into_words(const StripLeaf& leaf) {
    unsigned widest = leaf.size_bits;
    // mutant(> -> >=) equivalent: both sides are equal then
    for (const unsigned width : ResidualWidths(leaf).large) widest = width > widest ? width : widest;
    // mutant(<= -> <) work: decodes axis by axis what fits into words
    return widest <= 19;
}

constexpr unsigned axis_bits = 21;

constexpr std::uint64_t field(unsigned width, unsigned axis) {
    return ((std::uint64_t{1} << width) - 1) << (axis_bits * axis);
}
inline std::uint64_t fields_of(const std::uint8_t* widths) {
    return field(widths[0], 0) | field(widths[1], 1) | field(widths[2], 2);
}

/// The fields of a vertex by its choice of widths, bit k for axis k: where they belong in a word, how far they move to
/// get there, and how many bits they take; and half of their ranges. Behind the eight choices a vertex that is not
/// predicted.
struct FieldChoices {
    static constexpr unsigned not_predicted = 8;

    std::uint64_t spread[not_predicted + 1];
    std::uint64_t half[not_predicted + 1];
    std::uint8_t move_second[not_predicted + 1];
    std::uint8_t move_third[not_predicted + 1];
    std::uint8_t bits[not_predicted + 1];

    explicit FieldChoices(const StripLeaf& leaf) {
        const ResidualWidths widths(leaf);
        std::uint8_t chosen[3];
        // mutant(< -> <=) equivalent: what it puts behind the choices is replaced
        for (unsigned choice = 0; choice < not_predicted; ++choice) {
            half[choice] = 0;
            for (unsigned k = 0; k < 3; ++k) {
                const unsigned width = (choice >> k & 1) != 0 ? widths.large[k] : widths.small[k];
                chosen[k] = static_cast<std::uint8_t>(width);
                half[choice] |= (std::uint64_t{1} << width >> 1) << (axis_bits * k);
            }
            put(choice, chosen);
        }
        half[not_predicted] = 0;
        put(not_predicted, leaf.width);
    }

    /// What the low bits of a stream are as a word.
    [[nodiscard]] std::uint64_t word(unsigned choice, std::uint64_t stream) const {
        constexpr std::uint64_t second = field(axis_bits, 1), third = field(axis_bits, 2);
        const std::uint64_t moved = (stream & field(axis_bits, 0)) | (stream << move_second[choice] & second) |
                                    (stream << move_third[choice] & third);
        return moved & spread[choice];
    }

private:
    void put(unsigned choice, const std::uint8_t* widths) {
        spread[choice] = fields_of(widths);
        const unsigned two = unsigned{widths[0]} + widths[1];
        move_second[choice] = static_cast<std::uint8_t>(axis_bits - widths[0]);
        move_third[choice] = static_cast<std::uint8_t>(2 * axis_bits - two);
        bits[choice] = static_cast<std::uint8_t>(two + widths[2]);
    }
};

}  // namespace espalier::detail::vertex_word

#endif
