// Trees of oriented boxes beside trees of axis-aligned ones: two meshes that are apart, that touch, or whose surfaces
// are parallel.
#include <cstdio>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <baker/bake_with.hpp>
#include <baker/build/build.hpp>
#include <baker/optimise/reinsertion.hpp>
#include <espalier/pair.hpp>

#include "../../tests/support/base/random.hpp"
#include "../deformation/processor_time.hpp"
#include "../deformation/spread.hpp"
#include "../guide/row.hpp"
#include "../pairs/poses.hpp"
#include "kinds.hpp"
#include "parallel_surface.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

constexpr std::uint64_t seed = 2026;

struct PoseClass {
    std::string name;
    const MeshTrees* second;
    std::vector<PairQuestion> questions;
    std::vector<Transform> poses;
};

/// Returns the seconds that the baker takes for the tree of build_tree_and_blob, without the blob.
double seconds_of_sah_build(const Mesh& mesh) {
    double seconds = 0.0;
    const auto make = [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        const ProcessorTime time;
        baker::BinaryTree binary = baker::optimise(baker::build(lattice_mesh, Builder::binned_sah, settings),
                                                   baker::optimise_settings(Effort::normal));
        seconds = time.seconds();
        return binary;
    };
    BakeOptions options;
    options.profile = Profile::fast;
    options.threads = 1;
    const MeshView view = mesh.view();
    if (const BakeResult baked = baker::bake_with(make, {&view, 1}, options); !baked)
        throw std::runtime_error(mesh.name + ": " + baked.message);
    return seconds;
}

/// Shakes the second mesh by less than a quarter of the gap.
std::vector<Transform> shaken(const Transform& pose, double gap, std::size_t count) {
    tests::Random random(seed);
    std::vector<Transform> poses(count, pose);
    for (Transform& each : poses) each.translation = random.in_cube(static_cast<float>(0.14 * gap));
    return poses;
}

std::vector<PoseClass> classes_of_poses(const ObbSubject& subject, const MeshTrees& trees, std::size_t count) {
    const auto touches = [&](const Transform& pose) {
        return overlaps(subject.blob, {subject.blob, pose}, WorkLimit::unlimited()).yes();
    };
    const std::vector questions = {PairQuestion::any, PairQuestion::all};
    std::vector<PoseClass> classes = {{"apart", &trees, questions, {}}, {"touching", &trees, questions, {}}};
    for (const Transform& pose : some_poses(subject.mesh, count, seed, touches))
        classes[touches(pose) ? 1 : 0].poses.push_back(pose);
    return classes;
}

/// What one kind of tree answered, and what it took.
struct Run {
    const TreeKind* kind;
    std::function<PairWork(const Transform&)> answer;
    PairWork total;
    std::vector<std::uint64_t> pairs;  ///< of each pose
    std::vector<double> nanoseconds;   ///< of a pose, in each round
};

void make_round(std::span<Run> runs, std::span<const Transform> poses) {
    for (Run& run : runs) {
        run.total = {};
        run.pairs.clear();
        const ProcessorTime time;
        for (const Transform& pose : poses) {
            const PairWork work = run.answer(pose);
            run.total.box_tests += work.box_tests;
            run.total.triangle_tests += work.triangle_tests;
            run.total.pairs += work.pairs;
            run.pairs.push_back(work.pairs);
        }
        run.nanoseconds.push_back(1e9 * time.seconds() / static_cast<double>(poses.size()));
    }
}

void print(const ObbSubject& subject, const PoseClass& poses, PairQuestion question, const Run& run) {
    const auto count = static_cast<double>(poses.poses.size());
    JsonObject row = guide_row("obb trees", subject.mesh.name, subject.built.tree.triangles.size());
    row.add("poses_are", poses.name);
    row.add("question", std::string(question == PairQuestion::any ? "any" : "all"));
    row.add("topology", std::string(run.kind->topology));
    row.add("boxes", std::string(run.kind->boxes));
    row.add("poses", poses.poses.size());
    row.add("pairs", static_cast<double>(run.total.pairs) / count, 2);
    row.add("box_tests", static_cast<double>(run.total.box_tests) / count, 1);
    row.add("triangle_tests", static_cast<double>(run.total.triangle_tests) / count, 1);
    add_spread(row, "ns", run.nanoseconds, 0);
    row.add("node_bytes", run.kind->node_bytes);
    row.print();
}

void measure(const ObbSubject& subject, const MeshTrees& first, const PoseClass& poses, std::size_t rounds) {
    if (poses.poses.empty())
        throw std::runtime_error(subject.mesh.name + ": no pose is " + poses.name + "; add poses with --poses");
    for (const PairQuestion question : poses.questions) {
        std::vector<Run> runs;
        for (const TreeKind& kind : all_tree_kinds())
            runs.push_back({&kind, kind.walk(first, *poses.second, question), {}, {}, {}});
        for (std::size_t round = 0; round < rounds; ++round) make_round(runs, poses.poses);
        for (const Run& run : runs)
            if (run.pairs != runs.front().pairs)
                throw std::runtime_error(subject.mesh.name + ": trees of " + run.kind->boxes + " on the topology " +
                                         run.kind->topology + " have other answers");
        for (const Run& run : runs) print(subject, poses, question, run);
    }
    std::fflush(stdout);
}

void print_build(const ObbSubject& subject, const char* topology, const char* boxes, double seconds) {
    JsonObject row = guide_row("obb builds", subject.mesh.name, subject.built.tree.triangles.size());
    row.add("topology", std::string(topology));
    row.add("boxes", std::string(boxes));
    row.add("build_ms", 1e3 * seconds, 3);
    row.print();
}

}  // namespace

void measure_trees(const ObbSubject& subject, const ObbOptions& options) {
    const double sah_seconds = seconds_of_sah_build(subject.mesh);
    BuildSeconds seconds;
    const MeshTrees trees(subject.built.tree, seconds);
    print_build(subject, "sah", "aabb", sah_seconds);
    print_build(subject, "sah", "obb", sah_seconds + seconds.fit);
    print_build(subject, "obb", "obb", seconds.obb_tree);
    for (const PoseClass& poses : classes_of_poses(subject, trees, options.poses))
        measure(subject, trees, poses, options.rounds);
    const double gap = options.gap * static_cast<double>(bounding_sphere(subject.mesh).radius);
    const ParallelSurface parallel = parallel_surface_of(subject.mesh, gap);
    const AabbTree second = build_tree_and_blob(parallel.mesh, 1).tree;
    const MeshTrees second_trees(second, seconds);
    const PoseClass poses = {
        "parallel", &second_trees, {PairQuestion::all}, shaken(parallel.pose, gap, options.parallel_poses)};
    measure(subject, trees, poses, options.rounds);
}

}  // namespace espalier::bench
