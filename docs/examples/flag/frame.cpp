#include "frame.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include <espalier/espalier.hpp>
#include <espalier/scenes/bake.hpp>

namespace flag {

using namespace espalier;

namespace {

/// A body of eight sides around the z axis, with two ends that are points.
std::vector<std::byte> bake_spindle(float bottom, float low, float high, float top, float radius) {
    constexpr float corner[8][2] = {{12, 5}, {5, 12}, {-5, 12}, {-12, 5}, {-12, -5}, {-5, -12}, {5, -12}, {12, -5}};
    std::vector<Vec3> positions = {{0, 0, bottom}, {0, 0, top}};
    for (const float z : {low, high})
        for (const auto& [x, y] : corner) positions.push_back({radius * x / 13, radius * y / 13, z});
    std::vector<TriangleVertices> triangles;
    for (std::uint32_t i = 0; i < 8; ++i) {
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % 8, c = b + 8, d = a + 8;
        for (const TriangleVertices& triangle : {TriangleVertices{0, b, a}, {a, b, c}, {a, c, d}, {d, c, 1}})
            triangles.push_back(triangle);
    }
    MeshView view;
    view.positions = positions;
    view.triangles = triangles;
    const BakeResult baked = bake(std::span(&view, 1));
    if (!baked) throw std::runtime_error(baked.message);
    return baked.bytes;
}

/// Returns the rotation that turns the z axis to a direction that does not point down exactly.
Quaternion turn_to(const Vector& direction) {
    const auto x = static_cast<float>(direction.x), y = static_cast<float>(direction.y),
               z = static_cast<float>(direction.z);
    return {-y, x, 0.0f, z + std::sqrt(x * x + y * y + z * z)};
}

}  // namespace

std::vector<std::byte> make_frame(std::span<const std::byte> cloth, std::span<const Drop> drops) {
    const std::vector<std::byte> pole = bake_spindle(-0.05f, 0.0f, 3.6f, 3.7f, 0.05f);
    const std::vector<std::byte> ground = bake_spindle(-0.2f, -0.1f, -0.08f, -0.05f, 1.9f);
    const std::vector<std::byte> drop = bake_spindle(-0.06f, -0.03f, -0.02f, 0.11f, 0.035f);
    const std::array<std::span<const std::byte>, 4> blobs = {cloth, pole, ground, drop};
    std::vector<Instance> instances;
    const auto add = [&](std::uint32_t mesh, const Transform& place) {
        Instance instance;
        instance.mesh = mesh;
        instance.transform = place;
        instances.push_back(instance);
    };
    add(0, {});
    add(1, {});
    add(2, {.rotation = {}, .translation = {1.4f, -0.3f, 0.0f}});
    // A drop points to where it came from.
    for (const Drop& falling : drops) {
        const Vector back = {-falling.velocity.x, -falling.velocity.y, -falling.velocity.z};
        add(3, {.rotation = turn_to(back), .translation = in_metres(falling.position)});
    }
    const SceneBakeResult scene = bake_scene(blobs, instances);
    if (!scene) throw std::runtime_error(scene.message);
    return scene.bytes;
}

}  // namespace flag
