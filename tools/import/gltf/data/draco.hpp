// KHR_draco_mesh_compression. Only draco.cpp includes Draco.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "accessors.hpp"
#include "json.hpp"

namespace draco {
class Mesh;
}

namespace espalier::tools {

/// One decompressed primitive: triangles, and attributes by their Draco id.
class GltfDracoMesh {
public:
    /// `extension` is the primitive's KHR_draco_mesh_compression. Throws CommandError when the bytes are damaged.
    GltfDracoMesh(const GltfObject& extension, std::span<const std::byte> compressed);

    /// Returns three vertex numbers for each triangle.
    [[nodiscard]] GltfAccessor indices() const;
    /// Returns the attribute's elements with the components and the normalisation of `described`.
    [[nodiscard]] GltfAccessor attribute(const GltfObject& extension, std::uint64_t id,
                                         const GltfAccessor& described) const;

private:
    std::shared_ptr<const draco::Mesh> mesh_;
};

}  // namespace espalier::tools
