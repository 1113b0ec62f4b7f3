// Where things lie in a blob: its sections, its nodes, its leaves. For showing bytes; queries have their own decoder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>

namespace espalier::tools {

std::uint32_t read_u8(std::span<const std::byte> bytes, std::size_t at);
std::uint32_t read_u16(std::span<const std::byte> bytes, std::size_t at);
std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t at);
float read_f32(std::span<const std::byte> bytes, std::size_t at);
/// A field of up to 32 bits, low bits first.
std::uint32_t read_bits(std::span<const std::byte> bytes, std::size_t bit, unsigned width);

struct Section {
    const char* name;
    std::size_t at;
    std::size_t bytes;
};

/// Every byte of an opened blob belongs to exactly one of them.
std::vector<Section> sections_of(const Blob& blob);
const Section& section_named(const std::vector<Section>& sections, std::string_view name);

/// One node's fields as they stand in the bytes.
struct NodeFields {
    std::uint32_t base[3];
    std::uint32_t shifts[3];
    std::uint32_t first_child;
    unsigned node_children;
    unsigned leaves;
    std::uint32_t leaf_block;
};

/// The node whose bytes start at `at`.
NodeFields read_node(std::span<const std::byte> bytes, std::size_t at);
/// How many lattice steps the box of a child of a node reaches over.
std::uint32_t side_of_child(std::span<const std::byte> bytes, std::size_t node, unsigned child, unsigned axis);

/// The descriptor of a plain leaf, taken apart.
struct LeafFields {
    std::size_t data_offset;  ///< from the end of the block's descriptors
    unsigned triangles;
    unsigned vertices;
    unsigned size_bits;   ///< coordinates of an axis differ by less than 2^size_bits
    std::uint32_t first;  ///< its first triangle, counted from the block's
};

LeafFields read_leaf(std::uint32_t descriptor);

/// The descriptor of a strip leaf, taken apart.
struct StripFields {
    std::size_t data_offset;  ///< from the end of the block's descriptors
    unsigned entries;
    std::uint32_t first;  ///< its first triangle, counted from the block's
};

StripFields read_strip(std::uint32_t descriptor);

struct StripMarks {
    std::vector<std::uint32_t> entries;  ///< vertex numbers
    std::vector<bool> pivots;            ///< of each entry
    std::vector<bool> triangles;         ///< of each window
    unsigned vertices;
    std::size_t bits;
};

/// The marks that start at byte `at`, of a leaf with so many entries.
StripMarks read_marks(std::span<const std::byte> bytes, std::size_t at, unsigned entries);

std::uint64_t leaf_count(std::span<const std::byte> bytes, const Blob& blob);

const char* name_of(format::Profile profile);
/// As eight hexadecimal digits.
std::string checksum_text(std::uint32_t checksum);
/// The set bits, by name.
std::vector<std::string> feature_names(std::uint32_t features);

}  // namespace espalier::tools
