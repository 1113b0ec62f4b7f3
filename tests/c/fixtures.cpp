#include "fixtures.hpp"

#include <doctest/doctest.h>

#include <espalier/scenes/bake.hpp>

#include "support/base/profiles.hpp"
#include "support/base/random.hpp"
#include "support/meshes/makers.hpp"

namespace espalier::tests {

OpenedBlob blob_with_everything(Profile profile) {
    Mesh mesh = make_torus(12, 8, 2.0, 0.5);
    mesh.materials.resize(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) mesh.materials[i] = static_cast<std::uint32_t>(i * 77);
    return {mesh, with_every_section(profile)};
}

OpenedBlob blob_with_copies() {
    BakeOptions options = with_profile(Profile::fast);
    options.build.builder = Builder::spatial_splits;
    options.build.duplicate_budget = 1.0;
    return {make_soup(60, 1), options};
}

std::vector<Instance> some_instances() {
    Random random(11);
    std::vector<Instance> instances(40);
    for (Instance& instance : instances) {
        const Vec3 axis = random.in_cube(1.0f);
        instance.transform.rotation = {axis.x, axis.y, axis.z, random.signed_unit()};
        instance.transform.translation = random.in_cube(6.0f);
        instance.transform.scale = 0.5f + random.unit();
        instance.mesh = random.below(6);
        instance.mask = 1u << random.below(6);
        instance.user = static_cast<std::uint32_t>(random.next() & 0xFFFFFFFF);
    }
    for (std::size_t i = 0; i < 6; ++i) {  // on one lattice
        instances[i].transform = {};
        instances[i].transform.translation.x = static_cast<float>(i);
        instances[i].mesh = i < 3 ? 0 : 5;
    }
    return instances;
}

std::vector<std::byte> bake_instances(std::span<const Instance> instances) {
    std::vector<OpenedBlob> blobs;
    for (const Profile profile : every_profile) blobs.push_back(blob_with_everything(profile));
    blobs.push_back(blob_with_copies());
    std::vector<std::span<const std::byte>> bytes;
    for (const OpenedBlob& blob : blobs) bytes.emplace_back(blob.bytes);
    std::vector<Instance> in_tile(8);
    for (std::uint32_t i = 0; i < 8; ++i) {
        in_tile[i].mesh = i % 5;
        in_tile[i].mask = 1u << i % 3;
        in_tile[i].transform.translation = {0.0f, static_cast<float>(i), 0.0f};
    }
    in_tile[7].transform.rotation = {0.0f, 0.5f, 0.5f, 1.0f};
    const SceneBakeResult tile = bake_scene(bytes, in_tile);
    REQUIRE_MESSAGE(tile, tile.message);
    bytes.emplace_back(tile.bytes);
    const SceneBakeResult baked = bake_scene(bytes, instances);
    REQUIRE_MESSAGE(baked, baked.message);
    return baked.bytes;
}

}  // namespace espalier::tests
