#include "deformed_mesh.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <espalier/advanced/lattice.hpp>

#include "support/base/vectors.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests {

BakeOptions deformable_options(const Mesh& mesh, unsigned bits) {
    BakeOptions options = {.resolution = Resolution::bits(bits), .profile = Profile::fast};
    options.deformation.emplace();
    // Noise of another seed goes a little farther.
    const Box box = box_around(every_pose(mesh));
    const float by = 0.2f * longest_side(box);
    options.deformation->range =
        Box{{box.min.x - by, box.min.y - by, box.min.z - by}, {box.max.x + by, box.max.y + by, box.max.z + by}};
    return options;
}

DeformedMesh::DeformedMesh(Mesh source, unsigned bits) : DeformedMesh(source, deformable_options(source, bits)) {}

DeformedMesh::DeformedMesh(Mesh source, const BakeOptions& options) : mesh(std::move(source)) {
    const MeshView view = mesh.view();
    BakeResult result = bake(std::span(&view, 1), options);
    if (!result) throw std::runtime_error("bake of " + mesh.name + ": " + result.message);
    baked = std::move(result.bytes);
    remap = std::move(result.remap);
    report = std::move(result.report);
    still = open(baked);
    if (!still) throw std::runtime_error(std::string("open: ") + describe(still.status()));
    memory.resize(deformable_bytes(still));
    deformable = create_deformable(still, memory);
    if (!deformable) throw std::runtime_error(std::string("create_deformable: ") + describe(deformable.status()));
}

float DeformedMesh::move_to(std::span<const Vec3> positions) {
    const RefitResult result = refit(deformable, positions);
    if (!result)
        throw std::runtime_error("refit of " + mesh.name + ", position " + std::to_string(result.position) + ": " +
                                 describe(result.status));
    return result.quality;
}

std::vector<std::byte> DeformedMesh::sealed() const {
    std::vector<std::byte> bytes(baked.size());
    if (seal(deformable, bytes) != QueryStatus::ok) throw std::runtime_error("seal");
    return bytes;
}

std::vector<GridTriangle> DeformedMesh::expected_triangles(std::span<const Vec3> positions) const {
    const Lattice lattice = still.lattice();
    const auto rounded = [&](float position, float origin) {
        const double steps = std::nearbyint(std::ldexp(double(position), -lattice.step_exponent));
        return static_cast<std::int32_t>(steps - std::ldexp(double(origin), -lattice.step_exponent));
    };
    const auto corner = [&](const OriginalTriangle& source, unsigned number) -> GridPoint {
        const std::uint32_t vertex = mesh.triangles[source.triangle][(source.first_corner + number) % 3];
        const Vec3& p = positions[vertex];
        return {rounded(p.x, lattice.origin.x), rounded(p.y, lattice.origin.y), rounded(p.z, lattice.origin.z)};
    };
    std::vector<GridTriangle> triangles;
    for (const OriginalTriangle& source : remap)
        triangles.push_back({corner(source, 0), corner(source, 1), corner(source, 2)});
    return triangles;
}

}  // namespace espalier::tests
