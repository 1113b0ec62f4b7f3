// What exactness costs and what its lack costs: rays aimed at edges and vertices, which float kernels lose; the time of
// kernels in float, double and integers; bytes, error and time of lattices. A JSON object a line.
#include <cstdio>
#include <string>
#include <vector>

#include "../../tests/support/meshes/files.hpp"
#include "../../tests/support/meshes/makers.hpp"
#include "../program.hpp"
#include "options.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

Mesh named(const char* name, Mesh mesh) {
    mesh.name = name;
    return mesh;
}

/// Closed meshes, of triangles of nearly equal size, of slim ones around two poles, and with a hole.
std::vector<Mesh> closed_meshes() {
    return {named("sphere", tests::make_icosphere(5, 1.0, {0.3f, 0.2f, 0.1f})),
            named("sphere with poles", tests::make_uv_sphere(100, 100, 1.0, {0.3f, 0.2f, 0.1f})),
            named("torus", tests::make_torus(200, 50, 1.0, 0.3))};
}

/// At a size at which no system's absolute thresholds matter.
SnappedMesh prepare(Mesh mesh) {
    bring_to_common_size(mesh);
    return snap_mesh(mesh);
}

}  // namespace

int main(int count, char** words) {
    ExactnessOptions options;
    Program program("espalier_bench_exactness", "Rays lost between triangles, and what integers cost; JSON");
    program.allow_no_meshes();
    program.add_count("--aimed", options.aimed, "Rays at each kind of place");
    program.add_count("--rays", options.rays, "Rays of which times are measured");
    program.add_count("--rounds", options.rounds, "Rounds in which kernels and lattices take turns");
    program.add_number("--leaf", options.leaf_triangles, 1u, 64u, "Most triangles of a leaf of the textbook tree");
    return program.run(count, words, [&](const std::vector<std::string>& files) {
        for (const Mesh& mesh : closed_meshes()) print_leaks(prepare(mesh), options);
        for (const std::string& file : files) {
            const Mesh mesh = tests::read_mesh(file);
            const SnappedMesh snapped = prepare(mesh);
            std::fprintf(stderr, "%s\n", mesh.name.c_str());
            print_leaks(snapped, options);
            print_kernel_times(snapped, options);
            print_lattices(mesh, options);
        }
    });
}
