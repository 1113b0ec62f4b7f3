// A deformable mesh of C and one of C++, which get the same calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>

#include "c/comparing.hpp"
#include "support/blobs/baking.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests {

/// A blob whose moving part C and C++ copied, each to memory of its own at an address that is no multiple of 2.
class DeformableOfBoth {
public:
    explicit DeformableOfBoth(std::span<const std::byte> bytes)
        : c_blob(), blob(open(bytes)), memory_(deformable_bytes(blob) + 1), c_memory_(memory_.size()) {
        c_open_status = espalier_open(bytes.data(), bytes.size(), &c_blob);
        mesh = create_deformable(blob, std::span(memory_).subspan(1));
        c_status = espalier_create_deformable(&c_blob, c_memory_.data() + 1, c_memory_.size() - 1, &c_mesh);
    }
    DeformableOfBoth(const DeformableOfBoth&) = delete;
    DeformableOfBoth& operator=(const DeformableOfBoth&) = delete;
    ~DeformableOfBoth() = default;

    [[nodiscard]] bool are_memories_equal() const { return memory_ == c_memory_; }
    /// Returns the blob that C seals, or nothing if it differs from the one of C++.
    [[nodiscard]] std::vector<std::byte> sealed() const {
        std::vector<std::byte> bytes(blob.size()), c_bytes(blob.size());
        if (seal(mesh, bytes) != QueryStatus::ok) return {};
        if (espalier_deformable_seal(&c_mesh, c_bytes.data(), c_bytes.size()) != ESPALIER_QUERY_OK) return {};
        return bytes == c_bytes ? c_bytes : std::vector<std::byte>();
    }

    espalier_blob c_blob;
    Blob blob;
    Deformable mesh;
    espalier_deformable c_mesh;
    espalier_open_status c_open_status;
    espalier_query_status c_status;

private:
    std::vector<std::byte> memory_, c_memory_;
};

/// Returns the positions of a mesh, twice as far from 0 along x.
inline std::vector<Vec3> stretched(const Mesh& mesh) {
    std::vector<Vec3> pose = mesh.positions;
    for (Vec3& position : pose) position.x *= 2.0f;
    return pose;
}

/// A mesh with materials, its deformable blob, and poses that are in its range.
struct MeshInPoses {
    MeshInPoses(Mesh source, unsigned bits) : mesh(std::move(source)), poses(every_pose(mesh)) {
        poses.push_back(stretched(mesh));
        mesh.materials.resize(mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.materials.size(); ++i) mesh.materials[i] = static_cast<std::uint32_t>(i * 77);
        BakeOptions options;
        options.profile = Profile::fast;
        options.resolution = Resolution::bits(bits);
        options.deformation.emplace();
        options.deformation->range = box_around(poses);
        bytes = bake_or_throw(mesh, options);
        poses.push_back(mesh.positions);
    }

    Mesh mesh;
    std::vector<std::vector<Vec3>> poses;  ///< the last one is that of the bake
    std::vector<std::byte> bytes;
};

}  // namespace espalier::tests
