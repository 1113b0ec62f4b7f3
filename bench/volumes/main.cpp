// Which bounding volume? The same binary tree with spheres, AABBs, OBBs and k-DOPs in its nodes: how tightly they fit,
// how many tests a query makes, and how long it takes. One thread; one JSON object a line.
#include <string>
#include <utility>

#include "../../tests/support/meshes/files.hpp"
#include "../../tests/support/meshes/makers.hpp"
#include "../program.hpp"
#include "measure.hpp"

int main(int count, char** words) {
    using namespace espalier;
    using namespace espalier::bench;
    VolumeOptions options;
    Program program("espalier_bench_volumes", "Kinds of bounding volume: fit, bytes, tests and time of queries; JSON");
    program.allow_no_meshes();
    program.add_number("--leaf-size", options.leaf_triangles, 1u, 64u, "Triangles in a leaf, at most");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--balls", options.balls, "Balls inside the mesh's box");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& file : meshes) measure_volumes(tests::read_mesh(file), options);
        if (meshes.empty()) measure_volumes(tests::make_torus(60, 30, 2.0, 0.5), options);
    });
}
