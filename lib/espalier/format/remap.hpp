// The remap file, which accompanies a blob: a header of 16 bytes, followed for each storage index by the members of an
// OriginalTriangle, which are u32 file, mesh, triangle and first corner.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/format/header.hpp>

namespace espalier::format::remap {

inline constexpr std::uint32_t magic = 0x52505345u;  // "ESPR"
inline constexpr std::uint32_t version = 1;
inline constexpr std::size_t magic_at = 0;
inline constexpr std::size_t version_at = 4;
inline constexpr std::size_t blob_checksum_at = 8;  // u32, the checksum of the blob to which the file belongs
inline constexpr std::size_t checksum_at = 12;      // u32, CRC-32 of the file with this field zero, as in a blob
static_assert(checksum_at == header::checksum_at);
inline constexpr std::size_t triangles_at = 16;
inline constexpr std::size_t triangle_bytes = 16;

}  // namespace espalier::format::remap
