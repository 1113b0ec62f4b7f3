// A strip as profile `tiny` stores it: what its vertices differ by from what the triangles before predict. The layout
// is in format/leaves.hpp, at `predicted_strip`. Prediction by parallelograms goes back to Touma and Gotsman (1998).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/numbered_entries.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Widths of the offsets in a leaf's box, axis by axis.
using OffsetWidths = std::array<unsigned, 3>;
[[nodiscard]] OffsetWidths offset_widths(const BinaryNode& node);

struct PredictedStrip {
    struct Vertex {
        bool is_predicted = false;
        std::array<std::int32_t, 3> numbers{};  ///< residuals of a predicted one, else coordinates
    };

    NumberedEntries numbered;
    std::array<Vertex, format::max_leaf_entries> vertices{};
    std::array<std::uint8_t, format::predicted_strip::max_joints> joints{};  ///< the first window of each
    unsigned joint_count = 0;
    unsigned predicted_count = 0;
    std::array<unsigned, 3> large_width{};
    std::array<unsigned, 3> small_width{};

    PredictedStrip(const LatticeMesh& mesh, const Strip& strip);

    /// Returns whether the residual of a predicted vertex takes the larger width.
    [[nodiscard]] bool is_large(unsigned vertex, std::size_t axis) const;
    /// Returns the bits of the whole leaf but its descriptor.
    [[nodiscard]] std::size_t bits(const OffsetWidths& offsets) const;

private:
    void predict(const LatticeMesh& mesh, const Strip& strip);
    void choose_widths(std::size_t axis);

    unsigned entry_count_;
    std::size_t residual_bits_ = 0;
};

}  // namespace espalier::baker
