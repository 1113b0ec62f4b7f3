#include "gltf_buffer_views.hpp"

#include "gltf_meshopt.hpp"
#include "numbers.hpp"

namespace espalier::tools {

GltfBufferView GltfBufferViews::view(std::size_t number) {
    const GltfObject view = root_.object_in("bufferViews", number, text(root_.words(), ", bufferView ", number));
    const std::size_t stride = view.whole("byteStride").value_or(0);
    const auto compressed = view.extension("EXT_meshopt_compression");
    if (!compressed) return {part_of_buffer(view), stride};
    auto found = decompressed_.find(number);
    if (found == decompressed_.end()) {
        found = decompressed_.emplace(number, decode_meshopt(*compressed, part_of_buffer(*compressed))).first;
    }
    const std::uint64_t length = view.required_whole("byteLength");
    if (found->second.size() < length) {
        view.fail(text("it has ", found->second.size(), " bytes of the ", length, " that \"byteLength\" states"));
    }
    return {std::span<const std::byte>(found->second).first(length), stride};
}

std::span<const std::byte> GltfBufferViews::part_of_buffer(const GltfObject& part) {
    const std::size_t number = part.required_index("buffer", buffers_.count());
    const std::uint64_t offset = part.whole("byteOffset").value_or(0);
    const std::uint64_t length = part.required_whole("byteLength");
    const std::span<const std::byte> buffer = buffers_.bytes(number);
    if (offset > buffer.size() || length > buffer.size() - offset) {
        part.fail(text("its ", length, " bytes from byte ", offset, " on are not inside of the ", buffer.size(),
                       " bytes of buffer ", number));
    }
    return buffer.subspan(offset, length);
}

}  // namespace espalier::tools
