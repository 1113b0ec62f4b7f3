// What each builder's tree costs and brings: its quality, the time to build it, bytes, and the work and time of rays
// and pairs. Each tree as it is built, and after a pass of reinsertion. One thread; one JSON object a line.

#include "../../tools/layout/tree_quality.hpp"
#include "../program.hpp"
#include "bakes.hpp"
#include "builders.hpp"

namespace espalier::bench {
namespace {

struct Options {
    QueryCounts queries;
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
    BuiltBlob built;
    Work work;
    std::vector<double> ray_nanoseconds;
    std::vector<double> pair_nanoseconds;
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

/// Counts and times the queries; the subjects take turns.
void measure(std::vector<Subject>& subjects, const tests::Mesh& mesh, const Options& options) {
    const Queries queries(mesh, subjects.front().built.blob, options.queries);
    for (Subject& subject : subjects) {
        subject.work = queries.count(subject.built.blob);
        if (subject.work.answers != subjects.front().work.answers)
            throw std::runtime_error(mesh.name + ": other answers from the tree of " + subject.builder->name);
    }
    for (std::size_t round = 0; round < options.rounds; ++round) {
        for (Subject& subject : subjects) {
            const Seconds seconds = queries.time(subject.built.blob);
            subject.ray_nanoseconds.push_back(1e9 * seconds.rays / static_cast<double>(options.queries.rays));
            subject.pair_nanoseconds.push_back(1e9 * seconds.pairs / static_cast<double>(options.queries.poses));
        }
    }
}

std::string areas_by_depth(const tools::TreeQuality& quality) {
    std::string list = "[";
    for (const tools::LevelQuality& level : quality.levels) {
        if (list.size() > 1) list += ',';
        list += decimal(level.areas(), 4);
    }
    list += ']';
    return list;
}

void print(const Subject& subject, const Bakes& bakes, const Options& options) {
    const std::size_t triangles = bakes.lattice_mesh().triangles.size();
    const auto per = [](std::uint64_t count, std::size_t calls) {
        return static_cast<double>(count) / static_cast<double>(calls);
    };
    JsonObject row = guide_row("builders", bakes.mesh().name, triangles);
    row.add("family", subject.builder->family);
    row.add("builder", subject.builder->name);
    row.add_raw("reinserted", subject.is_reinserted ? "true" : "false");
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
    row.add("bytes_per_triangle", per(subject.built.bytes.size(), triangles), 3);
    row.add("rays", options.queries.rays);
    row.add("nodes_per_ray", per(subject.work.rays.nodes, options.queries.rays), 3);
    row.add("leaves_per_ray", per(subject.work.rays.leaves, options.queries.rays), 3);
    row.add("triangles_per_ray", per(subject.work.rays.triangles, options.queries.rays), 3);
    add_spread(row, "ns_per_ray", subject.ray_nanoseconds, 1);
    row.add("poses", options.queries.poses);
    row.add("touching_poses", subject.work.touching_poses);
    row.add("box_pairs_per_pose", per(subject.work.pairs.box_pairs, options.queries.poses), 2);
    row.add("leaf_pairs_per_pose", per(subject.work.pairs.leaf_pairs, options.queries.poses), 3);
    add_spread(row, "ns_per_pose", subject.pair_nanoseconds, 1);
    row.add("rounds", options.rounds);
    row.print();
}

std::vector<NamedBuilder> chosen_builders(const std::vector<std::string>& only) {
    std::vector<NamedBuilder> builders = all_builders();
    if (only.empty()) return builders;
    std::erase_if(builders, [&](const NamedBuilder& builder) {
        return std::none_of(only.begin(), only.end(),
                            [&](const std::string& begin) { return builder.name.starts_with(begin); });
    });
    if (builders.empty()) throw std::invalid_argument("--only: no builder has a name that begins so");
    return builders;
}

void run(const std::vector<std::string>& files, const Options& options) {
    const std::vector<NamedBuilder> builders = chosen_builders(options.only);
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
    program.add_count("--rays", options.queries.rays, "Incoherent rays");
    program.add_count("--poses", options.queries.poses, "Poses of a second mesh of the same kind");
    program.add_count("--rounds", options.rounds, "How often each blob is queried in turn; the median counts");
    program.add_words("--only", options.only, "Only this builder, by how its name begins; may be repeated");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) { run(meshes, options); });
});

}  // namespace espalier::bench
