// The arrays of a mesh from C: any stride and address, two types of coordinates and of indices.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/c/bake.h>

#include <baker/c/failure.hpp>

namespace espalier::baker {

/// Meshes as bake() takes them, with the arrays that they refer to.
class MeshArrays {
public:
    /// Copies all meshes.
    std::optional<Failure> read(const void* meshes, std::size_t count);

    [[nodiscard]] std::span<const MeshView> views() const { return views_; }
    /// Returns how many positions all meshes have.
    [[nodiscard]] std::size_t position_count() const;

private:
    struct Arrays {
        std::vector<Vec3> positions;
        std::vector<Vec3d> float64_positions;
        std::vector<TriangleVertices> triangles;
        std::vector<std::uint32_t> materials;
    };

    std::optional<Failure> check(std::span<const espalier_mesh_view> meshes) const;
    static void copy(const espalier_mesh_view& mesh, Arrays& arrays);

    std::vector<Arrays> arrays_;
    std::vector<MeshView> views_;
};

/// Returns the defaults of a mesh, without its size.
[[nodiscard]] espalier_mesh_view default_mesh_view();

/// Copies vectors of three packed float32.
[[nodiscard]] std::vector<Vec3> copy_vectors(const void* from, std::size_t count);

}  // namespace espalier::baker
