// How small can a tree be? Terdiman's ladder from the complete tree to the quantised one without leaf nodes, and trees
// of degree 2, 4, 8 and 16: bytes, work and time of rays and boxes, beside Espalier's own. One thread; one JSON object
// a line.
#include <string>
#include <vector>

#include "../../tests/support/meshes/files.hpp"
#include "../../tests/support/meshes/makers.hpp"
#include "../program.hpp"
#include "measure.hpp"

int main(int count, char** words) {
    using namespace espalier;
    using namespace espalier::bench;
    LadderOptions options;
    Program program("espalier_bench_ladder", "Layouts and degrees of trees: bytes, work and time of queries; JSON");
    program.allow_no_meshes();
    program.add_number("--leaf-size", options.leaf_triangles, 1u, 16u,
                       "Triangles in a leaf, at most, of trees that have several");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--boxes", options.boxes, "Boxes on the surface");
    program.add_count("--recounted", options.recounted, "Rays and boxes that are counted by a second counter");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& file : meshes) measure_ladder(tests::read_mesh(file), options);
        if (meshes.empty()) measure_ladder(tests::make_torus(60, 30, 2.0, 0.5), options);
    });
}
