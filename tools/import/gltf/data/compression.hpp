// KHR_draco_mesh_compression and EXT_meshopt_compression. Only draco.cpp and meshopt.cpp include their libraries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "accessors.hpp"
#include "json.hpp"

namespace espalier::tools {

/// One decompressed primitive: triangles, and attributes by their Draco id.
class GltfDracoMesh {
public:
    virtual ~GltfDracoMesh() = default;

    /// Returns three vertex numbers for each triangle.
    [[nodiscard]] virtual GltfAccessor indices() const = 0;
    /// Returns the attribute's elements with the components and the normalisation of `described`.
    [[nodiscard]] virtual GltfAccessor attribute(const GltfObject& extension, std::uint64_t id,
                                                 const GltfAccessor& described) const = 0;
};

/// Returns what `compressed` holds; `extension` is the primitive's KHR_draco_mesh_compression. Throws CommandError when
/// the bytes are damaged, and (unsupported) in a build without Draco.
std::unique_ptr<const GltfDracoMesh> decode_draco(const GltfObject& extension, std::span<const std::byte> compressed);

/// Returns the bytes that `compressed` holds; `extension` describes them. Throws CommandError when they are
/// damaged, and (unsupported) in a build without meshoptimizer.
std::vector<std::byte> decode_meshopt(const GltfObject& extension, std::span<const std::byte> compressed);

}  // namespace espalier::tools
