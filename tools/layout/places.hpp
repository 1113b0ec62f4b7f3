// Where things lie in a blob or a scene: sections, nodes, leaves, parts. For showing bytes; queries have their own
// decoder.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>
#include <espalier/scene.hpp>

#include "report/json.hpp"

namespace espalier::tools {

using Bytes = std::span<const std::byte>;

/// A field of up to 32 bits, low bits first.
std::uint32_t read_bits(Bytes bytes, std::size_t bit, unsigned width);
inline std::uint32_t read_u8(Bytes bytes, std::size_t at) { return read_bits(bytes, 8 * at, 8); }
inline std::uint32_t read_u16(Bytes bytes, std::size_t at) { return read_bits(bytes, 8 * at, 16); }
inline std::uint32_t read_u32(Bytes bytes, std::size_t at) { return read_bits(bytes, 8 * at, 32); }
inline double read_f64(Bytes bytes, std::size_t at) {
    return std::bit_cast<double>(std::uint64_t{read_u32(bytes, at + 4)} << 32 | read_u32(bytes, at));
}
inline float read_f32(Bytes bytes, std::size_t at) { return std::bit_cast<float>(read_u32(bytes, at)); }

struct Section {
    const char* name;
    std::size_t at;
    std::size_t bytes;
};

/// Every byte of an opened blob belongs to exactly one of them.
std::vector<Section> sections_of(const Blob& blob);
const Section& section_named(const std::vector<Section>& sections, std::string_view name);

/// The bits of a number in the section of vertex sources.
unsigned vertex_source_bits(const Blob& blob);

/// What every kind of node holds, as it stands in the bytes.
struct NodeFields {
    std::size_t at;  ///< of its first byte
    std::uint32_t first_child;
    unsigned node_children;
    unsigned leaves;
    std::uint32_t leaf_block;
};

NodeFields read_node(Bytes bytes, const Blob& blob, std::size_t node);

/// The packed node whose bytes begin at `at`.
NodeFields read_packed_node(Bytes bytes, std::size_t at);

/// The shift of an axis of the packed node whose bytes begin at `at`.
unsigned read_shift(Bytes bytes, std::size_t at, unsigned axis);
/// How many lattice steps the box of a child of the packed node whose bytes begin at `at` reaches over.
std::uint32_t side_of_child(Bytes bytes, std::size_t at, unsigned child, unsigned axis);

/// The descriptor of a plain leaf, taken apart.
struct LeafFields {
    std::uint32_t data_offset;  ///< from the start of the block, in units of 4 bytes
    unsigned triangles;
    unsigned vertices;
    unsigned size_bits;  ///< coordinates of an axis differ by less than 2^size_bits
};

/// The leaf with this number among the leaves of the plain node whose bytes begin at `at`.
LeafFields read_leaf(Bytes bytes, const Blob& blob, std::size_t at, unsigned leaf);

/// The descriptor of a strip leaf, taken apart.
struct StripFields {
    std::size_t data_offset;  ///< from the end of the block's descriptors
    unsigned entries;
    std::uint32_t first;  ///< its first triangle, counted from the block's
};

StripFields read_strip(std::uint32_t descriptor);

/// The descriptor of a predicted strip, taken apart.
struct PredictedFields {
    std::size_t bytes;  ///< of its data
    unsigned entries;
};

PredictedFields read_predicted_strip(std::uint32_t descriptor);

struct StripMarks {
    std::vector<std::uint32_t> entries;  ///< vertex numbers
    std::vector<bool> pivots;            ///< of each entry
    std::vector<bool> triangles;         ///< of each window
    unsigned vertices;
    std::size_t bits;
};

/// The marks that start at byte `at`, of a leaf with so many entries. The widths of a predicted strip are among the
/// bits.
StripMarks read_marks(Bytes bytes, std::size_t at, unsigned entries, bool is_predicted);

std::uint64_t leaf_count(Bytes bytes, const Blob& blob);

const std::string& name_of(Profile profile);
/// As eight hexadecimal digits.
std::string checksum_text(std::uint32_t checksum);
/// The set bits, by name.
std::vector<std::string> feature_names(std::uint32_t features);

/// Returns the largest angle of a flat edge in degrees: the shortest number that a bake stores as this blob does.
/// Nothing without edge flags.
std::optional<double> flat_angle_of(const Blob& blob);

/// The figures of a deformable blob.
struct Motion {
    std::uint32_t positions = 0;   ///< that refit() takes
    Box range;                     ///< in which they must lie
    std::size_t moving_bytes = 0;  ///< in the caller's memory; the rest may stay in flash
};

Motion motion_of(const Blob& blob);

/// Returns the keys positions, range, moving_bytes and moving_bytes_per_triangle.
Json motion_json(const Blob& blob);

struct ScenePart {
    std::size_t at;
    std::size_t bytes;
};

/// The parts of an opened scene; the bytes between them are padding.
struct SceneLayout {
    ScenePart part_sizes;
    std::vector<ScenePart> parts;  ///< meshes, then tiles
    std::size_t mesh_count;
    ScenePart nodes;
    ScenePart instances;
    std::size_t padding;  ///< bytes in all

    /// Returns the bytes of all meshes that are not in tiles.
    [[nodiscard]] std::size_t mesh_bytes() const;
    /// Returns the bytes of all tiles.
    [[nodiscard]] std::size_t tile_bytes() const;
};

SceneLayout layout_of(Bytes bytes, const BakedScene& scene);

}  // namespace espalier::tools
