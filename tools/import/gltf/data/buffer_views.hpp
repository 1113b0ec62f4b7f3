// The parts of buffers that accessors read, decompressed where EXT_meshopt_compression packs them.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "buffers.hpp"
#include "json.hpp"

namespace espalier::tools {

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
