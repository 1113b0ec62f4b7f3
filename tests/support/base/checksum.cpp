#include "checksum.hpp"

#include <espalier/format.hpp>

namespace espalier::tests {

std::uint32_t blob_checksum(std::span<const std::byte> blob) {
    using format::header::checksum_at;
    std::uint32_t remainder = 0xFFFFFFFFu;
    for (std::size_t i = 0; i < blob.size(); ++i) {
        const bool in_field = i >= checksum_at && i < checksum_at + 4;
        remainder ^= in_field ? 0u : static_cast<std::uint32_t>(blob[i]);
        for (int bit = 0; bit < 8; ++bit)
            remainder = (remainder & 1u) != 0 ? remainder >> 1 ^ 0xEDB88320u : remainder >> 1;
    }
    return ~remainder;
}

void repair_checksum(std::span<std::byte> blob) {
    using format::header::checksum_at;
    if (blob.size() < checksum_at + 4) return;
    const std::uint32_t checksum = blob_checksum(blob);
    for (unsigned i = 0; i < 4; ++i) blob[checksum_at + i] = static_cast<std::byte>(checksum >> (8 * i));
}

}  // namespace espalier::tests
