#include "buffer_views.hpp"

#include "base/numbers.hpp"
#include "meshopt.hpp"

namespace espalier::tools {

GltfBufferView GltfBufferViews::view(std::size_t number) {
    const GltfObject view = root_.object_in("bufferViews", number, text(root_.words(), ", bufferView ", number));
    const std::size_t stride = view.whole("byteStride").value_or(0);
    const auto compressed = view.extension("EXT_meshopt_compression");
    if (!compressed) return {part_of_buffer(view), stride};
    const std::uint64_t packed = compressed->required_whole("byteStride");
    if (view.has("byteStride") && stride != packed) {
        view.fail(text("its byteStride is ", stride, ", and that of its EXT_meshopt_compression is ", packed));
    }
    auto found = decompressed_.find(number);
    if (found == decompressed_.end()) {
        found = decompressed_.emplace(number, decode_meshopt(*compressed, part_of_buffer(*compressed))).first;
    }
    const std::uint64_t length = view.required_whole("byteLength");
    if (found->second.size() != length) {
        view.fail(text("its \"byteLength\" is ", length, ", and its EXT_meshopt_compression has ", found->second.size(),
                       " bytes"));
    }
    return {found->second, stride, packed};
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
