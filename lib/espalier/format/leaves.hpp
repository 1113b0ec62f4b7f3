// The leaves of a tree: plain leaves, strip leaves and predicted strips.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/format/header.hpp>
#include <espalier/format/nodes.hpp>

namespace espalier::format {

// ---- profile fast: plain leaves ------------------------------------------------------------------------------------
// The leaves of a node are together in one block, each at a multiple of 4 bytes. The node itself has their descriptors.
namespace plain_leaf {
inline constexpr unsigned max_triangles = 16;
inline constexpr unsigned max_vertices = 32;
// A descriptor, 24 bits.
inline constexpr std::size_t descriptor_bytes = 3;
inline constexpr unsigned offset_bits = 11;      // of the data, in units of 4 bytes from the start of the block
inline constexpr unsigned triangles_shift = 11;  // 4 bits: triangles - 1
inline constexpr unsigned vertices_shift = 15;   // 5 bits: vertices - 1
inline constexpr unsigned size_shift = 20;       // 4 bits: size - least_size
/// The vertices of a leaf differ by less than 2^size along each axis. The size is the smallest for which that is true
/// and which a descriptor can express.
constexpr unsigned least_size(unsigned bits) { return 1 + unit_shift(bits); }
// The data of a leaf: the storage index of its first triangle (u32); the low 16 bits of x of each vertex (u16), then of
// y, then of z; the first corner of each triangle (u8, a vertex number), then the second, then the third; and, on a
// lattice of more than 16 bits, bits 16 to 23 of x of each vertex (u8), then of y, then of z. Padded with zeros to 4
// bytes. Coordinates count from the origin of the lattice, so the size of a leaf depends on its counts alone. The
// leaves of a deformable blob have no corners (sections.hpp) and are as large as leaves without triangles.
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
// The leaves of a node are together in one block: u32 storage index of the first triangle, a u32 descriptor for each
// leaf, then the data of each leaf. A block is padded with zeros to 4 bytes.
//
// A leaf is a sequence of vertex numbers, its entries. Window w is a triangle of entry w + 1, entry w + 2 and a pivot,
// which is the last entry up to w that is marked as one. Windows that are marked as unused join one strip to the next.
namespace strip_leaf {
inline constexpr unsigned max_balanced_entries = 34;
inline constexpr unsigned max_small_entries = 56;
inline constexpr unsigned max_balanced_vertices = 32;  ///< as baked; a reader accepts as many as there are entries
static_assert(max_small_entries <= max_leaf_vertices && max_small_entries - 2 <= max_leaf_triangles);
inline constexpr std::size_t descriptors_at = 4;
inline constexpr std::size_t descriptor_bytes = 4;
inline constexpr unsigned offset_bits = 13;    // of the data, in bytes from the end of the descriptors
inline constexpr unsigned entries_shift = 13;  // 6 bits: entries - 3
inline constexpr unsigned first_shift = 19;    // 9 bits: first triangle, relative to the block's; 4 zero bits above
// The data of a leaf: a stream of marks, then the streams of x, of y and of z (for each vertex, the offset from the low
// corner of the leaf's own box in its node), each padded with zero bits to a byte. The marks, low bits first, where n =
// entries - 3:
//
// * n bits: whether entry 1, 2 .. n is a pivot (entry 0 is);
//
// * n bits: whether window 1, 2 .. n is a triangle (window 0 is);
//
// * n bits: whether entry 3, 4 .. is a vertex's first use (entries 0 to 2 are); vertices are numbered by first use;
//
// * reference_width bits for each entry that is not a first use: the vertex's number.

/// Returns the width of a vertex number in bits.
constexpr unsigned reference_width(unsigned vertex_count) {
    return static_cast<unsigned>(std::bit_width(vertex_count - 1));
}
/// Returns the number of bits of the marks, whose stream is padded to a byte.
constexpr unsigned mark_bits(unsigned entries, unsigned vertex_count) {
    return 3 * (entries - 3) + (entries - vertex_count) * reference_width(vertex_count);
}
/// Returns the width of the offsets along an axis on which the leaf's box is `side` steps long.
constexpr unsigned coordinate_width(std::uint32_t side, unsigned bits) {
    const auto width = static_cast<unsigned>(std::bit_width(side));
    // mutant(< -> <=) equivalent: both sides are equal then
    return width < bits ? width : bits;
}
}  // namespace strip_leaf

// ---- profile tiny: predicted strips ---------------------------------------------------------------------------------
// Strips as above, except that most vertices are stored as their difference from a prediction: the fourth corner of the
// parallelogram that the previous triangle forms over the edge that it shares with this one. A leaf is a single stream
// of bits.
namespace predicted_strip {
inline constexpr unsigned max_entries = max_leaf_entries;
inline constexpr unsigned max_vertices = max_leaf_vertices;
inline constexpr std::size_t descriptors_at = strip_leaf::descriptors_at;  // after a u32, the first triangle
inline constexpr std::size_t descriptor_bytes = 2;
inline constexpr unsigned entries_shift = 10;  // 6 bits: entries - 3; the 10 bits below: size of the data in bytes
// The data of a leaf, low bits first, where n = entries - 3; padded with zero bits to a byte:
//
// * for each axis: 5 bits large width, 5 bits small width;
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
// * 3 bits for each predicted vertex, x y z: whether its residual has the large width or the small one;
//
// * for each vertex, x, y and z: if predicted, the residual + half the range of its width; otherwise the offset in the
//   leaf's box, in the width that the side of the box needs.
inline constexpr unsigned width_bits = 5;
inline constexpr unsigned joints_at = 6 * width_bits;
inline constexpr unsigned joint_count_bits = 4;
inline constexpr unsigned max_joints = (1u << joint_count_bits) - 1;
inline constexpr unsigned marks_at = joints_at + joint_count_bits;
inline constexpr unsigned place_bits = 6;
/// Residuals are sums and differences of three offsets, so they need up to two more bits.
constexpr unsigned max_width(unsigned bits) { return bits + 2; }
/// Returns the bit at which the references begin.
constexpr unsigned references_at(unsigned entries, unsigned joints) {
    return marks_at + 2 * (entries - 3) + place_bits * joints;
}
/// Returns the bit at which the predicted vertices' choices of widths begin.
constexpr unsigned choices_at(unsigned entries, unsigned joints, unsigned vertex_count) {
    return references_at(entries, joints) + (entries - vertex_count) * strip_leaf::reference_width(vertex_count);
}
/// Returns a bit for each entry, which tells whether the vertex is predicted if this entry is its first use: it is if
/// the entry's window and the one before it are triangles.
constexpr std::uint64_t predicted_entries(std::uint64_t windows) { return windows << 2 & windows << 3; }
}  // namespace predicted_strip

constexpr bool has_predicted_strips(Profile profile) { return profile == Profile::tiny; }

}  // namespace espalier::format
