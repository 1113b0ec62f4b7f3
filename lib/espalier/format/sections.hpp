// The sections of a blob other than its nodes and leaves: source table, original ids, copies, edge flags, bounds,
// corners, vertex sources and origin of the source. A blob consists of nodes, leaves and a guard, followed by those of
// these sections that it has, in this order, each padded with zeros to a multiple of 4 bytes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/format/header.hpp>

namespace espalier::format {

inline constexpr std::size_t guard_bytes = 64;  ///< zeros after the leaves, so that wide loads stay inside the blob

namespace source {                          // an entry of the source table
inline constexpr std::size_t first_at = 0;  // u32, original id of the first triangle; ascending from 0
inline constexpr std::size_t file_at = 4;   // u32
inline constexpr std::size_t mesh_at = 8;   // u32
inline constexpr std::size_t bytes = 12;
}  // namespace source

// The section of original ids. The number of a triangle is corner_factor * its original id + its first corner, which
// tells which corner of the original triangle is stored first (0, 1 or 2; the others follow in order).
//
// Numbers are stored in blocks of consecutive storage indices, and the blocks are divided into runs; without the
// feature id_runs, a block is a single run. A block begins with its first number, in number_bits, and a step leads to
// each of the others. A step is the prefix of a kind followed by a field, and stands for the number (recent number
// `from` + offset + field) modulo 2^number_bits. At the beginning of a run, all recent numbers equal the first number
// of the block. Each new number is put in front of the recent ones, and the one at `replaced` is dropped.
//
// First come the 2^id_kind_bits kinds. The next id_kind_bits bits of a step are the index of its kind, of which the
// prefix is only as many bits as the kind states. Then come the bits of all runs, id_step_bytes in total, low bits
// first, each run padded with zero bits to a byte; and finally the positions at which each block and its runs begin.
namespace ids {
inline constexpr unsigned max_kind_bits = 7;
inline constexpr std::size_t offset_at = 0;    // u32, of a kind
inline constexpr std::size_t width_at = 4;     // u8, at most number_bits
inline constexpr std::size_t prefix_at = 5;    // u8, at most id_kind_bits
inline constexpr std::size_t from_at = 6;      // u8, below recent_numbers
inline constexpr std::size_t replaced_at = 7;  // u8, below recent_numbers
inline constexpr std::size_t kind_bytes = 8;
inline constexpr unsigned recent_numbers = 8;
inline constexpr std::uint32_t block_triangles = 128;
inline constexpr std::size_t begin_at = 0;      // u32, where a block's bits begin, in bytes from those of the first
inline constexpr std::size_t runs_at = 4;       // u32, where its runs 1, 2 and 3 begin, in bytes from the block's bits
inline constexpr unsigned run_begin_bits = 10;  // bits for each of these runs, run 1 lowest; 0 if there is no such run
constexpr std::uint32_t run_triangles(bool has_runs) { return has_runs ? 32 : block_triangles; }
constexpr std::size_t block_bytes(bool has_runs) { return has_runs ? 8 : runs_at; }
constexpr std::uint32_t block_count(std::uint32_t triangle_count) {
    return (triangle_count + block_triangles - 1) / block_triangles;
}
/// Returns 3 for strips, which rotate the corners of a triangle as they need to, and 1 for plain leaves.
constexpr std::uint32_t corner_factor(Profile profile) { return profile == Profile::fast ? 1 : 3; }
/// All numbers are below this limit, which is at most 2^32.
constexpr std::uint64_t number_limit(Profile profile, std::uint32_t source_triangles) {
    return std::uint64_t{corner_factor(profile)} * source_triangles;
}
constexpr unsigned number_bits(std::uint64_t number_limit) {
    return number_limit == 0 ? 0 : static_cast<unsigned>(std::bit_width(number_limit - 1));
}
}  // namespace ids

// The section of split references, which tells which storage indices are copies, and of which triangle. The lowest
// storage index of a triangle is its owner. Its copies have the same corners in the same order, and lie in leaves whose
// boxes contain other parts of it. Profile fast only.
//
// Layout: u32 number of copies; for each 256 storage indices or part of them, a block of u32 number of copies before it
// and one bit per index, low bits first, set for copies; then u32 owner for each copy, in storage order.
namespace copies {
inline constexpr std::size_t count_at = 0;
inline constexpr std::size_t blocks_at = 4;
inline constexpr std::uint32_t block_indices = 256;
inline constexpr std::size_t bits_at = 4;  // within a block
inline constexpr std::size_t block_bytes = 36;
inline constexpr std::size_t owner_bytes = 4;
static_assert(bits_at + block_indices / 8 == block_bytes);
constexpr std::uint32_t block_count(std::uint32_t triangle_count) {
    return (triangle_count + block_indices - 1) / block_indices;
}
constexpr std::uint64_t blocks_bytes(std::uint32_t triangle_count) {
    return std::uint64_t{block_count(triangle_count)} * block_bytes;
}
}  // namespace copies

// The section of edge flags: u32 squared sine of the largest angle that counts as flat, in units of 2^-24; then 6 bits
// for each storage index, 2 for each edge from corner e to the next: flat, convex, concave or boundary.
namespace edge_flags {
inline constexpr std::size_t flat_limit_at = 0;
inline constexpr std::size_t fields_at = 4;
inline constexpr unsigned edge_bits = 2;
inline constexpr unsigned triangle_bits = 3 * edge_bits;
inline constexpr std::uint32_t max_flat_limit = 1u << 24;
}  // namespace edge_flags

// The bounds of the whole asset, in this order, each with a feature bit of its own.
namespace bounds {
/// Lengths of the oriented box and the sphere are multiples of a sixteenth of a lattice step. All numbers, except those
/// of the quaternion, are within +-max_length.
inline constexpr int units_per_step = 16;
inline constexpr std::int32_t max_length = 1 << 29;

// The oriented box: a rotation as a quaternion of integers w x y z, 4 x i16, whose integer matrix has perpendicular
// rows of length w^2 + x^2 + y^2 + z^2 (lib/runtime/blob/stored_bounds.hpp); then lo and hi along each row, 6 x i32.
inline constexpr std::size_t quaternion_at = 0;
inline constexpr std::size_t lo_at = 8;
inline constexpr std::size_t hi_at = 20;
inline constexpr std::size_t oriented_box_bytes = 32;
inline constexpr std::int32_t max_quaternion = 2047;

// The sphere: center, 3 x i32, and radius, u32.
inline constexpr std::size_t center_at = 0;
inline constexpr std::size_t radius_at = 12;
inline constexpr std::size_t sphere_bytes = 16;

// The 26-DOP: the smallest and largest value that each sum below takes over all vertices, in lattice steps, 2 x i32.
// The three axes are in the header.
inline constexpr unsigned k_dop_directions = 10;
inline constexpr std::int8_t k_dop_direction[k_dop_directions][3] = {{1, 1, 0},  {1, -1, 0}, {1, 0, 1}, {1, 0, -1},
                                                                     {0, 1, 1},  {0, 1, -1}, {1, 1, 1}, {1, 1, -1},
                                                                     {1, -1, 1}, {1, -1, -1}};
inline constexpr std::size_t k_dop_bytes = 8 * k_dop_directions;

constexpr std::size_t bytes(std::uint32_t features) {
    return ((features & feature::oriented_box) != 0 ? oriented_box_bytes : 0) +
           ((features & feature::bounding_sphere) != 0 ? sphere_bytes : 0) +
           ((features & feature::k_dop) != 0 ? k_dop_bytes : 0);
}
}  // namespace bounds

// The section of corners, which never move. For each leaf, beginning at three times the storage index of its first
// triangle, it holds the three rows of corners that other blobs of profile fast store in the leaf itself (leaves.hpp).
// Padded to 4 bytes and followed by a guard.
namespace corners {
inline constexpr std::size_t triangle_bytes = 3;
inline constexpr std::size_t guard_bytes = format::guard_bytes;  ///< zeros, so that wide loads stay inside the blob
/// Returns the size of the section in bytes, without its guard.
constexpr std::size_t padded_bytes(std::uint32_t triangle_count) {
    return (std::size_t{triangle_count} * triangle_bytes + 3) / 4 * 4;
}
}  // namespace corners

// The section of vertex sources: for each vertex of each leaf, the index of its position in the sources, which number
// the positions of all meshes consecutively, including those that no triangle uses. Leaves are in the order of their
// nodes' numbers, and within a node in the order of its children.
namespace vertex_sources {
/// Returns the width of such an index in bits: u16 where that suffices, otherwise u32.
constexpr unsigned number_bits(std::uint32_t position_count) { return position_count <= 0x10000 ? 16 : 32; }
}  // namespace vertex_sources

// The section of the origin: 3 x f64, finite: the point of the source at which the blob's coordinates are 0 0 0.
namespace source_origin {
inline constexpr std::size_t bytes = 24;
}  // namespace source_origin

}  // namespace espalier::format
