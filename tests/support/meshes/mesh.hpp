// A mesh that owns its arrays, as the makers and the readers hand it out.
#pragma once

#include <string>
#include <vector>

#include <espalier/bake.hpp>

namespace espalier::tests {

struct Mesh {
    std::string name = {};
    std::vector<Vec3> positions = {};
    std::vector<TriangleVertices> triangles = {};
    std::vector<std::uint32_t> materials = {};

    [[nodiscard]] MeshView view() const {
        return {.positions = positions, .triangles = triangles, .materials = materials, .name = name};
    }
};

}  // namespace espalier::tests
