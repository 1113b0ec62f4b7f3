// Which bounding volume? The same binary tree with spheres, AABBs, OBBs and k-DOPs in its nodes: how tightly they fit,
// how many tests a query makes, and how long it takes. One thread; one JSON object a line.

#include <espalier/format/nodes.hpp>

#include "../study/study.hpp"
#include "trees.hpp"

namespace espalier::bench {
namespace {

struct VolumeOptions {
    unsigned leaf_triangles = 8;
    std::size_t rays = 10'000;
    std::size_t balls = 5'000;
    std::size_t poses = 60;
    std::size_t rounds = 5;
};

struct Queries {
    std::vector<Ray> rays;
    std::vector<Ball> balls;
    std::vector<Transform> poses;
};

/// A mesh, the tree whose topology all kinds share, and what is asked.
struct Subject {
    Mesh mesh;  ///< at the common size
    AabbTree topology;
    BakedBlob baked;  ///< of the default profile
    Queries queries;
};

/// Balls around points in the mesh's box, with a radius of 2 % of its diagonal.
std::vector<Ball> some_balls(const AabbTree& topology, std::size_t count) {
    const AabbNode& root = topology.nodes.front();
    const Point center = {double(root.center[0]), double(root.center[1]), double(root.center[2])};
    const Point half = {double(root.half[0]), double(root.half[1]), double(root.half[2])};
    const double radius = 0.02 * 2.0 * std::sqrt(dot(half, half));
    tests::Random random(seed);
    std::vector<Ball> balls(count);
    for (Ball& ball : balls) {
        const double x = double(random.signed_unit()), y = double(random.signed_unit()),
                     z = double(random.signed_unit());
        ball = {center + Point{half.x * x, half.y * y, half.z * z}, radius};
    }
    return balls;
}

Subject make_subject(Mesh mesh, const VolumeOptions& options) {
    Subject subject;
    bring_to_common_size(mesh);
    subject.mesh = std::move(mesh);
    subject.topology = build_tree_and_blob(subject.mesh, options.leaf_triangles).tree;
    subject.baked = bake_blob(subject.mesh);
    const Blob& blob = subject.baked.blob;
    subject.queries.rays = incoherent_rays(subject.mesh, options.rays, seed);
    subject.queries.balls = some_balls(subject.topology, options.balls);
    subject.queries.poses = some_poses(subject.mesh, options.poses, seed, [&](const Transform& pose) {
        return overlaps(blob, {blob, pose}, unlimited).yes();
    });
    return subject;
}

template <class Answer>
void add_to(JsonObject& row, const std::string& name, const Timed<Answer, RayWork>& timed) {
    row.add(name + "_volume_tests", timed.mean(timed.work.box_tests), 2);
    row.add(name + "_triangle_tests", timed.mean(timed.work.triangle_tests), 2);
    add_spread(row, name + "_ns", timed.nanoseconds, 1);
}

struct KindRuns {
    Timed<double, RayWork> rays;
    Timed<std::uint64_t, RayWork> balls;
    Timed<std::uint64_t, RayWork> poses;
    std::vector<double> ray_test;  ///< nanoseconds of a test, in each round
    std::vector<double> pair_test;
};

/// The tests that the tree of boxes makes for some of the queries, which all kinds repeat.
struct RecordedTests {
    std::vector<RayTests> rays;
    std::vector<PairTests> poses;
};

RecordedTests record(const Queries& queries, KindOfTree& tree) {
    constexpr std::size_t ray_count = 100, pose_count = 10, tests_of_pose = 512;
    RecordedTests recorded;
    for (std::size_t i = 0; i < std::min(ray_count, queries.rays.size()); ++i)
        recorded.rays.push_back(tree.tests_of(queries.rays[i]));
    for (std::size_t i = 0; i < std::min(pose_count, queries.poses.size()); ++i) {
        PairTests tests = tree.tests_of(Placement(queries.poses[i]));
        // Groups of four tests, as the walk makes them behind the one of the roots, from all levels of the trees.
        const std::size_t step = 4 * (tests.nodes.size() / tests_of_pose + 1);
        std::vector<std::array<std::uint32_t, 2>> kept;
        for (std::size_t first = 1; first < tests.nodes.size(); first += step)
            for (std::size_t k = first; k < std::min(first + 4, tests.nodes.size()); ++k)
                kept.push_back(tests.nodes[k]);
        tests.nodes = std::move(kept);
        recorded.poses.push_back(std::move(tests));
    }
    return recorded;
}

void make_round(const Queries& queries, const RecordedTests& recorded, KindOfTree& tree, KindRuns& runs) {
    constexpr unsigned repetitions = 50;
    runs.rays.make_round(queries.rays, [&](const Ray& ray, RayWork& work) { return tree.closest(ray, work); });
    runs.balls.make_round(queries.balls, [&](const Ball& ball, RayWork& work) { return tree.touching(ball, work); });
    runs.poses.make_round(queries.poses,
                          [&](const Transform& pose, RayWork& work) { return tree.touching(Placement(pose), work); });
    runs.ray_test.push_back(tree.time_of(recorded.rays, repetitions));
    runs.pair_test.push_back(tree.time_of(recorded.poses, repetitions));
}

/// Espalier's own tree and tests; its exact decisions may differ from those in double where triangles just touch.
void make_own_round(const Subject& subject, KindRuns& runs) {
    const Blob& blob = subject.baked.blob;
    runs.rays.make_round(subject.queries.rays, [&](const Ray& ray, RayWork&) { return double(raycast(blob, ray).t); });
    runs.poses.make_round(subject.queries.poses,
                          [&](const Transform& pose, RayWork&) { return count_contacts(blob, pose); });
}

/// Adds up the areas and volumes of all nodes, for each kind.
std::vector<Extent> sums_of_extents(std::span<const Volumes> volumes) {
    std::vector<Extent> sums(all_kinds.size());
    for (const Volumes& of_node : volumes)
        for (std::size_t k = 0; k < all_kinds.size(); ++k) {
            const Extent extent = extent_of(all_kinds[k], of_node);
            sums[k].area += extent.area;
            sums[k].volume += extent.volume;
        }
    return sums;
}

JsonObject row_of(const Subject& subject, const std::string& kind, std::size_t volume_bytes, const KindRuns& runs) {
    double contacts = 0.0;
    std::size_t touching = 0;
    for (const std::uint64_t pairs : runs.poses.answers) {
        contacts += static_cast<double>(pairs);
        touching += pairs > 0 ? 1u : 0u;
    }
    JsonObject row = guide_row("volumes", subject.mesh.name, subject.topology.triangles.size());
    row.add("kind", kind);
    row.add("volume_bytes", volume_bytes);
    row.add("rays", subject.queries.rays.size());
    row.add("hits", count_finite(runs.rays.answers));
    row.add("poses", subject.queries.poses.size());
    row.add("touching_poses", touching);
    row.add("contacts", contacts / static_cast<double>(subject.queries.poses.size()), 2);
    return row;
}

/// One test of Espalier is one query against all children of a node; the walk to all contacts does not count them.
void print_own(const Subject& subject, const KindRuns& runs) {
    constexpr std::size_t node_bytes = format::node_bytes(Profile::balanced);
    QueryCounters counters;
    for (const Ray& ray : subject.queries.rays) static_cast<void>(raycast(subject.baked.blob, ray, counters));
    const std::size_t rays = subject.queries.rays.size();
    JsonObject row = row_of(subject, "espalier", node_bytes / format::max_node_children(Profile::balanced), runs);
    row.add("node_bytes", node_bytes);
    row.add("ray_volume_tests", per(counters.nodes, rays), 2);
    row.add("ray_triangle_tests", per(counters.triangles, rays), 2);
    add_spread(row, "ray_ns", runs.rays.nanoseconds, 1);
    add_spread(row, "pose_ns", runs.poses.nanoseconds, 1);
    row.print();
}

/// Prints a row for each kind of volume, and for Espalier's own queries. Throws std::runtime_error if a kind has other
/// answers than the others.
void measure_volumes(Mesh mesh, const VolumeOptions& options) {
    const Subject subject = make_subject(std::move(mesh), options);
    const std::vector<Volumes> volumes = fit_nodes(subject.topology);
    const std::vector<Extent> extents = sums_of_extents(volumes);
    const auto trees = trees_of_all_kinds(subject.topology, volumes);
    constexpr auto aabb = static_cast<std::size_t>(Kind::aabb);
    const RecordedTests recorded = record(subject.queries, *trees[aabb]);
    std::vector<KindRuns> runs(trees.size());
    KindRuns own;
    for (std::size_t round = 0; round < options.rounds; ++round) {
        for (std::size_t k = 0; k < trees.size(); ++k) make_round(subject.queries, recorded, *trees[k], runs[k]);
        make_own_round(subject, own);
    }
    for (std::size_t k = 0; k < trees.size(); ++k) {
        const std::string kind(name_of(trees[k]->kind()));
        if (runs[k].rays.answers != runs[0].rays.answers || runs[k].balls.answers != runs[0].balls.answers ||
            runs[k].poses.answers != runs[0].poses.answers)
            throw std::runtime_error(subject.mesh.name + ": the tree of kind " + kind + " has other answers");
        JsonObject row = row_of(subject, kind, trees[k]->volume_bytes(), runs[k]);
        row.add("node_bytes", trees[k]->node_bytes());
        row.add("area", extents[k].area / extents[aabb].area, 4);
        row.add("volume", extents[k].volume / extents[aabb].volume, 4);
        add_spread(row, "ray_test_ns", runs[k].ray_test, 2);
        add_spread(row, "pair_test_ns", runs[k].pair_test, 2);
        add_to(row, "ray", runs[k].rays);
        add_to(row, "ball", runs[k].balls);
        add_to(row, "pose", runs[k].poses);
        row.print();
    }
    print_own(subject, own);
}

}  // namespace

const Subcommand subcommand("volumes", [](int count, char** words) {
    VolumeOptions options;
    Program program("espalier_bench_study volumes",
                    "Kinds of bounding volume: fit, bytes, tests and time of queries; JSON");
    program.add_number("--leaf-size", options.leaf_triangles, 1u, 64u, "Triangles in a leaf, at most");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--balls", options.balls, "Balls inside the mesh's box");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run_on_meshes(count, words, [&](Mesh mesh) { measure_volumes(std::move(mesh), options); });
});

}  // namespace espalier::bench
