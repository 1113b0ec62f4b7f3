// What queries cost on this machine: T = Nv Cv + Np Cp + Nu Cu + Co (Gottschalk, Lin, Manocha 1996; van den Bergen
// 1997), with the work counted and the costs fitted to measured times.
//
// Of a ray, Nv are the visited nodes and Np the tested triangles. Of two blobs, Nv are the visited pairs of boxes and
// Np the compared pairs of triangles. Nu, the boxes that are updated, is 0 for both: assets do not change, and a box is
// placed beside another where their pair is visited. Of a step of a moving scene, Nv are the tests of a box against a
// node, Np the pairs that are found and Nu the boxes of instances and nodes that are renewed.
#include <stdexcept>

#include "../program.hpp"
#include "blobs.hpp"
#include "options.hpp"

int main(int count, char** words) {
    using namespace espalier::bench;
    Options options;
    bool pairs = false, scene = false;
    Program program("espalier_bench_cost_model", "What queries cost on this machine, fitted to measured times");
    program.allow_no_meshes();
    program.add_flag("--pairs", pairs, "Two blobs of each mesh instead of rays: overlaps and distances");
    program.add_flag("--scene", scene, "A scene of moving cubes instead of rays; takes no meshes");
    program.add_flag("--json", options.json, "A JSON object for each row instead of text");
    program.add_choices("--profile", options.profiles, profile_names(), "Only this profile; may be repeated");
    program.add_number("--rays", options.rays, 1000u, 100'000'000u, "Incoherent rays");
    program.add_number("--poses", options.poses, 128u, 1'000'000u, "Poses of the second blob");
    program.add_number("--cubes", options.cubes, 1000u, 1'000'000u, "Cubes of the scene");
    program.add_count("--repetitions", options.repetitions, "How often each group of queries is made");
    program.add_number("--bits", options.bits, 1u, 24u, "Lattice bits");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        if (pairs && scene) throw std::invalid_argument("--pairs and --scene exclude each other");
        if (meshes.empty() != scene)
            throw std::invalid_argument(scene ? "--scene takes no meshes" : "meshes is required");
        if (scene) model_scene(options);
        else if (pairs) model_pairs(meshes, options);
        else model_rays(meshes, options);
    });
}
