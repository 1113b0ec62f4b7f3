#include "comparing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

#include "expecting.hpp"
#include "support/base/profiles.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests {

namespace {

void remember(std::uint32_t word, void* words) { static_cast<std::vector<std::uint32_t>*>(words)->push_back(word); }

using Ask = void (*)(asking*);
using Expect = void (Expecting::*)();

/// The same question from both sides.
void compare(const std::string& family, Ask ask, Expect expect, asking from_c, Expecting expecting) {
    CAPTURE(family);
    std::vector<std::uint32_t> told;
    from_c.tell = remember;
    from_c.log = &told;
    ask(&from_c);
    (expecting.*expect)();
    const std::vector<std::uint32_t>& expected = expecting.words();
    REQUIRE(told.size() == expected.size());
    const auto word = std::mismatch(told.begin(), told.end(), expected.begin()).first - told.begin();
    REQUIRE(static_cast<std::size_t>(word) == told.size());
}

}  // namespace

std::vector<espalier_vec3> in_c(std::span<const Vec3> positions) {
    std::vector<espalier_vec3> result;
    for (const Vec3& position : positions) result.push_back(c(position));
    return result;
}

question some_question(const Blob& blob, Random& random) {
    question result = {};
    for (espalier_vec3& point : result.points) point = c(some_point(blob, random));
    const Vec3 size = {blob.bounds().max.x - blob.bounds().min.x, blob.bounds().max.y - blob.bounds().min.y,
                       blob.bounds().max.z - blob.bounds().min.z};
    for (espalier_vec3& direction : result.directions) {
        const Vec3 unit = random.in_cube(1.0f);
        direction = random.below(6) == 0 ? c(some_point(blob, random))
                                         : espalier_vec3{unit.x * size.x, unit.y * size.y, unit.z * size.z};
    }
    for (float& length : result.lengths) length = some_length(blob, random);
    for (float& number : result.rotation)
        number = random.below(12) == 0 ? some_length(blob, random) : random.signed_unit();
    result.bits = static_cast<std::uint32_t>(random.next());
    return result;
}

question some_question(const BakedScene& scene, Random& random) {
    const InstanceId id = {random.below(scene.instance_count())};
    const Instance instance = *instance_at(scene, id);
    const Result<Blob> mesh = mesh_at(scene, id);
    question result = some_question(mesh ? *mesh : scene.tiles()[0].meshes()[0], random);
    for (espalier_vec3& point : result.points) point = c(to_world(instance.transform, cpp(point)));
    for (espalier_vec3& way : result.directions) way = c(direction_to_world(instance.transform, cpp(way)));
    for (float& length : result.lengths) length *= instance.transform.scale;
    return result;
}

void compare_all(const espalier_blob& c_blob, const espalier_blob& c_other, const Blob& blob, const Blob& other,
                 const question& asked) {
    const espalier_scene c_scene = {};
    const BakedScene scene;
    espalier_moving_scene c_moving = {};
    MovingScene moving;
    const auto both = [&](const std::string& family, Ask ask, Expect expect) {
        compare(family, ask, expect, {&c_blob, &c_other, &c_scene, &c_moving, &asked, nullptr, nullptr, 0, nullptr},
                {blob, other, scene, moving, asked});
    };
    both("lookups", ask_lookups, &Expecting::lookups);
    both("rays", ask_rays, &Expecting::rays);
    both("volumes", ask_volumes, &Expecting::volumes);
    both("points", ask_points, &Expecting::points);
    both("batches", ask_batches, &Expecting::batches);
    both("sweeps", ask_sweeps, &Expecting::sweeps);
    both("pairs", ask_pairs, &Expecting::pairs);
    both("transforms", ask_transforms, &Expecting::transforms);
    both("approximations", ask_approximations, &Expecting::approximations);
    both("walks", ask_walks, &Expecting::walks);
    both("steps", ask_steps, &Expecting::steps);
    both("nothing", ask_nothing, &Expecting::nothing);
}

void compare_scenes(const espalier_scene& c_scene, const BakedScene& scene, const question& asked) {
    const espalier_blob c_blob = {};
    const Blob blob;
    espalier_moving_scene c_moving = {};
    MovingScene moving;
    const auto both = [&](const std::string& family, Ask ask, Expect expect) {
        compare(family, ask, expect, {&c_blob, &c_blob, &c_scene, &c_moving, &asked, nullptr, nullptr, 0, nullptr},
                {blob, blob, scene, moving, asked});
    };
    both("scenes", ask_scenes, &Expecting::scenes);
    both("nothing of scenes", ask_nothing_of_scenes, &Expecting::nothing_of_scenes);
}

void compare_moving_scenes(espalier_moving_scene& c_moving, const espalier_scene& c_baked, MovingScene& moving,
                           const BakedScene& baked, const question& asked) {
    const espalier_blob c_blob = {};
    const Blob blob;
    const auto both = [&](const std::string& family, Ask ask, Expect expect) {
        compare(family, ask, expect, {&c_blob, &c_blob, &c_baked, &c_moving, &asked, nullptr, nullptr, 0, nullptr},
                {blob, blob, baked, moving, asked});
    };
    both("changes", ask_changes, &Expecting::changes);
    both("moving scenes", ask_moving_scenes, &Expecting::moving_scenes);
    both("scene pairs", ask_scene_pairs, &Expecting::scene_pairs);
}

void compare_refits(espalier_deformable& c_mesh, Deformable& mesh, std::span<const Vec3> positions,
                    const question& asked) {
    const espalier_blob* const c_blob = espalier_deformable_blob(&c_mesh);
    const espalier_scene c_scene = {};
    const BakedScene scene;
    espalier_moving_scene c_moving = {};
    MovingScene moving;
    const std::vector<espalier_vec3> c_positions = in_c(positions);
    const asked_refit refit = {&c_mesh, c_positions.data(), c_positions.size()};
    Expecting expecting(mesh.blob(), mesh.blob(), scene, moving, asked);
    compare("refits", ask_refits, &Expecting::refits,
            {c_blob, c_blob, &c_scene, &c_moving, &asked, nullptr, nullptr, 0, &refit},
            expecting.with(mesh, positions));
}

espalier_blob open_from_c(std::span<const std::byte> bytes) {
    espalier_blob blob;
    REQUIRE(espalier_open(bytes.data(), bytes.size(), &blob) == ESPALIER_OPEN_OK);
    return blob;
}

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

SceneOfBoth::SceneOfBoth(std::span<const std::byte> bytes)
    : c_meshes(espalier_scene_mesh_count(bytes.data(), bytes.size())),
      c_tiles(espalier_scene_tile_count(bytes.data(), bytes.size())),
      meshes(mesh_count_of_scene(bytes)),
      tiles(tile_count_of_scene(bytes)),
      c_status(espalier_open_scene(bytes.data(), bytes.size(), c_meshes.data(), c_meshes.size(), c_tiles.data(),
                                   c_tiles.size(), &c_scene)),
      scene(open_scene(bytes, meshes, tiles)) {}

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
