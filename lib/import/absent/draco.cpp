// In place of import/gltf/data/draco.cpp in a build whose ESPALIER_COMMAND_PARTS has no draco.
#include <import/gltf/data/accessors.hpp>

namespace espalier::importer {

std::unique_ptr<const GltfDracoMesh> decode_draco(const GltfObject& extension, std::span<const std::byte>) {
    extension.refuse(
        "it is compressed by Draco, which this build does not read, because it has no draco. Export it without "
        "compression, or use a build with draco.");
}

}  // namespace espalier::importer
