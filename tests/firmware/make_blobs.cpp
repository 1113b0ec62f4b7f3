// make_blobs FOLDER: bakes what firmware is measured with, as MESH_PROFILE.espl: meshes that are made here, and bunny,
// fandisk and dragon where the folder ESPALIER_MESHES has them.
#include <cstdio>
#include <exception>
#include <fstream>
#include <span>
#include <string>

#include <espalier/bake.hpp>

#include "support/meshes/files.hpp"
#include "support/meshes/level_maker.hpp"
#include "support/meshes/makers.hpp"

namespace {

using espalier::Profile;
using namespace espalier::tests;

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
    const std::string path = folder + "/" + name + (profile == Profile::fast ? "_fast.espl" : "_small.espl");
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(baked.bytes.data()), static_cast<std::streamsize>(baked.bytes.size()));
    file.close();
    if (!file) {
        std::fprintf(stderr, "make_blobs: %s could not be written\n", path.c_str());
        return false;
    }
    std::printf("%s %u triangles %zu bytes\n", path.c_str(), baked.report.tree.triangles, baked.bytes.size());
    return true;
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
               bake_to(folder, torus, "torus", Profile::fast, 16);
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
