// What a program that uses Jolt needs before anything else, and a mesh as Jolt's own shape.
#pragma once

#include <Jolt/Jolt.h>
#include <Jolt/Core/Factory.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/RegisterTypes.h>

#include <engines/jolt_shape.hpp>

#include "support/meshes/mesh.hpp"

namespace espalier::bench {

/// Registers Jolt's types and the adapter's, once.
inline void start_jolt() {
    static const bool started = [] {
        JPH::RegisterDefaultAllocator();
        JPH::Factory::sInstance = new JPH::Factory();
        JPH::RegisterTypes();
        EspalierJoltShape::register_type();
        return true;
    }();
    static_cast<void>(started);
}

/// Returns a mesh as Jolt has it.
inline JPH::Ref<JPH::Shape> jolt_mesh(const tests::Mesh& mesh) {
    JPH::VertexList vertices;
    JPH::IndexedTriangleList triangles;
    for (const Vec3& p : mesh.positions) vertices.push_back({p.x, p.y, p.z});
    for (const auto& t : mesh.triangles) triangles.push_back({t[0], t[1], t[2], 0});
    return JPH::MeshShapeSettings(std::move(vertices), std::move(triangles)).Create().Get();
}

}  // namespace espalier::bench
