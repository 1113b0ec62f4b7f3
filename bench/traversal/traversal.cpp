// How hierarchies are traversed: two of them against each other by each rule of descent, and rays by each order of
// children, in a textbook tree. Espalier's own queries are in the same rows. One thread; one JSON object a line.
#include "../study/study.hpp"

namespace espalier::bench {
namespace {

struct Options {
    unsigned leaf_triangles = 4;
    std::size_t poses = 100;
    std::size_t rays = 20'000;
    std::size_t rounds = 5;
};

/// Moves the second mesh to a quarter of its distance from the middle of the first one.
Transform deeper(Transform pose, const Vec3& middle) {
    const Matrix matrix = rotation_matrix(pose);
    const double center[3] = {static_cast<double>(middle.x), static_cast<double>(middle.y),
                              static_cast<double>(middle.z)};
    float* const shift[3] = {&pose.translation.x, &pose.translation.y, &pose.translation.z};
    for (int k = 0; k < 3; ++k) {
        const auto& row = matrix.at[k];
        const double alone = center[k] - (row[0] * center[0] + row[1] * center[1] + row[2] * center[2]);
        *shift[k] = static_cast<float>(alone + 0.25 * (static_cast<double>(*shift[k]) - alone));
    }
    return pose;
}

PairWork run_espalier(const Blob& blob, PairQuestion question, const Transform& pose) {
    if (question == PairQuestion::all) return {0, 0, count_contacts(blob, pose)};
    PairCounters counters;
    const PairContact contact = first_contact(blob, {blob, pose}, unlimited, counters);
    if (is_refused(contact.status))
        throw std::runtime_error(std::string("a pose is refused: ") + describe(contact.status));
    return {counters.box_pairs, counters.triangle_pairs, contact ? 1u : 0u};
}

std::vector<PairRun> pair_runs(const TreeSubject& subject, PairQuestion question, PairWalk& walk) {
    std::vector<PairRun> runs;
    for (const PairRule rule : all_pair_rules)
        runs.push_back({std::string(name_of(rule)), pairs_by([&walk, rule, question](const Transform& pose) {
                            return walk.run(rule, question, Placement(pose));
                        })});
    runs.push_back({"espalier", pairs_by([&subject, question](const Transform& pose) {
                        return run_espalier(subject.blob(), question, pose);
                    }),
                    false});
    return runs;
}

/// Prints a row for each class of poses, question and rule, and for Espalier's own queries, which count no tests where
/// all pairs are sought.
void measure_pairs(const TreeSubject& subject, const Options& options) {
    PairWalk walk(subject.tree(), subject.tree());
    std::vector<PoseClass> classes = classes_of_poses(subject, options.poses);
    PoseClass deep = {"deep", {}};
    for (const Transform& pose : classes.back().poses)
        deep.poses.push_back(deeper(pose, bounding_sphere(subject.mesh).center));
    classes.push_back(deep);
    for (const PoseClass& poses : classes)
        for (const PairQuestion question : {PairQuestion::any, PairQuestion::all}) {
            std::vector<PairRun> runs = pair_runs(subject, question, walk);
            take_turns(subject.mesh.name, runs, poses.poses, options.rounds);
            for (const auto& [name, ask, is_exact, timed] : runs) {
                const bool has_work = is_exact || question == PairQuestion::any;
                const auto mean = [&](std::uint64_t sum) {
                    return has_work ? std::optional(per(sum, poses.poses.size())) : std::nullopt;
                };
                JsonObject row = guide_row("traversal pairs", subject.mesh.name, subject.tree().triangles.size());
                row.add("poses_are", poses.name);
                row.add("question", question == PairQuestion::any ? "any" : "all");
                row.add("rule", name);
                row.add("poses", poses.poses.size());
                row.add("pairs", timed.mean(timed.work.pairs), 2);
                row.add("poses_that_differ", timed.differing(runs.front().timed));
                row.add("box_tests", mean(timed.work.box_tests), 1);
                row.add("triangle_tests", mean(timed.work.triangle_tests), 1);
                add_spread(row, "ns", timed.nanoseconds, 0);
                row.print();
            }
        }
}

/// Prints a row for each order, and for Espalier's own query.
void measure_rays(const TreeSubject& subject, const Options& options) {
    const std::vector<Ray> rays = incoherent_rays(subject.mesh, options.rays, seed);
    RayWalk walk(subject.tree());
    std::vector<Run<Ray, double, RayWork>> runs;
    for (const RayOrder order : all_ray_orders)
        runs.push_back({std::string(name_of(order)),
                        [&walk, order](const Ray& ray, RayWork& work) { return walk.closest(order, ray, work); }});
    runs.push_back({"espalier",
                    [&](const Ray& ray, RayWork&) { return static_cast<double>(raycast(subject.blob(), ray).t); },
                    false});
    take_turns(subject.mesh.name, runs, rays, options.rounds);
    QueryCounters counters;
    for (const Ray& ray : rays) static_cast<void>(raycast(subject.blob(), ray, counters));
    runs.back().timed.work = {counters.nodes, counters.triangles, 0};
    for (const auto& [name, ask, is_exact, timed] : runs) {
        JsonObject row = guide_row("traversal rays", subject.mesh.name, subject.tree().triangles.size());
        row.add("order", name);
        row.add("rays", rays.size());
        row.add("hits", count_finite(timed.answers));
        row.add("box_tests", timed.mean(timed.work.box_tests), 2);
        row.add("triangle_tests", timed.mean(timed.work.triangle_tests), 2);
        row.add("skipped", is_exact ? std::optional(timed.mean(timed.work.skipped)) : std::nullopt, 2);
        add_spread(row, "ns", timed.nanoseconds, 1);
        row.print();
    }
}

}  // namespace

const Subcommand subcommand("traversal", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_study traversal",
                    "Rules of descent for two hierarchies, and orders of children for rays; JSON");
    program.add_number("--leaf-size", options.leaf_triangles, 1u, 64u, "Triangles in a leaf, at most");
    program.add_count("--poses", options.poses, "Poses of the second mesh");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the medians count");
    return program.run_on_meshes(count, words, [&](Mesh mesh) {
        const TreeSubject subject(std::move(mesh), options.leaf_triangles);
        measure_pairs(subject, options);
        measure_rays(subject, options);
    });
});

}  // namespace espalier::bench
