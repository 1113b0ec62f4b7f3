// The bytes of a glTF file's buffers: its binary chunk, base64 text or files beside it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "container.hpp"
#include "json.hpp"

namespace espalier::tools {

/// Reads each buffer when it is first used. The container outlives it.
class GltfBuffers {
public:
    /// `opened` gets the files beside the glTF file that are read.
    GltfBuffers(const std::string& path, const GltfContainer& container, std::vector<std::string>& opened);

    [[nodiscard]] std::size_t count() const { return buffers_.size(); }
    /// Returns exactly the buffer's byteLength. Throws CommandError when it has fewer.
    std::span<const std::byte> bytes(std::size_t number);

private:
    [[nodiscard]] std::vector<std::byte> bytes_beside(const GltfObject& buffer, const std::string& uri,
                                                      std::uint64_t length);

    const std::string& path_;
    const GltfContainer& container_;
    std::vector<std::string>& opened_;
    GltfObject root_;
    std::vector<std::optional<std::vector<std::byte>>> buffers_;  ///< those that are no binary chunk, once read
};

}  // namespace espalier::tools
