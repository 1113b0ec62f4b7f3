// How hierarchies are traversed: two of them against each other by each rule of descent, and rays by each order of
// children, in a textbook tree. Espalier's own queries are in the same rows. One thread; one JSON object a line.
#include <stdexcept>
#include <string>
#include <utility>

#include "../../tests/support/meshes/files.hpp"
#include "../../tests/support/meshes/makers.hpp"
#include "../program.hpp"
#include "subject.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

void measure(Mesh mesh, const TraversalOptions& options) {
    Subject subject;
    bring_to_common_size(mesh);
    subject.mesh = std::move(mesh);
    subject.built = build_tree_and_blob(subject.mesh, options.leaf_triangles);
    subject.blob = open(subject.built.blob);
    if (!subject.blob)
        throw std::runtime_error(subject.mesh.name + ": the blob does not open: " + describe(subject.blob.status()));
    measure_pairs(subject, options);
    measure_rays(subject, options);
}

}  // namespace

int main(int count, char** words) {
    TraversalOptions options;
    Program program("espalier_bench_traversal",
                    "Rules of descent for two hierarchies, and orders of children for rays; JSON");
    program.allow_no_meshes();
    program.add_number("--leaf-size", options.leaf_triangles, 1u, 64u, "Triangles in a leaf, at most");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        for (const std::string& file : meshes) measure(tests::read_mesh(file), options);
        if (meshes.empty()) measure(tests::make_torus(60, 30, 2.0, 0.5), options);
    });
}
