#include "world.hpp"

#include <espalier/espalier.hpp>
#include <espalier/scenes/bake.hpp>

#include "judge.hpp"
#include "support/base/random.hpp"
#include "support/meshes/makers.hpp"

namespace espalier::fuzz {

namespace {

using namespace tests;

std::vector<Instance> any_instances(std::size_t count, float place, std::uint32_t kinds) {
    Random random(count);
    std::vector<Instance> instances(count);
    for (Instance& instance : instances) {
        instance.transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.0f};
        instance.transform.translation = random.in_cube(place);
        instance.transform.scale = 0.5f + random.unit();
        instance.mesh = random.below(kinds);
        instance.mask = 1u << random.below(4) | 1u << random.below(4);
    }
    return instances;
}

void add_vertices(const Blob& mesh, const Transform& transform, std::vector<Vec3>& vertices) {
    (void)for_each_triangle(mesh, [&](TriangleId, const Triangle& corners) {
        for (const Vec3& corner : {corners.a, corners.b, corners.c}) vertices.push_back(to_world(transform, corner));
    });
}

}  // namespace

World::World() {
    BakeOptions small;
    small.profile = Profile::small;
    opened_.emplace_back(make_cube(-0.5f, 0.5f));
    opened_.emplace_back(make_torus(6, 4, 0.6, 0.25), small);
    opened_.emplace_back(make_cube(0.25f, 0.75f));
    opened_.emplace_back(Mesh{});
    for (const OpenedBlob& blob : opened_) meshes_.push_back(blob.blob);
    scenes_.reserve(3);  // views of scenes refer to their arrays
    add_tile(any_instances(3, 1.0f, 3));
    add_tile({});
    std::vector<Instance> with_tile = any_instances(10, 3.0f, 3);
    with_tile[2].mesh = with_tile[6].mesh = static_cast<std::uint32_t>(meshes_.size());
    add_tile(with_tile);
    for (const Blob& mesh : meshes_) add_vertices(mesh, {}, vertices_.emplace_back());
    std::vector<Vec3>& of_tile = vertices_.emplace_back();
    for (std::uint32_t i = 0; i < tiles_[0].instance_count(); ++i)
        add_vertices(*mesh_at(tiles_[0], {i}), instance_at(tiles_[0], {i})->transform, of_tile);
}

void World::add_tile(const std::vector<Instance>& instances) {
    std::vector<std::span<const std::byte>> parts;
    for (const OpenedBlob& blob : opened_) parts.emplace_back(blob.bytes);
    if (!scenes_.empty()) parts.emplace_back(scenes_[0].bytes);
    SceneBakeResult baked = bake_scene(parts, instances);
    if (!baked) fail("world", baked.message);
    Scene& scene = scenes_.emplace_back();
    scene.bytes = std::move(baked.bytes);
    scene.meshes.resize(mesh_count_of_scene(scene.bytes));
    scene.tiles.resize(tile_count_of_scene(scene.bytes));
    tiles_.push_back(open_scene(scene.bytes, scene.meshes, scene.tiles));
    if (!tiles_.back()) fail("world", describe(tiles_.back().status()));
}

bool World::is_placeable(std::uint32_t mesh) const { return mesh < 3 || mesh == meshes_.size(); }

Box World::bounds_of(std::uint32_t mesh) const {
    return mesh < meshes_.size() ? meshes_[mesh].bounds() : tiles_[mesh - meshes_.size()].bounds();
}

const World& world() {
    static const World all;
    return all;
}

}  // namespace espalier::fuzz
