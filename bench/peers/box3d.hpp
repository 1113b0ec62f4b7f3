// Meshes as Box3D takes them. Compiled where there is a checkout of it.
#pragma once

#include <box3d/box3d.h>
#include <box3d/collision.h>

#include "../base.hpp"

namespace espalier::bench {

inline b3Vec3 to_box3d(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Its own copy of the vertices and triangles of a mesh, and the tree over them.
class Box3dMesh {
public:
    explicit Box3dMesh(const Mesh& mesh) {
        std::vector<b3Vec3> vertices;
        std::vector<std::int32_t> corners;
        for (const Vec3& p : mesh.positions) vertices.push_back(to_box3d(p));
        for (const TriangleVertices& t : mesh.triangles)
            for (const std::uint32_t corner : t) corners.push_back(static_cast<std::int32_t>(corner));
        b3MeshDef definition = {};
        definition.vertices = vertices.data();
        definition.vertexCount = static_cast<int>(vertices.size());
        definition.indices = corners.data();
        definition.triangleCount = static_cast<int>(mesh.triangles.size());
        const Stopwatch watch;
        data_ = b3CreateMesh(&definition, nullptr, 0);
        seconds_ = watch.seconds();
        if (data_ == nullptr) throw std::runtime_error(mesh.name + ": Box3D does not take it");
    }
    ~Box3dMesh() { b3DestroyMesh(data_); }
    Box3dMesh(const Box3dMesh&) = delete;
    Box3dMesh& operator=(const Box3dMesh&) = delete;

    [[nodiscard]] b3Mesh get() const { return {data_, {1.0f, 1.0f, 1.0f}}; }
    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(data_->byteCount); }
    [[nodiscard]] double build_seconds() const { return seconds_; }

private:
    b3MeshData* data_ = nullptr;
    double seconds_ = 0.0;
};

}  // namespace espalier::bench
