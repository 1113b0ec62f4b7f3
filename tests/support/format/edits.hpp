// Blobs that are broken on purpose, in one place, with the size and the checksum of a whole one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/format.hpp>

#include "support/base/checksum.hpp"

namespace espalier::tests {

inline void put(std::vector<std::byte>& bytes, std::size_t at, std::uint64_t value, unsigned size) {
    for (unsigned i = 0; i < size; ++i) bytes.at(at + i) = static_cast<std::byte>(value >> (8 * i));
}

inline std::uint64_t get(const std::vector<std::byte>& bytes, std::size_t at, unsigned size) {
    std::uint64_t value = 0;
    for (unsigned i = 0; i < size; ++i) value |= std::to_integer<std::uint64_t>(bytes.at(at + i)) << (8 * i);
    return value;
}

inline OpenStatus status_of(const std::vector<std::byte>& bytes) { return open(bytes).status(); }

/// The status after a change, with the checksum repaired.
inline OpenStatus status_with(std::vector<std::byte> bytes, std::size_t at, std::uint64_t value, unsigned size) {
    put(bytes, at, value, size);
    repair_checksum(bytes);
    return status_of(bytes);
}

/// The status after bytes were put in or taken out: the size that the header states is right again.
inline OpenStatus status_resized(std::vector<std::byte> bytes) {
    put(bytes, format::header::total_bytes_at, bytes.size(), 4);
    repair_checksum(bytes);
    return status_of(bytes);
}

}  // namespace espalier::tests
