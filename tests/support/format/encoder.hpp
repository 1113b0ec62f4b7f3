// An encoder of blobs that was written from docs/format.md alone and shares no code with the baker: it writes any tree
// that it is given, also one that no baker would make.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <espalier/format.hpp>

#include "decoder.hpp"

namespace espalier::tests {

/// A leaf of either kind: those of profile `fast` have triangles, strips have entries.
struct PlainLeaf {
    std::vector<GridPoint> vertices;
    std::vector<std::array<std::uint8_t, 3>> triangles;
    struct Entry {
        unsigned vertex = 0;       ///< one more than all before means a first use
        bool is_pivot = false;     ///< of entry 0: true
        bool is_triangle = false;  ///< the window that begins here; of the last two entries: false
    };
    std::vector<Entry> entries;
    std::vector<std::uint32_t> sources;  ///< of a deformable blob: the position that each vertex is

    [[nodiscard]] std::vector<GridTriangle> corners() const;
};

/// A child's box in planes of its node; below it a node or a leaf. Planes are below 256 in profiles with strips.
struct PlainChild {
    std::array<std::uint16_t, 3> low{};
    std::array<std::uint16_t, 3> high{};
    std::size_t node = 0;  ///< of a node: its place in PlainBlob::nodes
    std::optional<PlainLeaf> leaf;
};

/// A node of either kind: up to 16 children in profile `fast`, else 8.
struct PlainNode {
    std::array<std::uint32_t, 3> base{};  ///< in units of 2^max(0, bits - 16); not in profile `fast`
    std::array<unsigned, 3> shift{};      ///< not in profile `fast`
    std::vector<PlainChild> children;     ///< nodes first

    [[nodiscard]] GridBox box_of(const PlainChild& child, Profile profile, unsigned bits) const;
};

/// How a step from id to id may be written.
struct PlainIdKind {
    std::uint32_t offset = 0;
    unsigned width = 0, prefix = 0, from = 0, replaced = 0;
};

/// What a blob holds. `decoded` gives the header and the optional sections; its nodes, triangles and corner sources are
/// not looked at.
struct PlainBlob {
    DecodedBlob decoded;
    /// A row for each value of the bits that a step begins with: 1, 2, 4 .. 128. Rows that agree in the low `prefix`
    /// bits are the same kind, and the first takes every step. Each step is written by the row that follows the last
    /// one's, of those that take it.
    std::vector<PlainIdKind> id_kinds = {{}};
    std::vector<PlainNode> nodes;  ///< the root first; each is the child of one other
};

/// The bytes, in the order of section 6, with the counts that follow and the checksum.
std::vector<std::byte> encode(const PlainBlob& blob);

}  // namespace espalier::tests
