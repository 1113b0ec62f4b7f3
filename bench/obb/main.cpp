// Oriented bounding boxes (OBB): how well and how fast each fit encloses triangles, and trees of them beside trees of
// axis-aligned boxes (AABB) for two meshes. One thread; one JSON object a line.
#include <stdexcept>
#include <string>
#include <utility>

#include "../../tests/support/meshes/files.hpp"
#include "../../tests/support/meshes/makers.hpp"
#include "../program.hpp"
#include "subject.hpp"

namespace espalier::bench {

ObbSubject make_obb_subject(Mesh mesh) {
    ObbSubject subject;
    bring_to_common_size(mesh);
    subject.mesh = std::move(mesh);
    subject.built = build_tree_and_blob(subject.mesh, 1);
    subject.blob = open(subject.built.blob);
    if (!subject.blob)
        throw std::runtime_error(subject.mesh.name + ": the blob does not open: " + describe(subject.blob.status()));
    return subject;
}

}  // namespace espalier::bench

int main(int count, char** words) {
    using namespace espalier;
    using namespace espalier::bench;
    ObbOptions options;
    bool is_without_trees = false;
    Program program("espalier_bench_obb",
                    "Oriented bounding boxes: fits, and trees of them beside trees of AABBs; JSON");
    program.allow_no_meshes();
    program.add_count("--set-triangles", options.set_triangles, "Triangles of all measured sets of one size together");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--parallel-poses", options.parallel_poses, "Poses in which the surfaces are parallel");
    program.add_number("--gap", options.gap, 1e-4, 1.0, "Gap between parallel surfaces, in radii of the mesh");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    program.add_flag("--fits-only", is_without_trees, "Measure no trees");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        const auto measure = [&](Mesh mesh) {
            const ObbSubject subject = make_obb_subject(std::move(mesh));
            measure_fits(subject, options);
            if (!is_without_trees) measure_trees(subject, options);
        };
        for (const std::string& file : meshes) measure(tests::read_mesh(file));
        if (meshes.empty()) measure(tests::make_torus(60, 30, 2.0, 0.5));
    });
}
