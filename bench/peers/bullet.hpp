// Meshes as Bullet takes them. Compiled where Bullet is installed.
#pragma once

#include <btBulletCollisionCommon.h>

#include "../base.hpp"

namespace espalier::bench {

/// Returns the arrays of a mesh, which Bullet reads in place.
inline btTriangleIndexVertexArray bullet_arrays(const Mesh& mesh) {
    static_assert(sizeof(btScalar) == sizeof(float));
    // Bullet takes pointers to mutable data and does not write through them.
    return {static_cast<int>(mesh.triangles.size()),
            reinterpret_cast<int*>(const_cast<TriangleVertices*>(mesh.triangles.data())),
            sizeof(TriangleVertices),
            static_cast<int>(mesh.positions.size()),
            reinterpret_cast<btScalar*>(const_cast<Vec3*>(mesh.positions.data())),
            sizeof(Vec3)};
}

/// Returns the bytes that queries read: the tree as Bullet's serialiser counts it, vertices and indices.
inline std::size_t bullet_bytes(const btBvhTriangleMeshShape& shape, const Mesh& mesh) {
    return const_cast<btBvhTriangleMeshShape&>(shape).getOptimizedBvh()->calculateSerializeBufferSize() +
           mesh.positions.size() * sizeof(Vec3) + mesh.triangles.size() * sizeof(TriangleVertices);
}

inline std::string bullet_version() {
    return std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100);
}

}  // namespace espalier::bench
