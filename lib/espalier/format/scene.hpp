// A scene: a header, the sizes of its meshes and tiles, the meshes (ordinary blobs), the tiles (scenes without tiles),
// packed nodes, and a record for each instance. Meshes, tiles and nodes begin at multiples of 64 bytes, after padding
// with zeros. The leaf children of a node are instances; leaf_block is the index of the first, or 0 if there is none.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/format/header.hpp>

namespace espalier::format::scene {

inline constexpr std::uint32_t magic = 0x53505345u;  // "ESPS"
inline constexpr std::uint16_t version_major = 1;
inline constexpr std::uint16_t version_minor = 1;
inline constexpr std::uint16_t version_minor_of_source_origin = 1;
inline constexpr unsigned bits = max_bits;             ///< of the scene's lattice
inline constexpr std::uint32_t max_meshes = 1u << 24;  ///< of meshes and tiles together
inline constexpr std::uint32_t max_instances = 1u << 24;
inline constexpr std::size_t alignment = 64;

// The header. Fields that a blob has as well are at the same offsets.
inline constexpr std::size_t magic_at = header::magic_at;
inline constexpr std::size_t version_major_at = header::version_major_at;
inline constexpr std::size_t version_minor_at = header::version_minor_at;
inline constexpr std::size_t total_bytes_at = header::total_bytes_at;
inline constexpr std::size_t checksum_at = header::checksum_at;
inline constexpr std::size_t features_at = header::features_at;  // u32
inline constexpr std::uint32_t has_common_lattice = 1;  // a bit of features; without it the common_* fields are 0
inline constexpr std::uint32_t has_source_origin = 2;   // a bit of features; without it the origin is 0
inline constexpr std::size_t depth_at = 20;             // u8, followed by a zero byte
inline constexpr std::size_t step_exponent_at = header::step_exponent_at;  // i16
inline constexpr std::size_t mesh_count_at = 24;                           // u32
inline constexpr std::size_t instance_count_at = 28;                       // u32
inline constexpr std::size_t node_count_at = header::node_count_at;        // u32, 0 only without instances
inline constexpr std::size_t tile_count_at = 36;                           // u32, 0 in a tile
inline constexpr std::size_t origin_at = header::origin_at;                // 3 x f32; a multiple of the step
inline constexpr std::size_t extent_at = header::extent_at;                // 3 x u32, below 2^bits
inline constexpr std::size_t max_error_at = header::max_error_at;          // f32, in world units
inline constexpr std::size_t common_origin_at = 68;                        // 3 x f32; a multiple of the common step
inline constexpr std::size_t common_extent_at = 80;                        // 3 x u32, below 2^bits
inline constexpr std::size_t common_step_exponent_at = 92;                 // i16, followed by two zero bytes
inline constexpr std::size_t tile_mesh_count_at = 96;  // u32, the number of meshes in all tiles together
inline constexpr std::size_t zeros_at = 100;           // zeros up to the origin of the source
inline constexpr std::size_t source_origin_at = 104;   // 3 x f64, finite; extends to the end of the header
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

}  // namespace espalier::format::scene
