// Meshes that change: refit beside peers, rays after it beside those after a bake, and boxes along the axes beside
// oriented ones. One thread; one JSON object a line.

#include "../../tools/base/choices.hpp"
#include "../study/study.hpp"
#include "box_tree.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

// What a refit is made of: nodes, whose boxes are updated (Nu of the cost model), and the vertices of leaves. Leaves of
// several sizes separate the two.

constexpr std::array<unsigned, 4> leaf_sizes = {2, 4, 8, format::plain_leaf::max_triangles};

struct LeafRun {
    unsigned leaf_triangles;
    std::unique_ptr<DeformableMesh> mesh;
    std::vector<double> nanoseconds;
};

void print(const MotionSubject& subject, const LeafRun& run) {
    const RefitWork& work = run.mesh->work();
    JsonObject row = subject.row("nodes");
    row.add("most_leaf_triangles", std::size_t{run.leaf_triangles});
    row.add("nodes", work.nodes);
    row.add("leaves", work.leaves);
    row.add("leaf_vertices", work.leaf_vertices);
    row.add("moving_bytes", work.moving_bytes);
    add_spread(row, "ns", run.nanoseconds, 0);
    row.print();
}

/// Prints the time of a refit for leaves of several sizes: what a node and a leaf vertex cost.
void measure_nodes(const MotionSubject& subject) {
    std::vector<LeafRun> runs;
    for (const unsigned size : leaf_sizes)
        runs.push_back(
            {size,
             std::make_unique<DeformableMesh>(subject.rest(), DeformableOptions{.range = subject.range(),
                                                                                .bits = subject.options().bits,
                                                                                .max_leaf_triangles = size}),
             {}});
    for (std::size_t round = 0; round < subject.options().rounds; ++round) {
        std::vector<double> seconds(runs.size());
        for (const TimedPose& pose : subject.poses())
            for (std::size_t i = 0; i < runs.size(); ++i) {
                runs[i].mesh->move(subject.rest().positions);
                const ProcessorTime time;
                runs[i].mesh->move(pose.positions);
                seconds[i] += time.seconds();
            }
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i].nanoseconds.push_back(1e9 * seconds[i] / static_cast<double>(subject.poses().size()));
    }
    for (const LeafRun& run : runs) print(subject, run);
}

/// Prints the time of a bake for each effort.
void measure_bakes(const MotionSubject& subject) {
    const Mesh posed = subject.moving().posed(Motion::bend, 1.0);
    for (const auto& [name, effort] : tools::effort_choices) {
        std::vector<double> nanoseconds;
        for (std::size_t round = 0; round < subject.options().rounds; ++round) {
            const DeformableMesh baked(posed,
                                       {.range = subject.range(), .bits = subject.options().bits, .effort = effort});
            nanoseconds.push_back(1e9 * baked.bake_seconds() / subject.triangles());
        }
        JsonObject row = subject.row("bake");
        row.add("effort", name);
        add_spread(row, "ns_per_triangle", nanoseconds, 1);
        row.print();
    }
}

// How tight boxes stay over the tree at rest: those along the axes, and oriented ones. The area of all boxes over that
// of those in a tree that was built for the pose.

struct Areas {
    double aabb = 0.0, obb = 0.0;
};

Areas areas_of(const BoxTreeShape& shape, const std::vector<Vec3>& positions) {
    std::vector<Aabb> aabbs(shape.nodes.size());
    std::vector<Obb> obbs(shape.nodes.size());
    refit_aabbs(shape, positions, aabbs);
    fit_obbs(shape, positions, obbs);
    return {total_half_area(aabbs), total_half_area(obbs)};
}

void print(const MotionSubject& subject, const char* motion, const char* boxes, double refitted, double built,
           double built_aabb) {
    JsonObject row = subject.row("boxes");
    row.add("motion", motion);
    row.add("boxes", boxes);
    row.add("times_built", built > 0.0 ? std::optional(refitted / built) : std::nullopt, 3);
    row.add("times_built_aabb", built_aabb > 0.0 ? std::optional(refitted / built_aabb) : std::nullopt, 3);
    row.print();
}

void measure(const MotionSubject& subject, const BoxTreeShape& at_rest, const char* motion,
             const std::vector<Vec3>& positions) {
    const Areas refitted = areas_of(at_rest, positions);
    const Areas built = areas_of(build_box_tree(subject.rest().triangles, positions), positions);
    print(subject, motion, "aabb", refitted.aabb, built.aabb, built.aabb);
    print(subject, motion, "obb anew", refitted.obb, built.obb, built.aabb);
}

/// Prints the areas of boxes in the last pose of each motion: in the tree at rest, and in a tree built for that pose.
void measure_boxes(const MotionSubject& subject) {
    const BoxTreeShape at_rest = build_box_tree(subject.rest().triangles, subject.rest().positions);
    measure(subject, at_rest, "rest", subject.rest().positions);
    for (const Motion motion : deforming)
        measure(subject, at_rest, name_of(motion), subject.moving().positions(motion, 1.0));
    measure(subject, at_rest, name_of(Motion::turn), subject.moving().positions(Motion::turn, 1.0));
}

// Rays into a mesh that has moved. All trees have the same lattice and the same triangles, so their hits are the same.

/// A tree and what rays cost in it.
struct RayRun {
    std::string tree;
    const Blob* blob;
    std::vector<Ray> rays;
    std::optional<float> quality = std::nullopt;    ///< of the refit
    std::optional<Transform> place = std::nullopt;  ///< rays are moved to local space
    QueryCounters counters = {};
    std::size_t hits = 0;
    Timed<float, RayWork> timed = {};

    [[nodiscard]] Ray local(const Ray& ray) const { return place ? to_local(*place, ray) : ray; }
    void count() {
        for (const Ray& ray : rays) hits += raycast(*blob, local(ray), counters) ? 1u : 0u;
    }
    void measure() {
        timed.make_round(rays, [this](const Ray& ray, RayWork&) { return raycast(*blob, local(ray)).t; });
        const auto missed = static_cast<std::size_t>(std::ranges::count(timed.answers, INFINITY));
        if (hits + missed != rays.size()) throw std::runtime_error(tree + ": the counted rays have other hits");
    }
};

void print(const MotionSubject& subject, Motion motion, const RayRun& run, const RayRun& reference) {
    const auto per_ray = [&](std::uint64_t total) { return run.timed.mean(total); };
    JsonObject row = subject.row("rays");
    row.add("motion", name_of(motion));
    row.add("tree", run.tree);
    row.add("rays", run.rays.size());
    row.add("hit_fraction", per_ray(run.hits), 4);
    row.add("quality", run.quality ? std::optional(static_cast<double>(*run.quality)) : std::nullopt, 3);
    row.add("nodes_per_ray", per_ray(run.counters.nodes), 3);
    row.add("leaves_per_ray", per_ray(run.counters.leaves), 3);
    row.add("triangles_per_ray", per_ray(run.counters.triangles), 3);
    add_spread(row, "ns_per_ray", run.timed.nanoseconds, 2);
    row.add("times_bake_nodes",
            reference.counters.nodes == 0 ? std::nullopt
                                          : std::optional(static_cast<double>(run.counters.nodes) /
                                                          static_cast<double>(reference.counters.nodes)),
            3);
    row.add("rays_that_differ", run.timed.differing(reference.timed));
    row.print();
}

/// The trees that stay the same for all motions.
struct StandingTrees {
    explicit StandingTrees(const MotionSubject& subject) : rest(subject.rest(), options(subject)) {
        DeformableOptions with_poses = options(subject);
        for (const Motion motion : deforming) with_poses.poses.push_back(subject.moving().positions(motion, 1.0));
        all_poses = std::make_unique<DeformableMesh>(subject.rest(), with_poses);
    }
    static DeformableOptions options(const MotionSubject& subject) {
        return {.range = subject.range(), .bits = subject.options().bits};
    }
    DeformableMesh rest;
    std::unique_ptr<DeformableMesh> all_poses;
};

void measure(const MotionSubject& subject, StandingTrees& trees, Motion motion) {
    const Mesh posed = subject.moving().posed(motion, 1.0);
    const std::vector<Ray> rays = incoherent_rays(posed, subject.options().rays, seed);
    DeformableOptions with_pose = StandingTrees::options(subject);
    with_pose.poses.push_back(posed.positions);
    DeformableMesh one_pose(subject.rest(), with_pose);
    const DeformableMesh baked(posed, StandingTrees::options(subject));
    const DeformableMesh unmoved(subject.rest(), StandingTrees::options(subject));

    std::vector<RayRun> runs;
    runs.push_back({"bake", &baked.blob(), rays});
    runs.push_back({"rest", &trees.rest.blob(), rays, trees.rest.move(posed.positions)});
    runs.push_back({"pose", &one_pose.blob(), rays, one_pose.move(posed.positions)});
    runs.push_back({"all poses", &trees.all_poses->blob(), rays, trees.all_poses->move(posed.positions)});
    if (motion == Motion::turn)
        runs.push_back({"moved rays", &unmoved.blob(), rays, std::nullopt, subject.moving().turned(1.0)});
    for (RayRun& run : runs) run.count();
    for (std::size_t round = 0; round < subject.options().rounds; ++round)
        for (RayRun& run : runs) run.measure();
    for (const RayRun& run : runs) print(subject, motion, run, runs.front());
}

/// Prints visits and time of rays in the last pose of each motion: after a refit, and after a bake of that pose.
void measure_rays(const MotionSubject& subject) {
    StandingTrees trees(subject);
    for (const Motion motion : deforming) measure(subject, trees, motion);
    measure(subject, trees, Motion::turn);
}

struct Part {
    const char* name;
    void (*measure)(const MotionSubject&);
};
constexpr Part all_parts[] = {{"refits", measure_refits},
                              {"nodes", measure_nodes},
                              {"bakes", measure_bakes},
                              {"rays", measure_rays},
                              {"boxes", measure_boxes}};

void run(Mesh mesh, const DeformationOptions& options) {
    const MotionSubject subject(std::move(mesh), options);
    for (const Part& part : all_parts)
        if (options.parts.empty() ||
            std::find(options.parts.begin(), options.parts.end(), part.name) != options.parts.end())
            part.measure(subject), std::fflush(stdout);
}

}  // namespace

const Subcommand subcommand("deformation", [](int count, char** words) {
    DeformationOptions options;
    Program program(
        "espalier_bench_study deformation",
        "A cloth and meshes that bend, twist, wave, fold, collapse and shake: refit beside peers, rays after "
        "it, and boxes of two kinds; JSON");
    program.allow_no_meshes();
    std::vector<std::string> parts;
    for (const Part& part : all_parts) parts.emplace_back(part.name);
    program.add_number("--cloth", options.cloth, std::size_t{0}, std::size_t{2000},
                       "Squares along a side of the cloth; 0: no cloth");
    program.add_count("--times", options.times, "Poses of each motion");
    program.add_count("--rounds", options.rounds, "How often everything is measured; the median counts");
    program.add_count("--rays", options.rays, "Incoherent rays into each pose");
    program.add_number("--bits", options.bits, 1u, 24u, "Lattice bits of Espalier");
    program.add_words("--part", options.parts, "Only this part; may be repeated", parts);
    program.add_words("--only", options.only,
                      "Only this system beside Espalier, by how its name begins: embree, fcl aabb; may be repeated");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        if (options.cloth > 0) run(make_cloth(options.cloth), options);
        for (const std::string& file : meshes) run(tests::read_mesh(file), options);
    });
});

}  // namespace espalier::bench
