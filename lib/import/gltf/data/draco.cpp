#include <import/gltf/data/accessors.hpp>

#include <draco/compression/decode.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

std::optional<GltfComponent> component_of(draco::DataType type) {
    if (type == draco::DT_INT8) return GltfComponent::signed_8;
    if (type == draco::DT_UINT8) return GltfComponent::unsigned_8;
    if (type == draco::DT_INT16) return GltfComponent::signed_16;
    if (type == draco::DT_UINT16) return GltfComponent::unsigned_16;
    if (type == draco::DT_UINT32) return GltfComponent::unsigned_32;
    if (type == draco::DT_FLOAT32) return GltfComponent::float_32;
    return std::nullopt;
}

void append_word(std::vector<std::byte>& bytes, std::uint32_t word) {
    for (unsigned shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(word >> shift & 0xffu));
}

GltfAccessor accessor_of(std::vector<std::byte> bytes, GltfComponent component, std::size_t components) {
    GltfAccessor result;
    result.owned = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    result.bytes = *result.owned;
    result.component = component;
    result.components = components;
    result.stride = components * bytes_of(component);
    result.count = result.bytes.size() / result.stride;
    return result;
}

class DecodedMesh : public GltfDracoMesh {
public:
    explicit DecodedMesh(std::unique_ptr<const draco::Mesh> mesh) : mesh_(std::move(mesh)) {}
    [[nodiscard]] GltfAccessor indices() const override;
    [[nodiscard]] GltfAccessor attribute(const GltfObject& extension, std::uint64_t id,
                                         const GltfAccessor& described) const override;

private:
    std::unique_ptr<const draco::Mesh> mesh_;
};

GltfAccessor DecodedMesh::indices() const {
    std::vector<std::byte> bytes;
    bytes.reserve(std::size_t{mesh_->num_faces()} * 12);
    for (draco::FaceIndex face(0); face < mesh_->num_faces(); ++face) {
        for (const draco::PointIndex& corner : mesh_->face(face)) append_word(bytes, corner.value());
    }
    return accessor_of(std::move(bytes), GltfComponent::unsigned_32, 1);
}

GltfAccessor DecodedMesh::attribute(const GltfObject& extension, std::uint64_t id,
                                    const GltfAccessor& described) const {
    const draco::PointAttribute* attribute =
        id <= 0xffffffffu ? mesh_->GetAttributeByUniqueId(static_cast<std::uint32_t>(id)) : nullptr;
    if (attribute == nullptr) extension.fail(text("its compressed bytes have no attribute ", id));
    const auto component = component_of(attribute->data_type());
    if (!component || attribute->num_components() != described.components) {
        extension.fail(text("attribute ", id, " of its compressed bytes has another type than the accessor"));
    }
    const std::size_t element = described.components * bytes_of(*component);
    const auto stride = static_cast<std::uint64_t>(attribute->byte_stride());
    const auto offset = static_cast<std::uint64_t>(attribute->byte_offset());
    const std::uint64_t stored = attribute->buffer()->data_size();
    const std::size_t points = mesh_->num_points();
    const bool is_mapped = attribute->is_mapping_identity() || attribute->indices_map_size() >= points;
    std::vector<std::byte> bytes(points * element);
    for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
        const std::uint64_t at = is_mapped ? offset + stride * attribute->mapped_index(point).value() : stored;
        if (at > stored || element > stored - at) {
            extension.fail(text("attribute ", id, " of its compressed bytes lacks vertex ", point.value()));
        }
        std::memcpy(bytes.data() + point.value() * element, attribute->buffer()->data() + at, element);
    }
    // Draco keeps numbers in the machine's order of bytes, accessors have glTF's.
    if constexpr (std::endian::native == std::endian::big) {
        const std::size_t size = bytes_of(*component);
        for (std::size_t i = 0; i < bytes.size(); i += size) std::reverse(bytes.begin() + i, bytes.begin() + i + size);
    }
    GltfAccessor result = accessor_of(std::move(bytes), *component, described.components);
    result.normalised = described.normalised;
    return result;
}

}  // namespace

std::unique_ptr<const GltfDracoMesh> decode_draco(const GltfObject& extension, std::span<const std::byte> compressed) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(compressed.data()), compressed.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) {
        extension.fail(text("its compressed bytes are damaged (", printable(decoded.status().error_msg_string()), ")"));
    }
    return std::make_unique<const DecodedMesh>(std::move(decoded).value());
}

}  // namespace espalier::importer
