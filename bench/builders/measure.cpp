// What each builder's tree costs and brings: its quality, the time to build it, bytes, and the work and time of rays
// and pairs. Each tree as it is built, and after a pass of reinsertion. One thread; one JSON object a line.

#include "../../tools/layout/tree_quality.hpp"
#include "../selected.hpp"
#include "../study/study.hpp"
#include "bakes.hpp"
#include "builders.hpp"

namespace espalier::bench {
namespace {

struct Options {
    std::size_t rays = 100'000;
    std::size_t poses = 1'000;
    std::size_t rounds = 5;
    std::vector<std::string> only;
};

/// One tree over the mesh, and what was measured of it.
struct Subject {
    const NamedBuilder* builder;
    bool is_reinserted;
    double build_seconds;
    double reinsertion_seconds;
    BinaryTreeQuality quality;
    std::size_t references;
    TimedBlob built;
    QueryCounters ray_counters;
    Timed<float, QueryCounters> rays;  ///< t of the closest hit
    Timed<bool, PairCounters> poses;   ///< whether the mesh touches a second one of its kind
};

std::vector<Subject> make_subjects(const Bakes& bakes, const std::vector<NamedBuilder>& builders, std::size_t rounds) {
    std::vector<Subject> subjects;
    for (const NamedBuilder& builder : builders) {
        const TimedTree built = bakes.build(builder, rounds);
        const TimedTree moved = bakes.reinsert(built.tree);
        for (const TimedTree* timed : {&built, &moved}) {
            Subject subject{};
            subject.builder = &builder;
            subject.is_reinserted = timed == &moved;
            subject.build_seconds = built.seconds;
            subject.reinsertion_seconds = subject.is_reinserted ? moved.seconds : 0.0;
            subject.quality = quality_of(timed->tree);
            subject.references = timed->tree.triangles.size();
            subject.built = bakes.bake(timed->tree);
            subjects.push_back(std::move(subject));
        }
        std::fprintf(stderr, "%s: %s, %.3f s\n", bakes.mesh().name.c_str(), builder.name.c_str(), built.seconds);
    }
    return subjects;
}

bool touches(const Blob& blob, const Transform& pose, PairCounters& counters) {
    const PairContact contact = first_contact(blob, {blob, pose}, unlimited, counters);
    if (is_refused(contact.status)) throw std::runtime_error(describe(contact.status));
    return static_cast<bool>(contact);
}

/// Counts and times the queries; the subjects take turns.
void measure(std::vector<Subject>& subjects, const tests::Mesh& mesh, const Options& options) {
    PairCounters unused;
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    const std::vector<Transform> poses = some_poses(mesh, options.poses, seed, [&](const Transform& pose) {
        return touches(subjects.front().built.blob, pose, unused);
    });
    for (Subject& subject : subjects)
        for (const Ray& ray : rays) static_cast<void>(raycast(subject.built.blob, ray, subject.ray_counters));
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (Subject& subject : subjects) {
            const Blob& blob = subject.built.blob;
            subject.rays.make_round(rays, [&](const Ray& ray, QueryCounters&) { return raycast(blob, ray).t; });
            subject.poses.make_round(
                poses, [&](const Transform& pose, PairCounters& work) { return touches(blob, pose, work); });
        }
    const Subject& first = subjects.front();
    for (const Subject& subject : subjects)
        if (subject.rays.answers != first.rays.answers || subject.poses.answers != first.poses.answers)
            throw std::runtime_error(mesh.name + ": other answers from the tree of " + subject.builder->name);
}

std::string areas_by_depth(const tools::TreeQuality& quality) {
    std::vector<std::string> areas;
    for (const tools::LevelQuality& level : quality.levels) areas.push_back(decimal(level.areas(), 4));
    return json_list(areas);
}

void print(const Subject& subject, const Bakes& bakes, const Options& options) {
    const std::size_t triangles = bakes.lattice_mesh().triangles.size();
    JsonObject row = guide_row("builders", bakes.mesh().name, triangles);
    row.add("family", subject.builder->family);
    row.add("builder", subject.builder->name);
    row.add("reinserted", subject.is_reinserted);
    row.add("build_ms", 1e3 * subject.build_seconds, 3);
    row.add("reinsertion_ms", 1e3 * subject.reinsertion_seconds, 3);
    row.add("rest_of_bake_ms", 1e3 * subject.built.seconds, 3);
    row.add("references", subject.references);
    row.add("height", std::size_t{subject.quality.height});
    row.add("sah_cost", subject.quality.sah_cost(), 3);
    row.add("inner_areas", subject.quality.inner_areas, 3);
    row.add("volumes", subject.quality.volumes, 4);
    const tools::TreeQuality blob = tools::tree_quality_of(subject.built.blob);
    row.add("node_areas", blob.all.node_areas, 3);
    row.add("leaf_areas", blob.all.leaf_areas, 3);
    row.add("triangle_areas", blob.triangle_areas, 3);
    row.add("node_volumes", blob.all.volumes, 4);
    row.add("shared_areas", blob.all.shared_areas, 3);
    row.add("leaf_depth", blob.mean_leaf_depth, 3);
    row.add("greatest_leaf_depth", std::size_t{blob.greatest_leaf_depth});
    row.add("full_leaf_depth", blob.full_leaf_depth, 3);
    row.add_raw("areas_by_depth", areas_by_depth(blob));
    row.add("bytes_per_triangle", per(subject.built.baked.bytes.size(), triangles), 3);
    row.add("rays", options.rays);
    row.add("nodes_per_ray", subject.rays.mean(subject.ray_counters.nodes), 3);
    row.add("leaves_per_ray", subject.rays.mean(subject.ray_counters.leaves), 3);
    row.add("triangles_per_ray", subject.rays.mean(subject.ray_counters.triangles), 3);
    add_spread(row, "ns_per_ray", subject.rays.nanoseconds, 1);
    const auto touching = std::ranges::count(subject.poses.answers, true);
    row.add("poses", options.poses);
    row.add("touching_poses", static_cast<std::size_t>(touching));
    row.add("box_pairs_per_pose", subject.poses.mean(subject.poses.work.box_pairs), 2);
    row.add("leaf_pairs_per_pose", subject.poses.mean(subject.poses.work.leaf_pairs), 3);
    add_spread(row, "ns_per_pose", subject.poses.nanoseconds, 1);
    row.add("rounds", options.rounds);
    row.print();
}

void run(const std::vector<std::string>& files, const Options& options) {
    std::vector<NamedBuilder> builders = all_builders();
    select(
        builders, options.only,
        [](const NamedBuilder& builder, const std::string& begin) { return builder.name.starts_with(begin); },
        [](const NamedBuilder&) { return false; }, [](const NamedBuilder& builder) { return builder.name; });
    for (const std::string& file : files) {
        const Bakes bakes(tests::read_mesh(file));
        std::vector<Subject> subjects = make_subjects(bakes, builders, options.rounds);
        measure(subjects, bakes.mesh(), options);
        for (const Subject& subject : subjects) print(subject, bakes, options);
        std::fflush(stdout);
    }
}

}  // namespace

const Subcommand subcommand("builders", [](int count, char** words) {
    Options options;
    Program program(
        "espalier_bench_study builders",
        "What each builder's tree costs and brings, as built and after reinsertion: quality, time to build, "
        "bytes, rays and pairs; profile fast; JSON");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--poses", options.poses, "Poses of a second mesh of the same kind");
    program.add_count("--rounds", options.rounds, "How often each blob is queried in turn; the median counts");
    program.add_words("--only", options.only, "Only this builder, by how its name begins; may be repeated");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) { run(meshes, options); });
});

}  // namespace espalier::bench
