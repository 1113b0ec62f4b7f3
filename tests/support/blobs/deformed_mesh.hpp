// A deformable mesh with all that it needs, and what its triangles must be in a pose.
#pragma once

#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/deformation.hpp>

#include "support/format/decoder.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::tests {

/// Returns options for a deformable blob of so many bits, whose range holds every pose of motions.hpp.
BakeOptions deformable_options(const Mesh& mesh, unsigned bits = 16);

/// A mesh, its deformable blob, and the memory of the part that moves.
class DeformedMesh {
public:
    /// Throws std::runtime_error if the baker or the runtime refuses.
    DeformedMesh(Mesh source, const BakeOptions& options);
    explicit DeformedMesh(Mesh source, unsigned bits = 16);
    DeformedMesh(const DeformedMesh&) = delete;
    DeformedMesh& operator=(const DeformedMesh&) = delete;
    ~DeformedMesh() = default;

    /// Refits. Throws std::runtime_error if that is refused.
    float move_to(std::span<const Vec3> positions);

    /// Returns the mesh in its pose as a whole blob.
    [[nodiscard]] std::vector<std::byte> sealed() const;
    /// Decodes that blob.
    [[nodiscard]] DecodedBlob decoded() const { return decode(sealed()); }
    /// Returns the triangles in storage order with their corners rounded to the lattice, from the positions alone.
    [[nodiscard]] std::vector<GridTriangle> expected_triangles(std::span<const Vec3> positions) const;

    Mesh mesh;
    std::vector<std::byte> baked;
    std::vector<OriginalTriangle> remap;
    BakeReport report;
    Blob still;  ///< the blob as it was baked
    std::vector<std::byte> memory;
    Deformable deformable;
};

}  // namespace espalier::tests
