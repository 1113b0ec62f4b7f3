// The header of a blob, and the limits on what it states.
#pragma once

#include <cstddef>
#include <cstdint>

namespace espalier {

/// The encoding of nodes and leaves, which also limits the number of triangles in a leaf. The numbers never change.
enum class Profile : std::uint8_t {
    fast = 0,      ///< plain nodes and plain leaves: the fastest rays and the largest blobs
    balanced = 1,  ///< packed nodes and strip leaves of at most max_balanced_entries entries
    small = 2,     ///< packed nodes and strip leaves of at most max_small_entries entries
    tiny = 3,      ///< packed nodes and predicted strips: the smallest blobs and the slowest rays
};

}  // namespace espalier

namespace espalier::format {

/// The version of the format, which is independent of the library's. A reader accepts its own major version and any
/// minor version up to its own.
inline constexpr std::uint16_t version_major = 2;
inline constexpr std::uint16_t version_minor = 2;
/// The lowest minor version that allows each feature. A writer states the lowest version that its features need.
inline constexpr std::uint16_t version_minor_of_deformable = 1;
inline constexpr std::uint16_t version_minor_of_id_runs = 2;
inline constexpr std::uint16_t version_minor_of_source_origin = 2;
inline constexpr std::uint32_t magic = 0x4C505345u;  // "ESPL"

// ---- limits -------------------------------------------------------------------------------------------------------
inline constexpr int max_bits = 24;  ///< lattice bits per axis, so that float32 holds every coordinate exactly
inline constexpr int min_step_exponent = -100;  ///< step = 2^exponent
inline constexpr int max_step_exponent = 100;
inline constexpr std::uint32_t max_nodes = 1u << 24;
inline constexpr unsigned max_depth = 16;           ///< nodes on the longest path down; sizes the stack of every query
inline constexpr unsigned max_children = 16;        ///< in any profile
inline constexpr unsigned max_leaf_triangles = 62;  ///< in any profile
inline constexpr unsigned max_leaf_vertices = 56;
inline constexpr unsigned max_leaf_entries = 64;  ///< in a strip
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
inline constexpr std::size_t extent_at = 52;            // 3 x u32, largest coordinate per axis (the smallest is 0);
                                                        // of a deformable blob the range of motion
inline constexpr std::size_t max_error_at = 64;         // f32, the blob's units
inline constexpr std::size_t depth_at = 68;             // u8
inline constexpr std::size_t id_kind_bits_at = 69;      // u8, 0..7, see `ids`
inline constexpr std::size_t source_count_at = 72;      // u32, entries of the source table
inline constexpr std::size_t source_triangles_at = 76;  // u32, triangles in the sources, dropped ones included
inline constexpr std::size_t id_step_bytes_at = 80;     // u32, see `ids`
// Fields of a deformable blob, which are zero in all others.
inline constexpr std::size_t position_count_at = 84;  // u32, positions of the sources, which refit() takes
inline constexpr std::size_t vertex_slots_at = 88;    // u32, total number of vertices in all leaves
inline constexpr std::size_t rest_cost_at = 92;       // f32, cost of the tree at rest, above 0
inline constexpr std::size_t pose_low_at = 96;        // 3 x u32, least coordinate of any vertex in this pose
inline constexpr std::size_t pose_high_at = 108;      // 3 x u32, greatest coordinate of any vertex in this pose
inline constexpr std::size_t reserved_at = 120;       // zero from here to the end, like the two bytes at 70
inline constexpr std::size_t bytes = 128;
static_assert(reserved_at < bytes && bytes % 64 == 0);
}  // namespace header

/// Bits of the features field. An optional section exists if and only if its bit is set, and the sections follow in the
/// order of the bits.
namespace feature {
inline constexpr std::uint32_t original_ids = 1u << 0;
inline constexpr std::uint32_t materials_8 = 1u << 1;
inline constexpr std::uint32_t materials_16 = 1u << 2;      // never together with materials_8
inline constexpr std::uint32_t closed = 1u << 3;            // no section: the triangles' boundary cancels along lines
inline constexpr std::uint32_t split_references = 1u << 4;  // triangles have copies in several leaves, see `copies`
inline constexpr std::uint32_t edge_flags = 1u << 5;        // see `edge_flags` below
inline constexpr std::uint32_t oriented_box = 1u << 6;      // see `bounds`, as for the next two
inline constexpr std::uint32_t bounding_sphere = 1u << 7;
inline constexpr std::uint32_t k_dop = 1u << 8;
inline constexpr std::uint32_t deformable =
    1u << 9;  // vertices can move, see `corners` and `vertex_sources`; profile fast only
inline constexpr std::uint32_t id_runs = 1u << 10;  // only with original_ids: blocks are divided into runs, see `ids`
inline constexpr std::uint32_t source_origin = 1u << 11;
inline constexpr std::uint32_t bounds = oriented_box | bounding_sphere | k_dop;
inline constexpr std::uint32_t known = original_ids | materials_8 | materials_16 | closed | split_references |
                                       edge_flags | bounds | deformable | id_runs | source_origin;
/// Sections that a deformable blob cannot have, because they describe a single pose.
inline constexpr std::uint32_t not_deformable = split_references | edge_flags | bounds;
}  // namespace feature

}  // namespace espalier::format
