// In place of import/gltf/data/meshopt.cpp in a build whose ESPALIER_COMMAND_PARTS has no meshoptimizer.
#include <import/gltf/data/accessors.hpp>

namespace espalier::importer {

std::vector<std::byte> decode_meshopt(const GltfObject& extension, std::span<const std::byte>) {
    extension.refuse(
        "it is compressed by meshoptimizer, which this build does not read, because it has no meshoptimizer. Export it "
        "without compression, or use a build with meshoptimizer.");
}

}  // namespace espalier::importer
