// A general compressor on top: zlib, where it is installed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace espalier::bench {

/// Returns the bytes compressed at zlib's highest level, or nothing without zlib.
[[nodiscard]] std::optional<std::vector<std::byte>> deflate_bytes(std::span<const std::byte> bytes);
/// Returns the `size` bytes that were compressed. Throws std::runtime_error for damaged ones.
[[nodiscard]] std::vector<std::byte> inflate_bytes(std::span<const std::byte> compressed, std::size_t size);

}  // namespace espalier::bench
