// What the claims about the baker share.
#pragma once

#include "support/testing.hpp"

#include <initializer_list>

#include "oracle/surfaces.hpp"

namespace espalier::tests {

inline BakeResult bake_mesh(const Mesh& mesh, const BakeOptions& options = {}) {
    const MeshView view = mesh.view();
    return bake({&view, 1}, options);
}

inline BakeResult bake_meshes(std::initializer_list<const Mesh*> meshes, const BakeOptions& options = {}) {
    std::vector<MeshView> views;
    for (const Mesh* mesh : meshes) views.push_back(mesh->view());
    return bake(views, options);
}

/// The same, which must not be refused.
inline BakeResult must_bake_mesh(const Mesh& mesh, const BakeOptions& options = {}) {
    BakeResult result = bake_mesh(mesh, options);
    REQUIRE_MESSAGE(result, result.message);
    return result;
}
inline BakeResult must_bake_meshes(std::initializer_list<const Mesh*> meshes, const BakeOptions& options = {}) {
    BakeResult result = bake_meshes(meshes, options);
    REQUIRE_MESSAGE(result, result.message);
    return result;
}

/// Checks that a bake was refused with a message that has these parts.
inline void check_refused(const BakeResult& result, BakeStatus status, std::initializer_list<std::string> parts) {
    CHECK(!result);
    CHECK(result.status == status);
    CHECK(result.bytes.empty());
    CHECK(result.remap.empty());
    for (const std::string& part : parts) CHECK_MESSAGE(result.message.find(part) != std::string::npos, result.message);
}

inline void require_sound(std::span<const std::byte> blob) {
    const VerifyReport verified = verify(blob);
    REQUIRE_MESSAGE(verified, verified.message);
}

inline BakeOptions with_bits(unsigned bits) { return {.resolution = Resolution::bits(bits)}; }

inline BakeOptions with_tolerance(double tolerance) { return {.resolution = Resolution::tolerance(tolerance)}; }

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The first `count` triangles of the mesh.
inline Mesh first_triangles(Mesh mesh, std::size_t count) {
    mesh.triangles.resize(count);
    if (mesh.materials.size() > count) {
        mesh.materials.erase(mesh.materials.begin() + static_cast<std::ptrdiff_t>(count), mesh.materials.end());
    }
    return mesh;
}

/// Requires that the corners of a triangle are near those of its source, in their order from the first corner on.
inline void require_near_source(const DecodedBlob& decoded, std::size_t triangle, const Mesh& mesh,
                                std::uint32_t source, std::size_t first_corner) {
    const auto corners = reference::world_corners(decoded, decoded.triangles[triangle]);
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vec3& meant = mesh.positions[mesh.triangles[source][(first_corner + corner) % 3]];
        REQUIRE(std::abs(corners[corner].x - double(meant.x)) <= double(decoded.max_error));
        REQUIRE(std::abs(corners[corner].y - double(meant.y)) <= double(decoded.max_error));
        REQUIRE(std::abs(corners[corner].z - double(meant.z)) <= double(decoded.max_error));
    }
}

/// The same of each triangle of a blob with ids.
inline void require_corners_of_source(const DecodedBlob& decoded, const Mesh& mesh) {
    for (std::size_t i = 0; i < decoded.triangles.size(); ++i)
        require_near_source(decoded, i, mesh, decoded.original_ids[i], decoded.first_corners[i]);
}

}  // namespace espalier::tests
