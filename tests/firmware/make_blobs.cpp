// make_blobs FOLDER: bakes what firmware is measured with, as MESH_PROFILE.espl: meshes that are made here, and bunny,
// fandisk and dragon where the folder ESPALIER_MESHES has them; a scene of 64 instances; and a cloth.
#include <cstdio>
#include <exception>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/scene.hpp>

#include "refit_workload.hpp"
#include "support/base/random.hpp"
#include "support/meshes/files.hpp"
#include "support/meshes/level_maker.hpp"
#include "support/meshes/makers.hpp"

namespace {

using espalier::Profile;
using namespace espalier::tests;

bool write(const std::string& folder, const std::string& name, Profile profile, const std::vector<std::byte>& bytes,
           std::uint64_t triangles) {
    const std::string path = folder + "/" + name + (profile == Profile::fast ? "_fast.espl" : "_small.espl");
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) {
        std::fprintf(stderr, "make_blobs: %s could not be written\n", path.c_str());
        return false;
    }
    std::printf("%s %llu triangles %zu bytes\n", path.c_str(), static_cast<unsigned long long>(triangles),
                bytes.size());
    return true;
}

bool bake_to(const std::string& folder, const Mesh& mesh, const std::string& name, Profile profile, unsigned bits) {
    espalier::BakeOptions options;
    options.profile = profile;
    options.resolution = espalier::Resolution::bits(bits);
    const espalier::MeshView view = mesh.view();
    const auto baked = espalier::bake(std::span(&view, 1), options);
    if (!baked) {
        std::fprintf(stderr, "make_blobs: %s: %s\n", name.c_str(), baked.message.c_str());
        return false;
    }
    return write(folder, name, profile, baked.bytes, baked.report.tree.triangles);
}

/// A scene of 64 turned tori of two sizes, at the points of a grid.
bool bake_scene_to(const std::string& folder, Profile profile) {
    const Mesh torus = make_torus(48, 16, 3.0, 1.0);
    espalier::BakeOptions options;
    options.profile = profile;
    options.resolution = espalier::Resolution::bits(14);
    const espalier::MeshView view = torus.view();
    const auto mesh = espalier::bake(std::span(&view, 1), options);
    std::vector<espalier::Instance> instances(64);
    Random random(64);
    for (std::uint32_t i = 0; i < 64; ++i) {
        espalier::Transform& transform = instances[i].transform;
        transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.0f};
        const auto at = [](std::uint32_t place) { return 7.0f * static_cast<float>(place); };
        transform.translation = {at(i % 4), at(i / 4 % 4), at(i / 16)};
        transform.scale = i % 3 == 0 ? 0.5f : 0.75f;
    }
    const std::span<const std::byte> bytes = mesh.bytes;
    const auto scene = espalier::bake_scene(std::span(&bytes, 1), instances);
    if (!scene) {
        std::fprintf(stderr, "make_blobs: scene: %s\n", scene.message.c_str());
        return false;
    }
    return write(folder, "scene", profile, scene.bytes, scene.report.triangles);
}

/// A cloth that deforms, flat at rest.
bool bake_cloth_to(const std::string& folder) {
    using espalier::firmware::ClothPlaces;
    Mesh cloth = make_plane_grid(ClothPlaces::side);
    for (std::uint32_t i = 0; i < ClothPlaces::count; ++i) cloth.positions[i] = ClothPlaces::at(i, 0);
    espalier::BakeOptions options;
    options.profile = Profile::fast;
    options.deformation.emplace().range = ClothPlaces::range();
    const espalier::MeshView view = cloth.view();
    const auto baked = espalier::bake(std::span(&view, 1), options);
    if (!baked) {
        std::fprintf(stderr, "make_blobs: cloth: %s\n", baked.message.c_str());
        return false;
    }
    return write(folder, "cloth", Profile::fast, baked.bytes, baked.report.tree.triangles);
}

struct RealBlob {
    const char* name;
    const char* file;
    Profile profile;
    unsigned bits;
};
/// bunny10: coarse enough for a core with 256 KB of flash.
constexpr RealBlob real_blobs[] = {{"bunny", "bunny.obj", Profile::fast, 16},
                                   {"bunny", "bunny.obj", Profile::small, 16},
                                   {"bunny10", "bunny.obj", Profile::small, 10},
                                   {"fandisk", "fandisk.obj", Profile::fast, 16},
                                   {"dragon", "dragon.ply", Profile::fast, 16}};

bool bake_all(const std::string& folder) {
    const Mesh level = make_level(5000, 2026);
    const Mesh torus = make_torus(64, 24, 3.0, 1.0);
    bool all = bake_to(folder, level, "level", Profile::fast, 14) &&
               bake_to(folder, level, "level", Profile::small, 14) &&
               bake_to(folder, torus, "torus", Profile::fast, 16) &&
               bake_to(folder, make_cube(-0.5f, 0.5f), "cube", Profile::fast, 14) &&
               bake_scene_to(folder, Profile::fast) && bake_scene_to(folder, Profile::small) && bake_cloth_to(folder);
    for (const RealBlob& blob : real_blobs)
        if (const auto file = mesh_file(blob.file); file && all)
            all = bake_to(folder, read_mesh(*file), blob.name, blob.profile, blob.bits);
    return all;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: make_blobs FOLDER\n", stderr);
        return 1;
    }
    try {
        return bake_all(arguments[1]) ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_blobs: %s\n", error.what());
        return 2;
    }
}
