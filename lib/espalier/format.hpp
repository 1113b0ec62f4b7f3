// The bytes of a blob: every offset, width and limit, once. docs/format.md is the normative text.
// All numbers are little-endian; nothing is aligned to more than a byte when read, so that a blob may lie anywhere.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace espalier {

/// The encoding of nodes and leaves, and with it the largest number of triangles in a leaf. The numbers are stable.
enum class Profile : std::uint8_t {
    fast = 0,      ///< plain nodes, plain leaves: the fastest rays, the largest blobs
    balanced = 1,  ///< packed nodes, strip leaves of at most max_balanced_entries
    small = 2,     ///< packed nodes, strip leaves of at most max_small_entries
    tiny = 3,      ///< packed nodes, predicted strips: the smallest blobs, the slowest rays
};

}  // namespace espalier

namespace espalier::format {

/// The format's version, apart from the library's. Readers accept the same major and a minor up to their own.
inline constexpr std::uint16_t version_major = 2;
inline constexpr std::uint16_t version_minor = 0;
inline constexpr std::uint32_t magic = 0x4C505345u;  // "ESPL"

// ---- limits -------------------------------------------------------------------------------------------------------
inline constexpr int max_bits = 24;             ///< lattice bits per axis: integers that float32 holds exactly
inline constexpr int min_step_exponent = -100;  ///< step = 2^exponent
inline constexpr int max_step_exponent = 100;
inline constexpr std::uint32_t max_nodes = 1u << 24;
inline constexpr unsigned max_depth = 16;           ///< nodes on the longest way down; sizes every query's stack
inline constexpr unsigned max_children = 16;        ///< of any profile
inline constexpr unsigned max_leaf_triangles = 62;  ///< of any profile
inline constexpr unsigned max_leaf_vertices = 56;
inline constexpr unsigned max_leaf_entries = 64;  ///< of a strip
inline constexpr std::uint32_t max_triangles = 0x7FFFFFFFu;

// ---- header: 128 bytes --------------------------------------------------------------------------------------------
namespace header {
inline constexpr std::size_t magic_at = 0;              // u32
inline constexpr std::size_t version_major_at = 4;      // u16
inline constexpr std::size_t version_minor_at = 6;      // u16
inline constexpr std::size_t total_bytes_at = 8;        // u32, the whole blob
inline constexpr std::size_t checksum_at = 12;          // u32, CRC-32 (IEEE 802.3) of the blob with this field zero
inline constexpr std::size_t features_at = 16;          // u32, see `feature`
inline constexpr std::size_t profile_at = 20;           // u8, see espalier::Profile
inline constexpr std::size_t bits_at = 21;              // u8, 1..24: coordinates are below 2^bits
inline constexpr std::size_t step_exponent_at = 22;     // i16
inline constexpr std::size_t triangle_count_at = 24;    // u32
inline constexpr std::size_t vertex_count_at = 28;      // u32, distinct lattice points
inline constexpr std::size_t node_count_at = 32;        // u32, 0 only for an empty mesh
inline constexpr std::size_t leaf_bytes_at = 36;        // u32, a multiple of 4
inline constexpr std::size_t origin_at = 40;            // 3 x f32, of lattice point 0 0 0; a multiple of the step
inline constexpr std::size_t extent_at = 52;            // 3 x u32, largest coordinate per axis (the smallest is 0)
inline constexpr std::size_t max_error_at = 64;         // f32, the blob's units
inline constexpr std::size_t depth_at = 68;             // u8
inline constexpr std::size_t id_kind_bits_at = 69;      // u8, 0..7, see `ids`
inline constexpr std::size_t source_count_at = 72;      // u32, entries of the source table
inline constexpr std::size_t source_triangles_at = 76;  // u32, triangles in the sources, dropped ones included
inline constexpr std::size_t id_step_bytes_at = 80;     // u32, see `ids`
inline constexpr std::size_t reserved_at = 84;          // zero up to the end (and the two bytes at 70)
inline constexpr std::size_t bytes = 128;
static_assert(reserved_at < bytes && bytes % 64 == 0);
}  // namespace header

/// Bits of the features field. An optional section is there exactly when its bit is set; they follow in bit order.
namespace feature {
inline constexpr std::uint32_t original_ids = 1u << 0;
inline constexpr std::uint32_t materials_8 = 1u << 1;
inline constexpr std::uint32_t materials_16 = 1u << 2;      // never together with materials_8
inline constexpr std::uint32_t closed = 1u << 3;            // no bytes: the triangles' boundary cancels along lines
inline constexpr std::uint32_t split_references = 1u << 4;  // triangles have copies in several leaves, see `copies`
inline constexpr std::uint32_t edge_flags = 1u << 5;        // see `edge_flags` below
inline constexpr std::uint32_t oriented_box = 1u << 6;      // see `bounds`, also for the next two
inline constexpr std::uint32_t bounding_sphere = 1u << 7;
inline constexpr std::uint32_t k_dop = 1u << 8;
inline constexpr std::uint32_t bounds = oriented_box | bounding_sphere | k_dop;
inline constexpr std::uint32_t known =
    original_ids | materials_8 | materials_16 | closed | split_references | edge_flags | bounds;
}  // namespace feature

// ---- sections ------------------------------------------------------------------------------------------------------
// In this order: nodes, leaves, guard, then the optional ones; each of these padded with zeros to 4 bytes.
inline constexpr std::size_t guard_bytes = 64;  ///< zeros after the leaves, so that wide loads stay inside the blob

namespace source {                          // one entry of the source table
inline constexpr std::size_t first_at = 0;  // u32, original id of its first triangle; ascending, the first is 0
inline constexpr std::size_t file_at = 4;   // u32
inline constexpr std::size_t mesh_at = 8;   // u32
inline constexpr std::size_t bytes = 12;
}  // namespace source

// The section of original ids. The number of a triangle is corner_factor * its original id + its first corner: which of
// the original triangle's corners is stored first (0, 1 or 2; the others follow in its order). Numbers lie in blocks
// of consecutive storage indices: the first in number_bits, then a step to each of the others. A step is the prefix of
// a kind and a field; it leads to the recent number `from` + offset + field, modulo 2^number_bits. Recent numbers are
// all the block's first one at its begin; then each new one is put in front, and the one at `replaced` is lost.
// 2^id_kind_bits kinds: the next id_kind_bits bits are the number of the kind, its prefix is as many of them as the
// kind has. Then the blocks' bits, in id_step_bytes together, low bits first, each block padded with zero bits to a
// byte; then where each begins.
namespace ids {
inline constexpr unsigned max_kind_bits = 7;
inline constexpr std::size_t offset_at = 0;    // u32, in a kind
inline constexpr std::size_t width_at = 4;     // u8, at most number_bits
inline constexpr std::size_t prefix_at = 5;    // u8, at most id_kind_bits
inline constexpr std::size_t from_at = 6;      // u8, below recent_numbers
inline constexpr std::size_t replaced_at = 7;  // u8, below recent_numbers
inline constexpr std::size_t kind_bytes = 8;
inline constexpr unsigned recent_numbers = 8;
inline constexpr std::uint32_t block_triangles = 128;
inline constexpr std::size_t block_bytes = 4;  // u32, where its bits begin, counted in bytes from the first block's
constexpr std::uint32_t block_count(std::uint32_t triangle_count) {
    return (triangle_count + block_triangles - 1) / block_triangles;
}
/// A strip begins a triangle where it needs to; a plain leaf keeps the source's first corner.
constexpr std::uint32_t corner_factor(Profile profile) { return profile == Profile::fast ? 1 : 3; }
/// Numbers are below this, which is at most 2^32.
constexpr std::uint64_t number_limit(Profile profile, std::uint32_t source_triangles) {
    return std::uint64_t{corner_factor(profile)} * source_triangles;
}
constexpr unsigned number_bits(std::uint64_t number_limit) {
    return number_limit == 0 ? 0 : static_cast<unsigned>(std::bit_width(number_limit - 1));
}
}  // namespace ids

// The section of split references: which storage indices are copies, and of which triangle. The lowest storage index of
// a triangle is its owner; copies have the same corners in the same order, and lie in leaves whose boxes hold other
// parts of it. u32 number of copies; a block for each started 256 storage indices: u32 copies before it, then a bit for
// each index, low bits first, set for copies; then u32 owner for each copy, in storage order. Profile fast only.
namespace copies {
inline constexpr std::size_t count_at = 0;
inline constexpr std::size_t blocks_at = 4;
inline constexpr std::uint32_t block_indices = 256;
inline constexpr std::size_t bits_at = 4;  // in a block
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

// The section of edge flags: u32 the squared sine of the largest angle that counts as flat, in 2^-24; then for each
// storage index a field of 6 bits, 2 for each edge, from corner e to the next: flat, convex, concave,
// boundary.
namespace edge_flags {
inline constexpr std::size_t flat_limit_at = 0;
inline constexpr std::size_t fields_at = 4;
inline constexpr unsigned edge_bits = 2;
inline constexpr unsigned triangle_bits = 3 * edge_bits;
inline constexpr std::uint32_t max_flat_limit = 1u << 24;
}  // namespace edge_flags

// Bounds of the whole asset, in this order, each with its own feature bit.
namespace bounds {
/// Lengths of the oriented box and the sphere are whole sixteenths of a lattice step. All numbers but the quaternion
/// are within +-max_length.
inline constexpr int units_per_step = 16;
inline constexpr std::int32_t max_length = 1 << 29;

// The oriented box: a rotation as a quaternion of integers w x y z, 4 x i16, whose matrix of integers has perpendicular
// rows of length w^2 + x^2 + y^2 + z^2 (lib/runtime/blob/stored_bounds.hpp); then along each row lo and hi, 6 x i32.
inline constexpr std::size_t quaternion_at = 0;
inline constexpr std::size_t lo_at = 8;
inline constexpr std::size_t hi_at = 20;
inline constexpr std::size_t oriented_box_bytes = 32;
inline constexpr std::int32_t max_quaternion = 2047;

// The sphere: its center, 3 x i32, and its radius, u32.
inline constexpr std::size_t center_at = 0;
inline constexpr std::size_t radius_at = 12;
inline constexpr std::size_t sphere_bytes = 16;

// The 26-DOP: least and greatest value of each sum below over all vertices, in lattice steps, 2 x i32. The three axes
// are in the header.
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

// ---- nodes --------------------------------------------------------------------------------------------------------
// Children are numbered nodes first, then leaves. The node children are contiguous; blocks of siblings are in depth-
// first order. Boxes are rounded outward.

/// Lattice steps that the base of a packed node and the planes of a plain one count in, as a power of two.
// mutant(> -> >=) equivalent: both sides are equal then
constexpr unsigned unit_shift(unsigned bits) { return bits > 16 ? bits - 16 : 0; }

/// Profiles balanced, small and tiny: a node is one cache line. Child boxes are base + plane * 2^shift per axis.
namespace packed_node {
inline constexpr unsigned max_children = 8;
inline constexpr std::size_t base_at = 0;      // 3 x u16, in units of 2^unit_shift
inline constexpr std::size_t shifts_at = 6;    // u16: 5 bits x, 5 bits y, 5 bits z, a zero
inline constexpr std::size_t children_at = 8;  // u32: 24 bits first child node, 4 bits node children, 4 bits leaves
inline constexpr std::size_t leaf_block_at =
    12;  // u32, in units of 4 bytes from the start of the leaf section; 0 without leaves
inline constexpr std::size_t lo_at = 16;     // u8 [axis][child]
inline constexpr std::size_t hi_at = 40;     // u8 [axis][child]
inline constexpr std::size_t row_bytes = 8;  // of the planes of an axis
inline constexpr std::size_t bytes = 64;
inline constexpr unsigned max_shift = 17;
static_assert(hi_at + 3 * row_bytes == bytes);
}  // namespace packed_node

/// Profile fast: numbers in whole bytes, as lanes load them. A child's box is from lo * 2^unit_shift to
/// (hi + 1) * 2^unit_shift - 1 on each axis.
namespace plain_node {
inline constexpr unsigned max_children = 16;
inline constexpr std::size_t lo_at = 0;               // u16 [axis][child]
inline constexpr std::size_t hi_at = 96;              // u16 [axis][child]
inline constexpr std::size_t row_bytes = 32;          // of the planes of an axis
inline constexpr std::size_t children_at = 192;       // u32: 24 bits first child node, 8 bits node children
inline constexpr std::size_t leaf_block_at = 196;     // u32, in units of 4 bytes from the start of the leaf section
inline constexpr std::size_t leaves_at = 200;         // u24 for each leaf: its descriptor, see `plain_leaf`; else 0
inline constexpr std::size_t leaf_children_at = 248;  // u8
inline constexpr std::size_t reserved_at = 249;       // zero up to the end
inline constexpr std::size_t bytes = 256;
static_assert(hi_at == 3 * row_bytes && children_at == 6 * row_bytes && row_bytes == 2 * max_children);
}  // namespace plain_node

// ---- profile fast: plain leaves ------------------------------------------------------------------------------------
// A node's leaves lie together in one block, each at a multiple of 4 bytes. Their descriptors are in the node.
namespace plain_leaf {
inline constexpr unsigned max_triangles = 16;
inline constexpr unsigned max_vertices = 32;
// The descriptor, 24 bits.
inline constexpr std::size_t descriptor_bytes = 3;
inline constexpr unsigned offset_bits = 11;      // of the data, in units of 4 bytes from the start of the block
inline constexpr unsigned triangles_shift = 11;  // 4 bits: triangles - 1
inline constexpr unsigned vertices_shift = 15;   // 5 bits: vertices - 1
inline constexpr unsigned size_shift = 20;       // 4 bits: size - least_size
/// Coordinates of an axis differ by less than 2^size: the least that the descriptor can hold and that is true.
constexpr unsigned least_size(unsigned bits) { return 1 + unit_shift(bits); }
// Data: the storage index of the first triangle (u32). Then, where lattice coordinates count from 0: the low 16 bits of
// x of each vertex (u16), of y, of z; the first corner of each triangle (u8, a vertex number), the second, the third;
// on a lattice of more than 16 bits then bits 16 to 23 of x of each vertex (u8), of y, of z. Padded with zeros to 4
// bytes. The size depends on the counts alone.
inline constexpr std::size_t first_at = 0;
inline constexpr std::size_t words_at = 4;
constexpr bool has_high_bytes(unsigned bits) { return bits > 16; }
constexpr std::size_t data_bytes(unsigned vertex_count, unsigned triangle_count, unsigned bits) {
    return words_at + std::size_t{3} * ((has_high_bytes(bits) ? 3 : 2) * vertex_count + triangle_count);
}
constexpr std::size_t padded_bytes(unsigned vertex_count, unsigned triangle_count, unsigned bits) {
    return (data_bytes(vertex_count, triangle_count, bits) + 3) / 4 * 4;
}
static_assert((plain_node::max_children - 1) * padded_bytes(max_vertices, max_triangles, max_bits) / 4 <
              1u << offset_bits);
}  // namespace plain_leaf

// ---- profiles balanced and small: strip leaves ---------------------------------------------------------------------
// A node's leaves lie together in one block: u32 storage index of the first triangle, a u32 descriptor for each leaf,
// then each leaf's data. A block is padded with zeros to 4 bytes.
//
// A leaf is a sequence of vertex numbers, its entries. Window w is a triangle of entry w + 1, entry w + 2 and a pivot:
// the last entry not behind w that is marked as one. Windows marked as unused join one strip to the next.
namespace strip_leaf {
inline constexpr unsigned max_balanced_entries = 34;
inline constexpr unsigned max_small_entries = 56;
inline constexpr unsigned max_balanced_vertices = 32;  ///< as baked; a reader takes as many as there are entries
static_assert(max_small_entries <= max_leaf_vertices && max_small_entries - 2 <= max_leaf_triangles);
inline constexpr std::size_t descriptors_at = 4;
inline constexpr std::size_t descriptor_bytes = 4;
inline constexpr unsigned offset_bits = 13;    // of the data, in bytes from the end of the descriptors
inline constexpr unsigned entries_shift = 13;  // 6 bits: entries - 3
inline constexpr unsigned first_shift = 19;  // 9 bits: first triangle, counted from the block's; 4 bits above are zero
// Data: a stream of marks, then a stream of x, of y, of z (offsets from the low corner of the leaf's own box in its
// node, vertex by vertex), each padded with zero bits to a byte. Marks, low bits first, where n = entries - 3:
//
// * n bits: whether entry 1, 2 .. n is a pivot (entry 0 is);
//
// * n bits: whether window 1, 2 .. n is a triangle (window 0 is);
//
// * n bits: whether entry 3, 4 .. is a vertex's first use (entries 0 to 2 are); vertices are numbered by first use;
//
// * reference_width bits for each entry that is not a first use: the vertex's number.

/// Bits of a vertex number.
constexpr unsigned reference_width(unsigned vertex_count) {
    return static_cast<unsigned>(std::bit_width(vertex_count - 1));
}
/// Bits of the marks; their stream is padded to a byte.
constexpr unsigned mark_bits(unsigned entries, unsigned vertex_count) {
    return 3 * (entries - 3) + (entries - vertex_count) * reference_width(vertex_count);
}
/// Width of the offsets on an axis along which the leaf's box reaches over so many steps.
constexpr unsigned coordinate_width(std::uint32_t side, unsigned bits) {
    const auto width = static_cast<unsigned>(std::bit_width(side));
    // mutant(< -> <=) equivalent: both sides are equal then
    return width < bits ? width : bits;
}
}  // namespace strip_leaf

// ---- profile tiny: predicted strips ---------------------------------------------------------------------------------
// Strips as above. Most vertices are stored as what they differ by from a prediction: the fourth corner of the
// parallelogram that the triangle before makes with the edge to this one. A leaf is one stream of bits.
namespace predicted_strip {
inline constexpr unsigned max_entries = max_leaf_entries;
inline constexpr unsigned max_vertices = max_leaf_vertices;
inline constexpr std::size_t descriptors_at = strip_leaf::descriptors_at;  // u32 before them: first triangle
inline constexpr std::size_t descriptor_bytes = 2;
inline constexpr unsigned entries_shift = 10;  // 6 bits: entries - 3; 10 bits below: bytes of the data
// Data, low bits first, where n = entries - 3; padded with zero bits to a byte:
//
// * for each axis 5 bits large width, 5 bits small width;
//
// * 4 bits: number of joints, where one path of the strip ends and the next begins;
//
// * n bits: whether entry 1, 2 .. n is a pivot (entry 0 is);
//
// * n bits: whether entry 3, 4 .. is a vertex's first use (entries 0 to 2 are);
//
// * 6 bits for each joint, ascending: w, where windows w and w + 1 are not triangles (all others are);
//
// * reference_width bits for each entry that is not a first use: the vertex's number;
//
// * 3 bits for each predicted vertex, x y z: whether its residual has the large width, or the small one;
//
// * for each vertex x, y, z: of a predicted one the residual + half the range of its width, of another one its offset
//   in the leaf's box, in the width of the box's side.
inline constexpr unsigned width_bits = 5;
inline constexpr unsigned joints_at = 6 * width_bits;
inline constexpr unsigned joint_count_bits = 4;
inline constexpr unsigned max_joints = (1u << joint_count_bits) - 1;
inline constexpr unsigned marks_at = joints_at + joint_count_bits;
inline constexpr unsigned place_bits = 6;
/// Residuals are of sums and differences of three offsets.
constexpr unsigned max_width(unsigned bits) { return bits + 2; }
/// Where the references begin.
constexpr unsigned references_at(unsigned entries, unsigned joints) {
    return marks_at + 2 * (entries - 3) + place_bits * joints;
}
/// Where the predicted vertices' choices of widths begin.
constexpr unsigned choices_at(unsigned entries, unsigned joints, unsigned vertex_count) {
    return references_at(entries, joints) + (entries - vertex_count) * strip_leaf::reference_width(vertex_count);
}
/// A bit for each entry: if it is a first use, its vertex is predicted. So it is when its window and the one before are
/// triangles.
constexpr std::uint64_t predicted_entries(std::uint64_t windows) { return windows << 2 & windows << 3; }
}  // namespace predicted_strip

constexpr bool has_predicted_strips(Profile profile) { return profile == Profile::tiny; }
constexpr bool has_plain_nodes(Profile profile) { return profile == Profile::fast; }
constexpr unsigned max_node_children(Profile profile) {
    return has_plain_nodes(profile) ? plain_node::max_children : packed_node::max_children;
}
constexpr std::size_t node_bytes(Profile profile) {
    return has_plain_nodes(profile) ? plain_node::bytes : packed_node::bytes;
}
static_assert(plain_node::max_children == max_children && packed_node::max_children <= max_children);

// ---- scenes ---------------------------------------------------------------------------------------------------------
// A scene is a header, the sizes of its meshes and tiles, the meshes (ordinary blobs), the tiles (scenes without
// tiles), packed nodes, and a record for each instance. Meshes, tiles and nodes begin at multiples of 64 bytes, with
// zeros before them. The leaf children of a node are instances; leaf_block is the number of the first one, 0 if there
// is none.
namespace scene {
inline constexpr std::uint32_t magic = 0x53505345u;  // "ESPS"
inline constexpr std::uint16_t version_major = 1;
inline constexpr std::uint16_t version_minor = 0;
inline constexpr unsigned bits = max_bits;             ///< of the scene's lattice
inline constexpr std::uint32_t max_meshes = 1u << 24;  ///< and tiles
inline constexpr std::uint32_t max_instances = 1u << 24;
inline constexpr std::size_t alignment = 64;

// The header. What a blob has too lies where a blob has it.
inline constexpr std::size_t magic_at = header::magic_at;
inline constexpr std::size_t version_major_at = header::version_major_at;
inline constexpr std::size_t version_minor_at = header::version_minor_at;
inline constexpr std::size_t total_bytes_at = header::total_bytes_at;
inline constexpr std::size_t checksum_at = header::checksum_at;
inline constexpr std::size_t features_at = header::features_at;            // u32
inline constexpr std::uint32_t has_common_lattice = 1;                     // of features; without it what follows is 0
inline constexpr std::size_t depth_at = 20;                                // u8; the byte behind it is zero
inline constexpr std::size_t step_exponent_at = header::step_exponent_at;  // i16
inline constexpr std::size_t mesh_count_at = 24;                           // u32
inline constexpr std::size_t instance_count_at = 28;                       // u32
inline constexpr std::size_t node_count_at = header::node_count_at;        // u32, 0 only without instances
inline constexpr std::size_t tile_count_at = 36;                           // u32, zero in a tile
inline constexpr std::size_t origin_at = header::origin_at;                // 3 x f32; a multiple of the step
inline constexpr std::size_t extent_at = header::extent_at;                // 3 x u32, below 2^bits
inline constexpr std::size_t max_error_at = header::max_error_at;          // f32, in world units
inline constexpr std::size_t common_origin_at = 68;                        // 3 x f32; a multiple of the common step
inline constexpr std::size_t common_extent_at = 80;                        // 3 x u32, below 2^bits
inline constexpr std::size_t common_step_exponent_at = 92;                 // i16; the two bytes behind it are zero
inline constexpr std::size_t tile_mesh_count_at = 96;                      // u32, meshes of all tiles together
inline constexpr std::size_t zeros_at = 100;                               // up to the end
inline constexpr std::size_t header_bytes = header::bytes;

inline constexpr std::size_t part_size_bytes = 4;  // u32 for each mesh, then for each tile

// The record of an instance.
inline constexpr std::size_t rotation_at = 0;      // 4 x f32: x y z w
inline constexpr std::size_t translation_at = 16;  // 3 x f32
inline constexpr std::size_t scale_at = 28;        // f32
inline constexpr std::size_t mesh_at = 32;         // u32; tiles are numbered after the meshes
inline constexpr std::size_t mask_at = 36;         // u32
inline constexpr std::size_t user_at = 40;         // u32
inline constexpr std::size_t source_at = 44;       // u32
inline constexpr std::size_t instance_bytes = 48;

constexpr std::size_t aligned(std::size_t at) { return (at + alignment - 1) / alignment * alignment; }
}  // namespace scene

// ---- the remap file, beside a blob ---------------------------------------------------------------------------------
// A header of 16 bytes, then for each storage index u32 file, mesh, triangle and first corner: what OriginalTriangle
// holds.
namespace remap {
inline constexpr std::uint32_t magic = 0x52505345u;  // "ESPR"
inline constexpr std::uint32_t version = 1;
inline constexpr std::size_t magic_at = 0;
inline constexpr std::size_t version_at = 4;
inline constexpr std::size_t blob_checksum_at = 8;  // u32, that of the blob which it belongs to
inline constexpr std::size_t checksum_at = 12;      // u32, CRC-32 of the file with this field zero, as in a blob
static_assert(checksum_at == header::checksum_at);
inline constexpr std::size_t triangles_at = 16;
inline constexpr std::size_t triangle_bytes = 16;
}  // namespace remap

}  // namespace espalier::format
