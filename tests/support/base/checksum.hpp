// CRC-32 written from its definition, bit by bit: a second opinion on the runtime's, and the means to repair a blob
// that a test has broken on purpose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::tests {

/// Of the whole blob with the checksum field taken as zero.
std::uint32_t blob_checksum(std::span<const std::byte> blob);

/// Writes the right checksum into the header. Blobs shorter than that field stay as they are.
void repair_checksum(std::span<std::byte> blob);

}  // namespace espalier::tests
