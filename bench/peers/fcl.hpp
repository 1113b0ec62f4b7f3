// Meshes as FCL takes them. Compiled where FCL is installed.
#pragma once

#include <fcl/config.h>
#include <fcl/math/bv/utility.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/AABB.h>
#include <fcl/math/bv/OBB.h>
#include <fcl/math/bv/OBBRSS.h>

#include "../base.hpp"

namespace espalier::bench {

template <class Scalar>
fcl::Vector3<Scalar> fcl_vector(const Vec3& p) {
    return {static_cast<Scalar>(p.x), static_cast<Scalar>(p.y), static_cast<Scalar>(p.z)};
}

template <class Scalar>
std::vector<fcl::Vector3<Scalar>> fcl_positions(std::span<const Vec3> positions) {
    std::vector<fcl::Vector3<Scalar>> made;
    for (const Vec3& p : positions) made.push_back(fcl_vector<Scalar>(p));
    return made;
}

/// Arrays of a mesh, and the model that FCL builds from them.
template <class Volume>
class FclArrays {
public:
    explicit FclArrays(const Mesh& mesh) : positions_(fcl_positions<typename Volume::S>(mesh.positions)) {
        for (const TriangleVertices& t : mesh.triangles) triangles_.emplace_back(t[0], t[1], t[2]);
    }
    void build(fcl::BVHModel<Volume>& model) const {
        model.beginModel(static_cast<int>(triangles_.size()), static_cast<int>(positions_.size()));
        model.addSubModel(positions_, triangles_);
        model.endModel();
    }

private:
    std::vector<fcl::Vector3<typename Volume::S>> positions_;
    std::vector<fcl::Triangle> triangles_;
};

/// Returns the bytes of the arrays that queries read: nodes, vertices and triangles.
template <class Volume>
std::size_t bytes_of(const fcl::BVHModel<Volume>& model) {
    return static_cast<std::size_t>(model.getNumBVs()) * sizeof(fcl::BVNode<Volume>) +
           static_cast<std::size_t>(model.num_vertices) * sizeof(fcl::Vector3<typename Volume::S>) +
           static_cast<std::size_t>(model.num_tris) * sizeof(fcl::Triangle);
}

}  // namespace espalier::bench
