#include <import/gltf/data/accessors.hpp>

#include <meshoptimizer.h>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

/// Attributes take at least one byte for 64 of theirs, which are then all like those before; indices take more.
constexpr std::uint64_t largest_ratio = 64;

/// The library asserts these.
bool fits(const std::string& mode, const std::string& filter, std::uint64_t count, std::uint64_t stride) {
    if (mode == "ATTRIBUTES") {
        if (stride == 0 || stride > 256 || stride % 4 != 0) return false;
        if (filter == "OCTAHEDRAL") return stride == 4 || stride == 8;
        if (filter == "QUATERNION") return stride == 8;
        return filter == "NONE" || filter == "EXPONENTIAL";
    }
    if (filter != "NONE" || (stride != 2 && stride != 4)) return false;
    return (mode == "TRIANGLES" && count % 3 == 0) || mode == "INDICES";
}

}  // namespace

std::vector<std::byte> decode_meshopt(const GltfObject& extension, std::span<const std::byte> compressed) {
    const std::uint64_t count = extension.required_whole("count");
    const std::uint64_t stride = extension.required_whole("byteStride");
    const std::string mode = extension.text_of("mode");
    const std::string filter = extension.has("filter") ? extension.text_of("filter") : "NONE";
    if (!fits(mode, filter, count, stride)) {
        extension.fail(text("mode ", printable(mode), ", filter ", printable(filter), ", byteStride ", stride,
                            " and count ", count, " do not go together"));
    }
    if (count > compressed.size() * largest_ratio / stride) {
        extension.fail(text("its ", compressed.size(), " bytes cannot hold ", count, " elements"));
    }
    std::vector<std::byte> result(count * stride);
    const auto* source = reinterpret_cast<const unsigned char*>(compressed.data());
    int error = 0;
    if (mode == "ATTRIBUTES") {
        error = meshopt_decodeVertexBuffer(result.data(), count, stride, source, compressed.size());
    } else if (mode == "TRIANGLES") {
        error = meshopt_decodeIndexBuffer(result.data(), count, stride, source, compressed.size());
    } else {
        error = meshopt_decodeIndexSequence(result.data(), count, stride, source, compressed.size());
    }
    if (error == -1) {
        extension.refuse(
            "it is packed by a version of meshoptimizer that is unknown here. Pack it with an earlier one, or without "
            "compression.");
    }
    if (error != 0) extension.fail("its compressed bytes are damaged");
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(result.data(), count, stride);
    if (filter == "QUATERNION") meshopt_decodeFilterQuat(result.data(), count, stride);
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(result.data(), count, stride);
    return result;
}

}  // namespace espalier::importer
