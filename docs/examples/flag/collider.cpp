#include "collider.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace flag {

using namespace espalier;

namespace {

void require(QueryStatus status) {
    if (status != QueryStatus::ok) throw std::runtime_error(describe(status));
}

}  // namespace

Collider::Collider(std::span<const Vec3> rest, std::span<const TriangleVertices> triangles,
                   const std::vector<std::vector<Vec3>>& poses) {
    MeshView view;
    view.positions = rest;
    view.triangles = triangles;
    view.name = "flag";
    BakeOptions options;
    options.profile = Profile::fast;  // the only one whose leaves keep their size
    options.deformation = Deformation{.poses = poses};
    BakeResult baked = bake(std::span(&view, 1), options);
    if (!baked) throw std::runtime_error(baked.message);
    baked_ = std::move(baked.bytes);

    const Blob blob = open(baked_);
    memory_.resize(deformable_bytes(blob));
    mesh_ = create_deformable(blob, memory_);
    require(mesh_.status());
}

float Collider::move(std::span<const Vec3> positions) {
    const RefitResult result = refit(mesh_, positions);
    if (!result)
        throw std::runtime_error(std::string(describe(result.status)) + ": vertex " + std::to_string(result.position));
    return result.quality;
}

std::vector<std::byte> Collider::seal() const {
    std::vector<std::byte> bytes(baked_.size());
    require(espalier::seal(mesh_, bytes));
    return bytes;
}

}  // namespace flag
