// The bytes of a glTF file's buffers: its binary chunk, base64 text or files beside it.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Returns nothing unless the whole text is base64 of RFC 4648; '=' at its end may be missing.
std::optional<std::vector<std::byte>> decode_base64(std::string_view text);

struct GltfBufferView {
    std::span<const std::byte> bytes;
    std::size_t stride = 0;  ///< 0: elements follow each other without a gap
    std::size_t packed = 0;  ///< bytes of an element of EXT_meshopt_compression; 0: the view is not compressed
};

class GltfBufferViews {
public:
    GltfBufferViews(const GltfObject& root, GltfBuffers& buffers) : root_(root), buffers_(buffers) {}

    [[nodiscard]] std::size_t count() const { return root_.size_of("bufferViews"); }
    /// Returns bytes that live as long as this. Throws CommandError when the view is not inside of its buffer.
    GltfBufferView view(std::size_t number);

private:
    std::span<const std::byte> part_of_buffer(const GltfObject& part);

    const GltfObject& root_;
    GltfBuffers& buffers_;
    std::map<std::size_t, std::vector<std::byte>> decompressed_;
};

}  // namespace espalier::tools
