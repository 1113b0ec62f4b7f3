// Espalier 0.1.0 in one file: what answers queries from a blob. Made by tools/single_file.py out of the library's headers.
// Compile espalier.cpp with the program, as C++20 or later.
//
// MIT License
//
// Copyright (c) The Espalier authors
//
// Permission is hereby granted, free of charge, to any person obtaining a copy
// of this software and associated documentation files (the "Software"), to deal
// in the Software without restriction, including without limitation the rights
// to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
// copies of the Software, and to permit persons to whom the Software is
// furnished to do so, subject to the following conditions:
//
// The above copyright notice and this permission notice shall be included in all
// copies or substantial portions of the Software.
//
// THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
// IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
// FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
// AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
// LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
// OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
// SOFTWARE.
#pragma once

#include <bit>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

// ---- espalier/approximate.hpp
// Queries that may err by as much as you allow, on the safe side. A walk that reaches a box of the tree whose largest
// side is at most `accuracy` (world units) takes the box for the surface in it and goes no deeper: every box holds
// some. That saves most where the surface is finer than what is asked for, from far away or for sound and plans.
//
// Never missed: what overlaps, occludes or is as near as that is always reported so. A yes that the exact query would
// not give means that the surface comes within accuracy * sqrt(3) of the shape or ray as rounded (of a sphere 2^-18 of
// its radius more), and of a Box within accuracy along every axis.
// Accuracy. 0, and below or NaN, gives the exact answer. Boxes end at whole lattice steps, and leaves are not split
// further: an accuracy far below the size of a leaf costs time and gains nothing.
// Arguments otherwise, copies and safety: as in overlap.hpp, nearest.hpp and ray.hpp. The same bits on every machine.

// ---- espalier/blob.hpp
// Opening a blob: from flash, from a mapped file, from a buffer that a stranger filled.

// ---- espalier/format.hpp
// The bytes of a blob: every offset, width and limit, once. docs/format.md is the normative text.
// All numbers are little-endian; nothing is aligned to more than a byte when read, so that a blob may lie anywhere.

namespace espalier::format {

/// The format's version, apart from the library's. Readers accept the same major and a minor up to their own.
inline constexpr std::uint16_t version_major = 1;
inline constexpr std::uint16_t version_minor = 1;
inline constexpr std::uint32_t magic = 0x4C505345u;  // "ESPL"

// ---- limits -------------------------------------------------------------------------------------------------------
inline constexpr int max_bits = 24;             ///< lattice bits per axis: integers that float32 holds exactly
inline constexpr int min_step_exponent = -100;  ///< step = 2^exponent
inline constexpr int max_step_exponent = 100;
inline constexpr std::uint32_t max_nodes = 1u << 24;
inline constexpr unsigned max_depth = 16;  ///< nodes on the longest way down; sizes every query's stack
inline constexpr unsigned max_children = 8;
inline constexpr unsigned max_leaf_triangles = 54;  ///< of any profile
inline constexpr unsigned max_leaf_vertices = 56;
inline constexpr std::uint32_t max_triangles = 0x7FFFFFFFu;

// ---- header: 128 bytes --------------------------------------------------------------------------------------------
namespace header {
inline constexpr std::size_t magic_at = 0;              // u32
inline constexpr std::size_t version_major_at = 4;      // u16
inline constexpr std::size_t version_minor_at = 6;      // u16
inline constexpr std::size_t total_bytes_at = 8;        // u32, the whole blob
inline constexpr std::size_t checksum_at = 12;          // u32, CRC-32 (IEEE 802.3) of the blob with this field zero
inline constexpr std::size_t features_at = 16;          // u32, see `feature`
inline constexpr std::size_t profile_at = 20;           // u8, see `Profile`
inline constexpr std::size_t bits_at = 21;              // u8, 1..24: coordinates are below 2^bits
inline constexpr std::size_t step_exponent_at = 22;     // i16
inline constexpr std::size_t triangle_count_at = 24;    // u32
inline constexpr std::size_t vertex_count_at = 28;      // u32, distinct lattice points
inline constexpr std::size_t node_count_at = 32;        // u32, 0 only for an empty mesh
inline constexpr std::size_t leaf_bytes_at = 36;        // u32, a multiple of 4
inline constexpr std::size_t origin_at = 40;            // 3 x f32, world position of lattice point 0 0 0
inline constexpr std::size_t extent_at = 52;            // 3 x u32, largest coordinate per axis (the smallest is 0)
inline constexpr std::size_t max_error_at = 64;         // f32, world units
inline constexpr std::size_t depth_at = 68;             // u8
inline constexpr std::size_t id_bits_at = 69;           // u8, width of an original id, 0..32
inline constexpr std::size_t source_count_at = 72;      // u32, entries of the source table
inline constexpr std::size_t source_triangles_at = 76;  // u32, triangles in the sources, dropped ones included
inline constexpr std::size_t reserved_at = 80;          // zero up to the end (and the two bytes at 70)
inline constexpr std::size_t bytes = 128;
static_assert(reserved_at < bytes && bytes % 64 == 0);
}  // namespace header

/// How leaves are coded, and how large they may become. Nodes are the same in all profiles.
enum class Profile : std::uint8_t {
    fast = 0,      ///< indexed leaves
    balanced = 1,  ///< strip leaves of at most max_balanced_entries
    small = 2,     ///< strip leaves of at most max_small_entries
};

/// A strip begins a triangle where it needs to: in profiles that have them each original id has this many bits before
/// it, which of the original triangle's corners is stored first (0, 1 or 2; the others follow in its order).
constexpr unsigned first_corner_bits(Profile profile) { return profile == Profile::fast ? 0 : 2; }

/// Bits of the features field. An optional section is there exactly when its bit is set; they follow in bit order.
namespace feature {
inline constexpr std::uint32_t original_ids = 1u << 0;
inline constexpr std::uint32_t materials_8 = 1u << 1;
inline constexpr std::uint32_t materials_16 = 1u << 2;  // never together with materials_8
inline constexpr std::uint32_t closed = 1u << 3;  // no bytes: every edge is shared by two triangles, oppositely wound
inline constexpr std::uint32_t split_references = 1u << 4;  // triangles have copies in several leaves, see `copies`
inline constexpr std::uint32_t edge_flags = 1u << 5;        // see `edge_flags` below
inline constexpr std::uint32_t oriented_box = 1u << 6;      // see `bounds`, also for the next two
inline constexpr std::uint32_t bounding_sphere = 1u << 7;
inline constexpr std::uint32_t k_dop = 1u << 8;
inline constexpr std::uint32_t bounds = oriented_box | bounding_sphere | k_dop;
inline constexpr std::uint32_t known =
    original_ids | materials_8 | materials_16 | closed | split_references | edge_flags | bounds;
}  // namespace feature

/// What a blob states as its minor version: the lowest that has its features. So blobs without new ones keep their
/// bytes.
constexpr std::uint16_t minor_version_of(std::uint32_t features) {
    return (features & (feature::edge_flags | feature::bounds)) != 0 ? 1 : 0;
}

// ---- sections ------------------------------------------------------------------------------------------------------
// In this order: nodes, leaves, guard, then the optional ones; each of these padded with zeros to 4 bytes.
inline constexpr std::size_t guard_bytes = 64;  ///< zeros after the leaves, so that wide loads stay inside the blob

namespace source {                          // one entry of the source table
inline constexpr std::size_t first_at = 0;  // u32, original id of its first triangle; ascending, the first is 0
inline constexpr std::size_t file_at = 4;   // u32
inline constexpr std::size_t mesh_at = 8;   // u32
inline constexpr std::size_t bytes = 12;
}  // namespace source

// The section of split references: which storage indices are copies, and of which triangle. The lowest storage index of
// a triangle is its owner; copies have the same corners in the same order, and stand in leaves whose boxes hold other
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
constexpr std::uint64_t blocks_bytes(std::uint32_t triangle_count) {
    return (std::uint64_t{triangle_count} + block_indices - 1) / block_indices * block_bytes;
}
}  // namespace copies

// The section of edge flags: u32 the squared sine of the largest angle that counts as flat, in 2^-24; then for each
// storage index a field of 6 bits, 2 for each edge, from corner e to the next: flat, convex, concave, open.
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

// The oriented box: a rotation as a quaternion of integers w x y z, 4 x i16, whose matrix of integers (runtime/
// stored_bounds.hpp) has perpendicular rows of length w^2 + x^2 + y^2 + z^2; then along each row lo and hi, 6 x i32.
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

// ---- a node is one cache line -------------------------------------------------------------------------------------
// Children are numbered nodes first, then leaves. The node children are contiguous; blocks of siblings stand in depth-
// first order. Child boxes are base + plane * 2^shift per axis, rounded outward.
namespace node {
inline constexpr std::size_t base_at = 0;      // 3 x u16, in units of 2^max(0, bits - 16)
inline constexpr std::size_t shifts_at = 6;    // u16: 5 bits x, 5 bits y, 5 bits z, a zero
inline constexpr std::size_t children_at = 8;  // u32: 24 bits first child node, 4 bits node children, 4 bits leaves
inline constexpr std::size_t leaf_block_at =
    12;  // u32, in units of 4 bytes from the start of the leaf section; 0 without leaves
inline constexpr std::size_t lo_at = 16;  // u8 [axis][child]
inline constexpr std::size_t hi_at = 40;  // u8 [axis][child]
inline constexpr std::size_t bytes = 64;
inline constexpr unsigned max_shift = 17;
static_assert(hi_at + 3 * max_children == bytes);
}  // namespace node

// ---- profile fast: indexed leaves ----------------------------------------------------------------------------------
// A node's leaves lie together in one block: u32 storage index of the first triangle, a u32 descriptor for each leaf,
// then each leaf's data, at even offsets. A block is padded with zeros to 4 bytes.
namespace indexed_leaf {
inline constexpr unsigned max_triangles = 16;
inline constexpr unsigned max_vertices = 32;
inline constexpr std::size_t descriptors_at = 4;
inline constexpr std::size_t descriptor_bytes = 4;
inline constexpr unsigned offset_bits = 11;      // of the data, in units of 2 bytes from the end of the descriptors
inline constexpr unsigned triangles_shift = 11;  // 4 bits: triangles - 1
inline constexpr unsigned vertices_shift = 15;   // 5 bits: vertices - 1
inline constexpr unsigned widths_shift = 20;     // 3 x 4 bits: width codes of x, y, z
// In a blob with split references an axis of the lattice's own width counts from 0 instead: there, vertices may lie
// outside of their leaf's box.
// Data: a stream of x, of y, of z (offsets from the low corner of the leaf's own box in its node, vertex by vertex) and
// a stream of triangles (three vertex numbers, the first in the low bits). Each stream is fields of one width, low bits
// first, padded with zero bits to a byte.

/// The field width that a width code stands for: codes count from 1 to the lattice's own width, 0 means a constant
/// axis.
constexpr unsigned coordinate_width(unsigned code, unsigned bits) {
    return code == 0 ? 0 : bits <= 15 ? code : code + (bits - 15);
}
/// Bits of one vertex number, 3 to 5; a triangle's field is three of them.
constexpr unsigned corner_width(unsigned vertex_count) { return vertex_count <= 8 ? 3 : vertex_count <= 16 ? 4 : 5; }
constexpr std::size_t stream_bytes(unsigned count, unsigned width) { return (std::size_t{count} * width + 7) / 8; }
}  // namespace indexed_leaf

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
    return width < bits ? width : bits;
}
}  // namespace strip_leaf

}  // namespace espalier::format
// ---- espalier/status.hpp
// Why a blob was refused, and why a query was. One meaning each; the numbers are stable.

namespace espalier {

enum class Status : std::uint8_t {
    ok = 0,
    too_short = 1,            ///< fewer bytes than the header, or than the header says
    trailing_bytes = 2,       ///< more bytes than the header says
    not_a_blob = 3,           ///< the first four bytes are not "ESPL"
    unsupported_version = 4,  ///< another major version, or a minor version newer than this library
    unsupported_profile = 5,  ///< a profile that this library does not know, or was built without
    unsupported_feature = 6,  ///< a feature bit that this library does not know
    bad_header = 7,           ///< a header field out of its range, or two that contradict each other
    bad_checksum = 8,         ///< the bytes are not the ones that were written
    bad_node = 9,             ///< a node breaks the rules of docs/format.md
    bad_leaf = 10,            ///< a leaf breaks the rules of docs/format.md
    bad_section = 11,         ///< an optional section breaks the rules of docs/format.md
};

/// One English sentence without a full stop, static, never null: also for values that are no Status.
[[nodiscard]] const char* describe(Status status) noexcept;

/// What a query says that has more to say than yes or no.
enum class QueryStatus : std::uint8_t {
    ok = 0,                ///< the answer is the whole answer
    invalid_argument = 1,  ///< a NaN, an infinity or a negative size where the query's header rules them out
    out_of_range = 2,      ///< so far away or so large, in lattice steps, that the query's header rules it out
    not_closed = 3,        ///< only a blob whose closed flag is set has an inside
    has_copies = 4,        ///< a blob with copy_count() above 0 answers no enumerating queries
    work_limit = 5,        ///< the caller's limit of work was reached: the answer covers a part only
    output_full = 6,       ///< the caller's array is full and there is more
};

/// One English sentence without a full stop, static, never null: also for values that are no QueryStatus.
[[nodiscard]] const char* describe(QueryStatus status) noexcept;

}  // namespace espalier
// ---- espalier/types.hpp
// The plain values that every query takes and gives.

namespace espalier {

/// A point or a direction, in the units and axes that the asset was baked in.
struct Vec3 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// A triangle of a blob, named by its storage index: 0 .. Blob::triangle_count() - 1.
/// The order is the baker's; `original_triangle` leads back to the source when the blob carries ids.
struct Triangle {
    std::uint32_t index = 0;
    friend constexpr auto operator<=>(const Triangle&, const Triangle&) = default;
};

/// What a query answers with where it found none: no blob has as many triangles.
inline constexpr Triangle no_triangle = {0xFFFFFFFFu};

/// The part of a triangle that a point lies on, of several the smallest: a corner, else a side, else the face.
enum class Feature : std::uint8_t { face, edge_ab, edge_bc, edge_ca, vertex_a, vertex_b, vertex_c };

/// The three corners of a triangle, in the winding of its source; which comes first, OriginalTriangle says.
struct Corners {
    Vec3 a;
    Vec3 b;
    Vec3 c;
};

/// What a visitor answers after each triangle or hit.
enum class Visit : std::uint8_t { keep_going, stop };
inline constexpr Visit keep_going = Visit::keep_going;
inline constexpr Visit stop = Visit::stop;

}  // namespace espalier

namespace espalier {

namespace detail {

/// What `open` proved about the bytes; the queries read this and the bytes, nothing else.
/// All zero when empty: what C fills with zeros is a Blob too.
struct BlobData {
    const std::byte* bytes = nullptr;  // the whole blob
    const std::byte* nodes = nullptr;  // null when empty
    const std::byte* leaves = nullptr;
    const std::byte* sources = nullptr;  // null without original ids
    const std::byte* ids = nullptr;
    const std::byte* materials = nullptr;
    const std::byte* copies = nullptr;  // null without split references
    const std::byte* edge_flags = nullptr;
    const std::byte* bounds = nullptr;  // whichever there are
    std::uint32_t size = 0;
    std::uint32_t features = 0;
    std::uint32_t triangle_count = 0;
    std::uint32_t vertex_count = 0;
    std::uint32_t node_count = 0;
    std::uint32_t leaf_bytes = 0;
    std::uint32_t source_count = 0;
    std::uint32_t source_triangles = 0;
    std::uint32_t copy_count = 0;
    std::uint32_t checksum = 0;
    // Vectors have a fourth element, which is zero.
    alignas(16) float origin[4] = {};
    alignas(16) std::int32_t extent[4] = {};
    alignas(16) float extent_steps[4] = {};  // the same in float, exactly
    float steps_per_unit = 0.0f;             // 2^-step_exponent
    float base_unit = 0.0f;                  // lattice steps that a node's base counts in
    float max_error = 0.0f;
    std::int16_t step_exponent = 0;
    std::uint8_t bits = 0;
    std::uint8_t depth = 0;
    std::uint8_t id_bits = 0;
    format::Profile profile = format::Profile::fast;

    /// Fills in what follows from bits, step_exponent and extent.
    void derive() noexcept;
};

}  // namespace detail

/// A view of a baked mesh: a few words, copied freely, owning nothing. Either empty (no triangles; every query finds
/// nothing) or opened. The bytes must outlive it and stay unchanged; they are never written.
class Blob {
public:
    constexpr Blob() noexcept = default;

    /// Storage indices: every Triangle that a query answers with has an index below this. Copies are counted in.
    [[nodiscard]] constexpr std::uint32_t triangle_count() const noexcept { return data_.triangle_count; }
    /// How many storage indices are copies of another triangle, which has a lower one: above zero only when the blob
    /// was baked with Builder::spatial_splits. No query answers with a copy. for_each_hit and for_each_overlap refuse a
    /// blob with copies: they would have to remember what they have reported. They answer false at once and visit
    /// nothing.
    [[nodiscard]] constexpr std::uint32_t copy_count() const noexcept { return data_.copy_count; }
    [[nodiscard]] constexpr std::uint32_t vertex_count() const noexcept { return data_.vertex_count; }
    [[nodiscard]] constexpr std::uint32_t size_bytes() const noexcept { return data_.size; }
    [[nodiscard]] constexpr std::uint32_t checksum() const noexcept { return data_.checksum; }
    /// Nodes on the longest way down, at most format::max_depth.
    [[nodiscard]] constexpr unsigned depth() const noexcept { return data_.depth; }
    [[nodiscard]] constexpr unsigned bits() const noexcept { return data_.bits; }
    [[nodiscard]] constexpr format::Profile profile() const noexcept { return data_.profile; }
    /// The lattice step, a power of two, in world units.
    [[nodiscard]] float step() const noexcept;
    /// The baked surface differs from its source by at most this, in world units.
    [[nodiscard]] constexpr float max_error() const noexcept { return data_.max_error; }
    /// Corners of the box around all triangles, each coordinate rounded to float. Two zeros when empty.
    [[nodiscard]] Vec3 bounds_min() const noexcept;
    [[nodiscard]] Vec3 bounds_max() const noexcept;
    /// Every edge is shared by exactly two triangles of opposite direction.
    [[nodiscard]] constexpr bool closed() const noexcept { return (data_.features & format::feature::closed) != 0; }
    [[nodiscard]] constexpr bool has_original_ids() const noexcept { return data_.ids != nullptr; }
    [[nodiscard]] constexpr bool has_materials() const noexcept { return data_.materials != nullptr; }
    /// Whether contact.hpp has something to say.
    [[nodiscard]] constexpr bool has_edge_flags() const noexcept { return data_.edge_flags != nullptr; }

    /// For the library's own parts and its tests; its layout is no promise.
    [[nodiscard]] constexpr const detail::BlobData& data() const noexcept { return data_; }

private:
    friend Status open(std::span<const std::byte> bytes, Blob& blob) noexcept;
    friend Status open_trusted_image(std::span<const std::byte> bytes, Blob& blob) noexcept;
    detail::BlobData data_;
};

/// Proves that `bytes` is a blob on which every query is safe, and points `blob` at it. Any bytes, any alignment: reads
/// only inside `bytes`, writes only `blob`, no heap, no recursion, time proportional to the size. On any status but ok
/// the blob is empty. It does not promise that a maliciously made blob describes the mesh that you baked: sign it for
/// that.
[[nodiscard]] Status open(std::span<const std::byte> bytes, Blob& blob) noexcept;

/// Opens in O(1) a blob that is linked into your own program: firmware that cannot wait for `open`, or has no room for
/// it. It trusts that `bytes` are, each one, what the baker wrote: nobody changed them since, no flash cell, no cable
/// and no stranger. Where that is not so, queries may read anywhere and need not end; `open` is for bytes of any other
/// origin.
///
/// What is checked is the header and nothing behind it: magic (which also tells a wrong byte order), version, that the
/// sizes of all sections add up to the number of bytes, a profile and features that this library reads, each field
/// within its range. Those are refused as `open` refuses them, and then the blob is empty. The checksum is not
/// compared. A blob that both open, both open alike.
[[nodiscard]] Status open_trusted_image(std::span<const std::byte> bytes, Blob& blob) noexcept;

/// Where a triangle came from: which input file, which mesh in it, which triangle of that mesh, all counted from 0.
///
/// The blob's corners a, b, c are the source's corners first_corner, first_corner + 1 and first_corner + 2, modulo 3,
/// in the same winding; in profile fast first_corner is always 0. Queries give u and v as the weights of the blob's b
/// and c. So the weights of the source's second and third corner are u and v for first_corner 0, 1 - u - v and u for 1,
/// v and 1 - u - v for 2.
struct OriginalTriangle {
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    std::uint32_t first_corner = 0;  ///< 0, 1 or 2
    friend constexpr bool operator==(const OriginalTriangle&, const OriginalTriangle&) = default;
};

/// False, and `original` untouched, when the blob carries no ids or has no such triangle. O(log(number of meshes)).
bool original_triangle(const Blob& blob, Triangle triangle, OriginalTriangle& original) noexcept;

/// The material number given at bake, or 0 when the blob carries none or has no such triangle. O(1).
[[nodiscard]] std::uint16_t material(const Blob& blob, Triangle triangle) noexcept;

}  // namespace espalier
// ---- espalier/ray.hpp
// Rays and segments against a blob: closest hit, the first few hits, any hit, all hits, many rays in one call.
//
// Numbers. The ray is rounded once onto a grid finer than the asset's lattice (from beyond 2^23 lattice steps, as
// finely as float32 resolves its origin: docs/numerics.md), and that ray is answered exactly: whether a triangle is
// hit, within [t_min, t_max], is decided in integers, touching counts, and neighbours never leave a gap. t, u, v are
// within 4 ulp of the exact values (t is infinite where float32 ends), the normal's coordinates within 4 ulp of 1. A
// ray inside the plane of a triangle does not hit that triangle. The rounding mode must be to nearest, as it is unless
// a program changes it.
//
// Arguments. Any bit pattern is safe. A NaN anywhere, an infinite origin or direction, a zero direction, or an origin
// more than 2^120 lattice steps or all of float32 away: no hit, O(1). t_max may be infinite; t_min below zero counts as
// zero; t_min > t_max hits nothing.

// ---- espalier/function_ref.hpp
// A callable that is passed down and never kept: two pointers, no heap.

namespace espalier {

template <class Signature>
class FunctionRef;

/// Refers to any callable with a fitting signature: a lambda, a function object, a function. The callable must outlive
/// the call that it is passed to, and must not throw: the runtime is built without exceptions.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
public:
    template <class Callable>
    requires(
        !std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef> &&
        std::is_invocable_r_v<Result, Callable&,
                              Arguments...>) constexpr FunctionRef(Callable&& callable) noexcept {  // NOLINT(google-explicit-constructor):
                                                                                                    // a parameter type
        using Target = std::remove_reference_t<Callable>;
        if constexpr (std::is_function_v<Target>) {
            target_.function = reinterpret_cast<void (*)()>(&callable);
            call_ = [](Pointer target, Arguments... arguments) -> Result {
                return (*reinterpret_cast<Target*>(target.function))(std::forward<Arguments>(arguments)...);
            };
        } else {
            target_.object = const_cast<void*>(static_cast<const volatile void*>(&callable));
            call_ = [](Pointer target, Arguments... arguments) -> Result {
                return (*static_cast<Target*>(target.object))(std::forward<Arguments>(arguments)...);
            };
        }
    }

    constexpr Result operator()(Arguments... arguments) const {
        return call_(target_, std::forward<Arguments>(arguments)...);
    }

private:
    union Pointer {
        void* object;
        void (*function)();
    };
    Pointer target_ = {nullptr};
    Result (*call_)(Pointer, Arguments...) = nullptr;
};

}  // namespace espalier
// ---- espalier/shapes.hpp
// The shapes that queries ask with, in the units and axes that the asset was baked in.

namespace espalier {

struct Segment {
    Vec3 from;
    Vec3 to;
};

struct Sphere {
    Vec3 center;
    float radius = 0.0f;
};

/// All points within `radius` of the segment from `from` to `to`. With from == to it is a sphere.
struct Capsule {
    Vec3 from;
    Vec3 to;
    float radius = 0.0f;
};

/// An axis-aligned box. Empty where a coordinate of `min` is above that of `max`; flat ones and points are boxes too.
struct Box {
    Vec3 min;
    Vec3 max;
};

/// A box of any orientation: each half axis leads from the center to the middle of a face. They need not be
/// perpendicular, so that a sheared box is as good, and may be zero.
struct OrientedBox {
    Vec3 center;
    Vec3 half_axes[3];
};

/// The half-space dot(normal, x) <= offset. The normal, which points outward, may have any length but zero.
struct Plane {
    Vec3 normal;
    float offset = 0.0f;
};

}  // namespace espalier

namespace espalier {

/// Which sides of triangles a ray sees. The front is the side from which the corners run counter-clockwise.
enum class Faces : std::uint8_t { both, front, back };

struct Ray {
    Vec3 origin;
    Vec3 direction;  ///< any length; t counts in it
    float t_min = 0.0f;
    float t_max = __builtin_inff();
    Faces faces = Faces::both;
};

/// Corners are those of the blob (walk.hpp); which of the source's they are, OriginalTriangle says.
struct RayHit {
    float t = 0.0f;  ///< the point is origin + t * direction
    float u = 0.0f;  ///< barycentric weight of corner b
    float v = 0.0f;  ///< barycentric weight of corner c; corner a has 1 - u - v
    Vec3 normal;     ///< unit geometric normal of the front side
    Triangle triangle;
};

/// Called with a triangle that the ray hits; answers whether the hit counts. May be called for hits behind the closest
/// one, in no promised order: its answer must depend on the triangle alone. It must not throw.
using TriangleFilter = FunctionRef<bool(Triangle)>;

/// The hit with the smallest t, of equal t (before it is clamped into the window) the one with the lowest storage
/// index. `hit` is untouched when there is none.
bool raycast(const Blob& blob, const Ray& ray, RayHit& hit) noexcept;
bool raycast(const Blob& blob, const Ray& ray, RayHit& hit, TriangleFilter filter);

/// Whether the ray hits anything. Cheaper than the closest hit.
[[nodiscard]] bool occluded(const Blob& blob, const Ray& ray) noexcept;
[[nodiscard]] bool occluded(const Blob& blob, const Ray& ray, TriangleFilter filter);

/// The ray from `from` to `to`, t running from 0 to 1: for every query that takes a ray. Its direction, to - from,
/// rounds like any other ray's: the end may lie off `to` by 2^-23 of the length. A segment of length zero hits nothing.
constexpr Ray along(const Segment& segment) {
    const Vec3& from = segment.from;
    const Vec3& to = segment.to;
    return {from, {to.x - from.x, to.y - from.y, to.z - from.z}, 0.0f, 1.0f, Faces::both};
}
// Templates, so that two vectors in braces still mean a ray.
template <std::same_as<Segment> S>
bool raycast(const Blob& blob, const S& segment, RayHit& hit) noexcept {
    return raycast(blob, along(segment), hit);
}
template <std::same_as<Segment> S>
[[nodiscard]] bool occluded(const Blob& blob, const S& segment) noexcept {
    return occluded(blob, along(segment));
}

/// How many places of an array were filled, and whether (output_full) there would have been more.
struct HitCount {
    std::size_t count = 0;
    QueryStatus status = QueryStatus::ok;
};

/// The first hits along the ray, as many as `hits` has places, sorted as raycast chooses: by t before it is clamped
/// into the window, of equal t by storage index. The first is what raycast answers; a triangle that has copies appears
/// once. The rest of `hits` may be overwritten. Until there are more hits than places it looks at all of them,
/// afterwards only at what is nearer: O(log(places)) for each hit, O(places) in a blob with copies. With no places it
/// tells by the status whether there is any hit.
HitCount closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits) noexcept;
HitCount closest_hits(const Blob& blob, const Ray& ray, std::span<RayHit> hits, TriangleFilter filter);

/// The closest hit of each ray, the same to the bit as one call for each, in less time: rays next to each other that
/// have about the same origin and direction share their way through the tree (groups of 16), others are interleaved.
/// Answers as many rays as both spans have, and leaves the rest of `hits` untouched. hits[i] belongs to rays[i]; a ray
/// without a hit gets no_triangle, an infinite t and zeros. The spans must not overlap. How many rays hit. Takes more
/// stack than a single ray, up to 12 KB; on cores without lanes hardly more.
std::size_t raycast(const Blob& blob, std::span<const Ray> rays, std::span<RayHit> hits) noexcept;

/// Whether each ray hits anything: answers[i] is 1 or 0. Otherwise like the batch of closest hits.
std::size_t occluded(const Blob& blob, std::span<const Ray> rays, std::span<std::uint8_t> answers) noexcept;

/// Every hit, in storage order (not sorted by t), until the visitor answers stop. True when it saw them all. The
/// visitor must not throw. False at once, and nothing is visited, when blob.copy_count() is not 0.
bool for_each_hit(const Blob& blob, const Ray& ray, FunctionRef<Visit(const RayHit&)> visit);

}  // namespace espalier
// ---- espalier/statistics.hpp
// The same answers with the work counted: for heat maps, cost models and tests of the culling.

namespace espalier {

/// Work of the scalar path, added up over calls.
struct QueryCounters {
    std::uint64_t nodes = 0;       ///< tests of a node's children; a node may be tested up to four times
    std::uint64_t leaves = 0;      ///< leaves that were decoded
    std::uint64_t groups = 0;      ///< started groups of 8 triangles in those leaves: what lanes test at once
    std::uint64_t triangles = 0;   ///< triangles that went through the filter
    std::uint64_t candidates = 0;  ///< triangles that were decided exactly

    void count_node() { ++nodes; }
    void count_leaf() { ++leaves; }
    void count_triangles(unsigned count) {  // of one leaf
        groups += (count + 7) / 8;
        triangles += count;
    }
    void count_candidates(unsigned count) { candidates += count; }
};

/// raycast, counting. Always the scalar path, so that the counts are the same on every machine.
bool raycast_counted(const Blob& blob, const Ray& ray, RayHit& hit, QueryCounters& counters) noexcept;

}  // namespace espalier

namespace espalier {

/// Whether the surface may overlap the shape. Each of these queries adds its work to `counters` where there are some.
[[nodiscard]] bool may_overlap(const Blob& blob, const Sphere& sphere, float accuracy,
                               QueryCounters* counters = nullptr) noexcept;
[[nodiscard]] bool may_overlap(const Blob& blob, const Box& box, float accuracy,
                               QueryCounters* counters = nullptr) noexcept;

/// Whether the ray may hit something. Looks at no faces where it stops at boxes: ray.faces decides for triangles only.
[[nodiscard]] bool may_be_occluded(const Blob& blob, const Ray& ray, float accuracy,
                                   QueryCounters* counters = nullptr) noexcept;

/// The distance of the surface is surely at least `lower` and at most `upper`. They differ by at most accuracy *
/// sqrt(3), and by 2^-16 of the distance.
struct DistanceBounds {
    float lower = 0.0f;
    float upper = 0.0f;
};

/// Bounds of the distance from `point` to the surface. False, and `bounds` untouched, when nothing is within
/// max_distance. Where `upper` is above max_distance something may or may not be within it.
bool distance_bounds(const Blob& blob, Vec3 point, float max_distance, float accuracy, DistanceBounds& bounds,
                     QueryCounters* counters = nullptr) noexcept;

}  // namespace espalier
// ---- espalier/bounds.hpp
// Bounds of the whole asset that are tighter than its axis-aligned box (Blob::bounds_min, bounds_max): for blobs that
// were baked with them. Cheap first tests for whoever holds many assets.
//
// Numbers. Each holds every corner of every triangle, as baked and as rounded to float: what is stored holds the baked
// ones exactly, and the floats are rounded outward, by some 2^-20 of the asset's size and of its distance from the
// world's origin. Of bytes that a stranger made `open` does not prove that they hold anything: such bounds give wrong
// answers, safely.

namespace espalier {

/// A sphere close to the smallest one (Badoiu, Clarkson 2003). False, and `sphere` untouched, when the blob has none.
bool bounding_sphere(const Blob& blob, Sphere& sphere) noexcept;

/// A box of little surface, in any orientation (a search over rotations: Chang, Gorissen, Melchior 2011). Its half axes
/// are perpendicular up to rounding. False, and `box` untouched, when the blob has none.
bool oriented_bounds(const Blob& blob, OrientedBox& box) noexcept;

/// Slabs along 13 fixed directions (Klosowski et al. 1998): lo[k] <= dot(directions[k], corner) <= hi[k].
struct KDop {
    static constexpr unsigned count = 13;
    static constexpr Vec3 directions[count] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                               {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                               {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
    float lo[count] = {};
    float hi[count] = {};
};

/// False, and `k_dop` untouched, when the blob has none.
bool k_dop_bounds(const Blob& blob, KDop& k_dop) noexcept;

/// True only if the sphere, or box, touches no triangle: judged by whichever bounds the blob carries and by its
/// axis-aligned box, without a look at the tree. False says nothing. NaN, a negative radius and an empty box touch
/// nothing; any other bit pattern is safe.
[[nodiscard]] bool is_outside_bounds(const Blob& blob, const Sphere& sphere) noexcept;
[[nodiscard]] bool is_outside_bounds(const Blob& blob, const Box& box) noexcept;

}  // namespace espalier
// ---- espalier/collide.hpp
// Two blobs against each other: whether their surfaces touch, where, and how far apart they are.
//
// Placement. b stands in a's space: a point x of b is scaled, turned, then moved: rotation * (scale * x) + translation.
// Numbers. Both meshes are rounded once onto one grid of integers, whose step is a power of two times a's lattice step:
// the smallest for which all coordinates, counted from a's lattice origin, stay within 2^24, though no smaller than
// 2^-6 of the finer of the two lattices' steps. A vertex moves by at most half a step of it along each axis, which is
// 2^-7 of a lattice step for assets of 16 bits and like size, and never more than 2^-24 of the farthest coordinate; a's
// vertices do not move at all where the grid is not coarser than their lattice. The rotation's entries are rounded to
// 2^-30. Vertices that triangles share stay shared. Of these two meshes of integers every answer is exact (touching
// counts), as if all pairs had been asked, and the same on every machine; docs/numerics.md has the proofs.
// Arguments. Any bit pattern is safe. QueryStatus::invalid_argument for NaN, infinities, a rotation of length 0, a
// scale that is not above 0, a maximal distance that is negative or NaN (infinity is fine); out_of_range when a blob's
// corner is placed more than 2^80 of a's lattice steps away, and for distances when the bounds are apart by more than
// 1,024 times the longer one's longest side, along some axis, unless max_distance is less than half of that: then
// nothing is found. All of it O(1), and refused queries leave results alone. Cost. The stack is bounded
// (docs/benchmarks.md), steps by the product of the two trees' sizes, and for distances by 9 times both depths besides,
// which a first look at likely places takes: whoever places meshes that others made gives a work limit. It counts pairs
// of nodes or leaves, that look's too; when it is reached, the answer is work_limit, at the same pair on every machine.
// OBB tests after Gottschalk, Lin and Manocha (1996), triangles after Devillers and Guigue (2002).

namespace espalier {

/// Of any length but zero; the default turns nothing.
struct Quaternion {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    float w = 1.0f;
};

/// Where the second blob stands in the first one's space.
struct Placement {
    Quaternion rotation;
    Vec3 translation;
    float scale = 1.0f;
};

/// A triangle of each blob.
struct TrianglePair {
    Triangle a;
    Triangle b;
    friend constexpr auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// Pairs of nodes or leaves that a query may visit.
struct WorkLimit {
    std::uint64_t pairs = ~std::uint64_t{0};
};

/// Whether any triangle of a touches any of b. `answer` is written with QueryStatus::ok, and with work_limit: false.
QueryStatus collides(const Blob& a, const Blob& b, const Placement& placement, bool& answer,
                     WorkLimit limit = {}) noexcept;

/// One pair that touches: the first that the search for any finds, the same on every machine. `found` as in collides;
/// `contact` is untouched unless something is found.
QueryStatus first_contact(const Blob& a, const Blob& b, const Placement& placement, TrianglePair& contact, bool& found,
                          WorkLimit limit = {}) noexcept;

/// Every pair that touches, each once, until the visitor answers stop (the status is ok then too). The order is that
/// of the two trees, the same on every machine, and not sorted. Refused with has_copies when either blob has copies.
/// With work_limit the visitor has seen a part.
QueryStatus for_each_contact(const Blob& a, const Blob& b, const Placement& placement,
                             FunctionRef<Visit(const TrianglePair&)> visit, WorkLimit limit = {});

/// The same into an array: the first contacts.size() pairs. `count` says how many were written; output_full when there
/// are more.
QueryStatus all_contacts(const Blob& a, const Blob& b, const Placement& placement, std::span<TrianglePair> contacts,
                         std::size_t& count, WorkLimit limit = {}) noexcept;

/// How near two blobs are. Points in a's space.
struct PairDistance {
    float distance = 0.0f;  ///< within 4 ulp of that of the two rounded meshes
    Vec3 on_a;              ///< each within 16 ulp of the largest coordinate of the two placed bounds
    Vec3 on_b;
    TrianglePair pair;
};

/// The smallest distance of the two surfaces within max_distance (which may be infinite). Distances are compared by
/// their squares, each within 8 ulp of the exact one; of equal ones the lowest a wins, then the lowest b. Where the
/// surfaces touch, the distance is 0 and the pair the first that this search finds. `nearest` is untouched unless
/// something is found; with work_limit it may be one that is not the nearest.
QueryStatus minimum_distance(const Blob& a, const Blob& b, const Placement& placement, float max_distance,
                             PairDistance& nearest, bool& found, WorkLimit limit = {}) noexcept;

/// Whether the surfaces are within that distance of each other: decided exactly, equal counts.
QueryStatus within_distance(const Blob& a, const Blob& b, const Placement& placement, float distance, bool& answer,
                            WorkLimit limit = {}) noexcept;

}  // namespace espalier
// ---- espalier/contact.hpp
// Contacts that slide over a mesh: which edges are real ones, and which only join two triangles of one surface.
//
// A body that slides over a flat floor of many triangles touches edges between them, with contact normals that lean
// against the motion: it stumbles over nothing. Blobs that were baked with edge flags know which edges these are.
// Engines have the same under the names of internal edges (Bullet), active edges (Jolt), edge flags (PhysX, Box3D).
//
// Arguments. Any bit pattern is safe. Bytes that a stranger made may carry wrong flags: they are hints, nothing more.

namespace espalier {

/// How the surface bends at an edge, seen from the front of its triangles. Decided exactly on the baked triangles.
enum class EdgeKind : std::uint8_t {
    flat = 0,     ///< the normals of the two triangles differ by no more than the angle given at bake
    convex = 1,   ///< a ridge: the other triangle lies below this one's plane, or is folded back onto it
    concave = 2,  ///< a valley
    open = 3,     ///< not shared by exactly two triangles that run along it in opposite directions: a border, three
                  ///< triangles and more, or two that do not face the same way. A closed blob has none
};

/// Corners are those of the blob (walk.hpp).
struct EdgeKinds {
    EdgeKind ab = EdgeKind::open;
    EdgeKind bc = EdgeKind::open;
    EdgeKind ca = EdgeKind::open;
};

/// False, and `kinds` untouched, when the blob carries no edge flags or has no such triangle. O(1).
bool edge_kinds(const Blob& blob, Triangle triangle, EdgeKinds& kinds) noexcept;

/// A point where a body touches a triangle. closest_triangles gives triangle and feature, one for each triangle nearby.
struct Contact {
    Triangle triangle;
    Feature feature = Feature::face;  ///< the part of the triangle that the contact lies on
    Vec3 normal;                      ///< from the surface to the body, of any length
};

/// Whether the contact lies on inner edges alone: on a flat or concave one, or on a corner between two such. If so,
/// `normal` becomes the normal that it should have: the triangle's, of length 1 (each coordinate within 4 ulp of 1), on
/// the side to which the contact's normal points. Otherwise, on a face, a convex or an open edge, or with a blob
/// without edge flags, `normal` is left alone: the contact's own is right.
///
/// A corner is judged by the two edges of its own triangle: where it also is the end of a ridge between other
/// triangles, their contacts keep their normals and this one does not.
bool is_on_inner_edge(const Blob& blob, const Contact& contact, Vec3& normal) noexcept;

}  // namespace espalier
// ---- espalier/inside.hpp
// Whether a point is inside of a closed surface, and how far it is from it with a sign.
//
// Only a blob whose closed flag is set has an inside (Blob::closed); a blob with copies refuses too. Inside is where
// the winding number is not zero: overlapping shells are inside of both, a cavity whose triangles face inward is
// outside, and a surface that was baked inside out has the same inside. A point on the surface is inside: touching
// counts.
//
// Numbers. The point is rounded once onto a grid finer than the asset's lattice (docs/numerics.md). The winding number
// is counted exactly: along an axis, in integers, with rules for the edges that leave no direction special (the
// perturbation of Edelsbrunner and Mücke 1990). The distance and its witness are those of closest_point.
// Arguments. Any bit pattern is safe. A NaN, an infinite point or a negative max_distance is an invalid_argument, O(1).
// Cost. As much as the surface beside the way from the point out of the asset's box, the shortest along an axis.

// ---- espalier/nearest.hpp
// The point of the surface that is closest to a given point, segment or box, and the triangles that are.
//
// Numbers. The point is rounded once onto a grid finer than the asset's lattice (docs/numerics.md). Distances are
// compared by their correctly ordered squares, within 6 ulp of the exact ones; of equal ones the lowest storage index
// wins. Whether anything lies within max_distance is decided exactly. The distance is within 4 ulp, the point's
// coordinates within 14 ulp of the largest coordinate of the asset's bounds.
// Arguments. Any bit pattern is safe. A NaN, a point that is infinite or more than 2^120 lattice steps away, or a
// negative max_distance finds nothing, O(1).

namespace espalier {

/// Corners are those of the blob (walk.hpp); which of the source's they are, OriginalTriangle says.
struct Nearest {
    Vec3 point;
    float distance = 0.0f;
    float u = 0.0f;  ///< barycentric weight of corner b
    float v = 0.0f;  ///< barycentric weight of corner c; corner a has 1 - u - v
    Triangle triangle;
    Feature feature = Feature::face;  ///< the part of the triangle that the point lies on, exactly
};

/// The closest point of the surface within max_distance (which may be infinite) of `point`. `nearest` is untouched when
/// there is none.
bool closest_point(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept;

/// The triangles closest to `point`, as many as `nearest` has places and lie within max_distance, each with its own
/// closest point, sorted as closest_point chooses: by distance (squared, before the root is rounded), of equal ones by
/// storage index. The first is what closest_point answers; a triangle that has copies appears once. How many there are;
/// the rest of `nearest` is untouched. O(log(places)) for each triangle that comes nearer than those found before,
/// O(places) in a blob with copies.
std::size_t closest_triangles(const Blob& blob, Vec3 point, float max_distance, std::span<Nearest> nearest) noexcept;

/// The closest pair of points, one of a shape and one of the surface.
struct NearestPair {
    Vec3 on_shape;
    Vec3 on_surface;
    float distance = 0.0f;
    float u = 0.0f;  ///< barycentric weight of corner b
    float v = 0.0f;  ///< barycentric weight of corner c; corner a has 1 - u - v
    Triangle triangle;
};

/// The triangle closest to a segment, which may have length zero, or to a box, all of it and not its sides only, and a
/// pair of points that are as close. Distance 0 exactly where they share a point, of which one is told then.
///
/// ok, and no_triangle at max_distance when nothing is within max_distance (which may be infinite), or the box is
/// empty; the points are zero then. invalid_argument for a NaN, an infinity in the shape or a negative max_distance;
/// out_of_range for a shape that reaches more than 2^36 lattice steps from any vertex of the asset along an axis.
/// `pair` is untouched unless ok. The shape is rounded as finely as its farthest coordinate allows, to 2^-6 of a
/// lattice step at most. Distances are ordered, and numbers as exact, as closest_point's; the coordinates of on_shape
/// are within 14 ulp of the largest one of the shape and of the asset. Distances of segments between 0 and 2^-63
/// lattice steps, which take segments of 2^26 steps and more, are told as 2^-63 steps.
QueryStatus closest_to_segment(const Blob& blob, const Segment& segment, float max_distance,
                               NearestPair& pair) noexcept;
QueryStatus closest_to_box(const Blob& blob, const Box& box, float max_distance, NearestPair& pair) noexcept;

}  // namespace espalier

namespace espalier {

/// ok, not_closed, has_copies or invalid_argument; `inside` is untouched unless ok. A point however far away is
/// outside.
QueryStatus contains(const Blob& blob, Vec3 point, bool& inside) noexcept;

/// The closest point of the surface, its distance negative inside. Where there is none within max_distance (which may
/// be infinite), nearest.triangle is no_triangle and the distance is max_distance, negative inside. Besides the
/// refusals of `contains`, out_of_range for a point more than 2^120 lattice steps away; `nearest` is untouched unless
/// ok.
QueryStatus signed_distance(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept;

}  // namespace espalier
// ---- espalier/lattice.hpp
// The lattice of a blob, and queries whose arguments are whole lattice steps: for cores without floats, which link none
// for them. Whoever knows at build time where things are asks in steps right away; what moves counts in steps itself.
//
// Steps. A world coordinate is origin + steps * 2^step_exponent. The asset reaches from 0 to `extent` along each axis.
//
// Numbers. Nothing is rounded: whether a triangle touches the box, whether the segment hits it and which hit comes
// first are decided exactly, on the numbers given. Touching counts. A segment inside the plane of a triangle does not
// hit that triangle, and a segment of length zero hits nothing: as of rays (ray.hpp).
//
// Arguments. A box may be any numbers; with min above max along an axis it is empty and overlaps nothing. The ends of a
// segment must be within max_segment_steps along each axis, else the answer is out_of_range, O(1).

// ---- espalier/overlap.hpp
// Volumes against a blob. The triangles are a surface: a volume inside a closed mesh that touches none overlaps none.
//
// Shapes. Sphere, Capsule, Box, OrientedBox, a triangle (Corners), a convex set of planes (a span of Plane: a frustum,
// a k-DOP; not necessarily bounded, at most max_planes).
//
// Numbers. A shape is rounded once onto a grid finer than the asset's lattice (docs/numerics.md); whether a triangle
// overlaps is then decided exactly, and touching counts. Coordinates are rounded to 1/64 of a lattice step near the
// asset, farther away to as much as float32 resolves there; normals of planes are turned by less than 2^-23 radians
// about the corner of the asset's bounds.
//
// Arguments. Any bit pattern is safe. What follows overlaps nothing, O(1), and collect_overlaps says invalid_argument:
// a NaN; an infinite coordinate, but for those of a Box; a negative radius; a normal that is zero (below 2^-126) or
// infinite; more than max_planes planes. Otherwise infinite radii, boxes and offsets mean what they say; an empty Box
// (min above max) overlaps nothing; no planes at all are all of space; flat shapes, segments and points are shapes too.
// Distance. A Sphere may be up to 2^120 lattice steps away, a Box and an offset anywhere. Of other shapes those parts
// that matter must be within 2^36 lattice steps of the asset: a capsule's ends; a box or triangle that may reach the
// asset and is larger than that. Beyond, and for planes of an asset that is itself 2^60 steps from the world's origin,
// the answer is out_of_range: overlaps says false, for_each_overlap visits nothing and says false.

namespace espalier {

/// Of a convex set. 26-DOPs fit.
inline constexpr std::size_t max_planes = 32;

/// Whether any triangle overlaps the shape.
[[nodiscard]] bool overlaps(const Blob& blob, const Sphere& sphere) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const Capsule& capsule) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const Box& box) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const OrientedBox& box) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, const Corners& triangle) noexcept;
[[nodiscard]] bool overlaps(const Blob& blob, std::span<const Plane> planes) noexcept;

/// Every overlapping triangle, in storage order, until the visitor answers stop. True when it saw them all.
/// The visitor must not throw. False at once, and nothing is visited, when blob.copy_count() is not 0.
bool for_each_overlap(const Blob& blob, const Sphere& sphere, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const Capsule& capsule, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const Box& box, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const OrientedBox& box, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, const Corners& triangle, FunctionRef<Visit(Triangle)> visit);
bool for_each_overlap(const Blob& blob, std::span<const Plane> planes, FunctionRef<Visit(Triangle)> visit);

/// What collect_overlaps did.
struct OverlapPage {
    QueryStatus status = QueryStatus::ok;  ///< ok: these were the last; output_full: there are more; else why not
    std::uint32_t count = 0;               ///< triangles written
    /// What to pass as `first` to go on: with output_full the storage index of the first triangle that found no room;
    /// with ok the blob's triangle_count; else `first` as it was.
    std::uint32_t next = 0;
};

/// The overlapping triangles with storage indices from `first` on, in storage order, as many as `out` holds. Page after
/// page gives each triangle exactly once, and nothing is kept in between: not even the array needs to be of one size. A
/// page walks over what lies before it without decoding any of its triangles. An array of no elements asks whether
/// there is anything left.
OverlapPage collect_overlaps(const Blob& blob, const Sphere& sphere, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const Capsule& capsule, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const Box& box, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const OrientedBox& box, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, const Corners& triangle, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;
OverlapPage collect_overlaps(const Blob& blob, std::span<const Plane> planes, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;

}  // namespace espalier

namespace espalier {

struct Lattice {
    Vec3 origin;
    std::int32_t step_exponent = 0;
    std::int32_t extent[3] = {};
};

/// Of a blob. All zeros when it is empty.
[[nodiscard]] Lattice lattice_of(const Blob& blob) noexcept;

/// A point of the lattice.
struct Steps {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    friend constexpr bool operator==(const Steps&, const Steps&) = default;
};

/// As Box.
struct BoxInSteps {
    Steps min;
    Steps max;
};

/// As Segment.
struct SegmentInSteps {
    Steps from;
    Steps to;
};

inline constexpr std::int32_t max_segment_steps = 1 << 29;

// From the world to the lattice and back. They take floats, but no float operation: exactly rounded on every core.
// invalid_argument for a NaN or an infinity; out_of_range for what is beyond max_segment_steps. Then nothing is
// written. Subnormal coordinates count as zero.

/// The nearest lattice point, of two the upper one.
QueryStatus to_steps(const Lattice& lattice, const Vec3& world, Steps& steps) noexcept;
/// The smallest box in whole steps that holds the world's box.
QueryStatus steps_around(const Lattice& lattice, const Box& world, BoxInSteps& box) noexcept;
/// Where a lattice point is, each coordinate within 2 roundings to float. Needs float operations.
[[nodiscard]] Vec3 to_world(const Lattice& lattice, const Steps& steps) noexcept;

/// The three ways of asking about a box, as in overlap.hpp.
[[nodiscard]] bool overlaps(const Blob& blob, const BoxInSteps& box) noexcept;
bool for_each_overlap(const Blob& blob, const BoxInSteps& box, FunctionRef<Visit(Triangle)> visit);
OverlapPage collect_overlaps(const Blob& blob, const BoxInSteps& box, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;

struct HitInSteps {
    /// Where on the segment: from + (to - from) * t / 2^31, rounded down; 2^31 at its end.
    std::uint32_t t = 0;
    /// front or back: the side from which the segment meets the triangle.
    Faces side = Faces::front;
    Triangle triangle = no_triangle;
};

/// The first hit along the segment: the one with the smallest t, compared exactly and not as rounded, of equal ones
/// that with the lowest storage index. hit.triangle is no_triangle where nothing is hit. ok or out_of_range; `hit` is
/// untouched unless ok.
QueryStatus first_hit(const Blob& blob, const SegmentInSteps& segment, HitInSteps& hit) noexcept;

/// Whether the segment hits anything. Cheaper than the first hit. `hit` is untouched unless ok.
QueryStatus any_hit(const Blob& blob, const SegmentInSteps& segment, bool& hit) noexcept;

}  // namespace espalier
// ---- espalier/sweep.hpp
// Shapes that move along a straight line until they touch the surface: a sphere, a capsule, an axis-aligned box.
//
// Numbers. Centre or corners, displacement and radius are rounded once onto a grid finer than the asset's lattice: to
// multiples of 2^-f lattice steps, where f <= 6 is the most for which everything, seen from the start, is below 2^24 of
// them (docs/numerics.md). That sweep is answered exactly. Whether a triangle is touched on the way, the ends included,
// is decided in integers; touching at one instant counts. `t` is a multiple of 2^-24 below the exact time of the first
// contact, and by no more than 2^-24: at t the shape does not touch the triangle yet. Of equal t the lowest storage
// index wins. The coordinates of `point` are within 14 ulp of the largest coordinate of the asset's bounds, those of
// `normal` within 4 ulp of 1, for the shape at t.
// Arguments. Any bit pattern is safe. `check_sweep` says in O(1) whether a sweep is answered; what it refuses finds
// nothing: a NaN, an infinity or a negative radius (invalid_argument); a start, a displacement or a radius of 2^34
// lattice steps or more, or an axis of a capsule longer than 2^25 of them along x, y or z, twice the size of the
// largest asset (out_of_range). Zero is a value like any other: of a radius, of a displacement, of a box's or an axis'
// length. A box whose min is above its max is empty and touches nothing.

namespace espalier {

struct SweepHit {
    /// The shape has moved by t * displacement: 0 <= t < 1. 0 when it touches at the start already.
    float t = 0.0f;
    /// On the triangle. Of a sphere, closest to the centre; of a capsule, closest to the axis; of a box, the middle of
    /// what of the triangle is in the box, which is grown by what it moves within 2^-24 of the way and by 2^-19 of the
    /// distance from its farthest corner to the triangle's.
    Vec3 point;
    /// Unit, from the surface towards the shape: from `point` to the centre or the axis. Of a box the axis that is the
    /// last to separate: a face's, then the triangle's normal, then a product of edges.
    Vec3 normal;
    Triangle triangle;
    /// It touches at the start: then `triangle` is the one of the lowest storage index that it touches there, `point`
    /// is the closest to the shape's middle, and `normal` leads from there to the middle. Where that is one point, and
    /// where a sphere's centre is on the triangle otherwise, the normal is the triangle's, on the side against the
    /// displacement.
    bool starts_overlapping = false;
};

/// The first contact on the way from the start by `displacement`. `hit` is untouched when there is none. The filter
/// says of a triangle whether it counts; it may be called for triangles that are touched later, in no promised order.
bool sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, SweepHit& hit) noexcept;
bool sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, SweepHit& hit, TriangleFilter filter);
bool sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, SweepHit& hit) noexcept;
bool sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, SweepHit& hit, TriangleFilter filter);
bool sweep(const Blob& blob, const Box& box, Vec3 displacement, SweepHit& hit) noexcept;
bool sweep(const Blob& blob, const Box& box, Vec3 displacement, SweepHit& hit, TriangleFilter filter);

/// Whether such a sweep is answered: ok, invalid_argument or out_of_range.
[[nodiscard]] QueryStatus check_sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement) noexcept;
[[nodiscard]] QueryStatus check_sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement) noexcept;
[[nodiscard]] QueryStatus check_sweep(const Blob& blob, const Box& box, Vec3 displacement) noexcept;

}  // namespace espalier
// ---- espalier/version.hpp
// The library's version. The format has its own (format.hpp).

namespace espalier {

inline constexpr int library_version_major = 0;
inline constexpr int library_version_minor = 1;
inline constexpr int library_version_patch = 0;
inline constexpr const char* library_version = "0.1.0";

}  // namespace espalier
// ---- espalier/walk.hpp
// Walking over what a blob holds.

namespace espalier {

/// Every triangle but copies in storage order, its corners rounded to float, until the visitor answers stop. True when
/// it saw all.
bool for_each_triangle(const Blob& blob, FunctionRef<Visit(Triangle, const Corners&)> visit);

/// The corners of one triangle, rounded to float as for_each_triangle gives them. False, and `corners` untouched, when
/// there is no such triangle. Looks at the children of a node for each level of the tree.
bool triangle_corners(const Blob& blob, Triangle triangle, Corners& corners) noexcept;

/// A child of a node: another node, or a leaf, which is a run of triangles.
struct TreeChild {
    Box box;  ///< rounded outward: it holds every corner below the child, as rounded to float too
    bool is_leaf = false;
    std::uint32_t node = 0;   ///< of a node: its number
    Triangle first;           ///< of a leaf: its first triangle
    std::uint32_t count = 0;  ///< of a leaf: how many triangles, copies counted in
};

struct TreeNode {
    std::uint32_t number = 0;  ///< 0 is the root
    unsigned depth = 0;        ///< 1 is the root's, Blob::depth() the largest
    unsigned child_count = 0;
    TreeChild children[format::max_children];  ///< nodes first, then leaves
};

/// What a visitor of nodes answers.
enum class NodeVisit : std::uint8_t {
    descend,  ///< go on to the node children
    skip,     ///< go on, but not below this node
    end,
};

/// The nodes of the tree, parents before their children, for views of the tree when debugging. True unless the visitor
/// said end. An empty blob has none. A box holds what is below it in every blob that was baked; of bytes that a
/// stranger made, `open` does not prove it.
bool for_each_node(const Blob& blob, FunctionRef<NodeVisit(const TreeNode&)> visit);

}  // namespace espalier
