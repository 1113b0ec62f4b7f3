// make_blobs FOLDER: bakes what firmware is measured with, as MESH_PROFILE.espl: meshes that are made here, and bunny,
// fandisk and dragon where the folder ESPALIER_MESHES has them; a scene of 64 instances; and a cloth.
#include <cstdio>
#include <exception>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <espalier/scenes/bake.hpp>

#include "refit_workload.hpp"
#include "support/base/random.hpp"
#include "support/blobs/baking.hpp"
#include "support/meshes/files.hpp"
#include "support/meshes/level_maker.hpp"
#include "support/meshes/makers.hpp"

namespace {

using namespace espalier;
using namespace espalier::tests;

void write(const std::string& path, std::span<const std::byte> bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw std::runtime_error(path + " could not be written");
    std::printf("%s %zu bytes\n", path.c_str(), bytes.size());
}

BakeOptions options_of(Profile profile, unsigned bits) {
    return {.resolution = Resolution::bits(bits), .profile = profile};
}

/// A scene of 64 turned tori of two sizes, at the points of a grid.
std::vector<std::byte> bake_tori(Profile profile) {
    const std::vector<std::byte> torus = bake_or_throw(make_torus(48, 16, 3.0, 1.0), options_of(profile, 14));
    std::vector<Instance> instances(64);
    Random random(64);
    for (std::uint32_t i = 0; i < 64; ++i) {
        Transform& transform = instances[i].transform;
        transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.0f};
        const auto at = [](std::uint32_t place) { return 7.0f * static_cast<float>(place); };
        transform.translation = {at(i % 4), at(i / 4 % 4), at(i / 16)};
        transform.scale = i % 3 == 0 ? 0.5f : 0.75f;
    }
    const std::span<const std::byte> bytes = torus;
    SceneBakeResult scene = bake_scene(std::span(&bytes, 1), instances);
    if (!scene) throw std::runtime_error(scene.message);
    return scene.bytes;
}

/// A cloth that deforms, flat at rest.
std::vector<std::byte> bake_cloth() {
    using firmware::ClothPlaces;
    Mesh cloth = make_plane_grid(ClothPlaces::side);
    for (std::uint32_t i = 0; i < ClothPlaces::count; ++i) cloth.positions[i] = ClothPlaces::at(i, 0);
    BakeOptions options = {.profile = Profile::fast};
    options.deformation.emplace().range = ClothPlaces::range();
    return bake_or_throw(cloth, options);
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

void bake_all(const std::string& folder) {
    const auto write_to = [&](const char* name, Profile profile, std::span<const std::byte> bytes) {
        write(folder + "/" + name + (profile == Profile::fast ? "_fast.espl" : "_small.espl"), bytes);
    };
    const Mesh level = make_level(5000, 2026);
    for (const Profile profile : {Profile::fast, Profile::small}) {
        write_to("level", profile, bake_or_throw(level, options_of(profile, 14)));
        write_to("scene", profile, bake_tori(profile));
    }
    write_to("torus", Profile::fast, bake_or_throw(make_torus(64, 24, 3.0, 1.0), options_of(Profile::fast, 16)));
    write_to("cube", Profile::fast, bake_or_throw(make_cube(-0.5f, 0.5f), options_of(Profile::fast, 14)));
    write_to("cloth", Profile::fast, bake_cloth());
    for (const RealBlob& blob : real_blobs)
        if (const auto file = mesh_file(blob.file))
            write_to(blob.name, blob.profile, bake_or_throw(read_mesh(*file), options_of(blob.profile, blob.bits)));
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: make_blobs FOLDER\n", stderr);
        return 1;
    }
    try {
        bake_all(arguments[1]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_blobs: %s\n", error.what());
        return 2;
    }
}
