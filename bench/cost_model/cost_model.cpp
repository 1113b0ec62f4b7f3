// What queries cost on this machine: T = Nv Cv + Np Cp + Nu Cu + Co (Gottschalk, Lin, Manocha 1996; van den Bergen
// 1997), with the work counted and the costs fitted to measured times.
//
// Of a ray, Nv are the visited nodes and Np the tested triangles. Of two blobs, Nv are the visited pairs of boxes and
// Np the compared pairs of triangles. Nu, the boxes that are updated, is 0 for both: assets do not change, and a box is
// placed beside another where their pair is visited. Of a step of a moving scene, Nv are the tests of a box against a
// node, Np the pairs that are found and Nu the boxes of instances and nodes that are renewed.

#include "../../tools/base/choices.hpp"
#include "../program.hpp"
#include "model.hpp"

namespace espalier::bench {
namespace {

/// Returns blobs of one mesh and profile with leaves of several sizes, which go into one fit: else nodes and triangles
/// grow together, and their costs cannot be told apart. Throws std::runtime_error with the mesh's name.
std::vector<BakedBlob> blobs_of(const Mesh& mesh, Profile profile, unsigned bits) {
    std::vector<BakedBlob> baked;
    for (const unsigned divisor : {4u, 2u, 1u})
        baked.push_back(bake_blob(
            mesh, BakeOptions{.resolution = Resolution::bits(bits),
                              .profile = profile,
                              .build = {.max_leaf_triangles = tools::most_leaf_triangles(profile) / divisor}}));
    return baked;
}

using Counts = std::vector<std::uint64_t>;

/// A query of a blob whose cost is fitted to its counts.
template <class Call>
struct Query {
    const char* name;
    std::vector<Term> terms;  ///< of the counts; calls are grouped by the first two
    /// Makes it and returns its counts.
    Counts (*count)(const Blob& blob, const Call& call);
    /// Makes it as a program does. Returns whether it found something.
    bool (*run)(const Blob& blob, const Call& call);
    std::vector<std::vector<std::size_t>> models;  ///< numbers of the counts that each is made of
    Differences differences;
};

/// Nv are the visited nodes, Np the tested triangles (the classic count), Ng the groups of 8 of a leaf that lanes test
/// at once, and Nl the leaves they lie in.
const Query<Ray> ray_query = {"raycast",
                              {"Nv", "Np", "Ng", "Nl"},
                              [](const Blob& blob, const Ray& ray) -> Counts {
                                  QueryCounters work;
                                  static_cast<void>(raycast(blob, ray, work));
                                  return {work.nodes, work.triangles, work.groups, work.leaves};
                              },
                              [](const Blob& blob, const Ray& ray) { return bool(raycast(blob, ray)); },
                              {{0, 1}, {0, 2}, {0, 3}},
                              Differences::absolute};

Counts counts_of(QueryStatus status, const PairCounters& work) {
    if (is_refused(status)) throw std::runtime_error(std::string("a pose is refused: ") + describe(status));
    return {work.box_pairs, work.triangle_pairs, work.leaf_pairs};
}

/// Of a blob at the origin and the same blob in a pose. What stands for the compared triangles: their pairs, the pairs
/// of leaves that they lie in, or both.
Query<Transform> pair_query(const char* name, Counts (*count)(const Blob&, const Transform&),
                            bool (*run)(const Blob&, const Transform&)) {
    return {name, {"Nv", "Np", "Nl"}, count, run, {{0, 1}, {0, 2}, {0, 2, 1}}, Differences::relative};
}

const Query<Transform> pair_queries[] = {
    pair_query(
        "overlaps",
        [](const Blob& blob, const Transform& pose) {
            PairCounters work;
            const QueryStatus status = first_contact(blob, {blob, pose}, unlimited, work).status;
            return counts_of(status, work);
        },
        [](const Blob& blob, const Transform& pose) {
            return overlaps(blob, {blob, pose}, unlimited).yes();
        }),
    pair_query(
        "distance",
        [](const Blob& blob, const Transform& pose) {
            PairCounters work;
            const QueryStatus status = distance(blob, {blob, pose}, unlimited, infinity, work).status;
            return counts_of(status, work);
        },
        [](const Blob& blob, const Transform& pose) {
            return bool(distance(blob, {blob, pose}, unlimited));
        })};

template <class Call>
struct Group {
    Blob blob;
    std::vector<Call> calls;
    std::vector<double> means;  ///< of the counts of a call
};

template <class Call>
void append_groups(const Query<Call>& query, const Blob& blob, const std::vector<Call>& calls,
                   std::vector<Group<Call>>& groups) {
    std::vector<Counts> work;
    Counts first, second;
    for (const Call& call : calls) {
        work.push_back(query.count(blob, call));
        first.push_back(work.back()[0]);
        second.push_back(work.back()[1]);
    }
    for (const Members& members : group_by_work(first, second)) {
        Group<Call> group = {blob, {}, std::vector<double>(query.terms.size())};
        for (const std::uint32_t call : members) {
            group.calls.push_back(calls[call]);
            for (std::size_t k = 0; k < group.means.size(); ++k) group.means[k] += static_cast<double>(work[call][k]);
        }
        for (double& mean : group.means) mean /= static_cast<double>(members.size());
        groups.push_back(std::move(group));
    }
}

template <class Call>
std::vector<Model> measure(const Query<Call>& query, const std::string& mesh, const std::vector<BakedBlob>& blobs,
                           const std::vector<Call>& calls, unsigned repetitions) {
    std::vector<Group<Call>> groups;
    for (const BakedBlob& baked : blobs) append_groups(query, baked.blob, calls, groups);
    std::vector<std::size_t> sizes;
    for (const Group<Call>& group : groups) sizes.push_back(group.calls.size());
    const std::vector<double> times = time_in_turns(sizes, repetitions, false, [&](std::size_t i) {
        unsigned found = 0;
        for (const Call& call : groups[i].calls) found += query.run(groups[i].blob, call);
        return found;
    });
    std::vector<Model> models;
    for (const std::vector<std::size_t>& counts : query.models) {
        std::vector<Term> terms;
        for (const std::size_t count : counts) terms.push_back(query.terms[count]);
        std::vector<Observation> observations;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            Observation& observation = observations.emplace_back(Observation{{}, times[i]});
            for (const std::size_t count : counts) observation.terms.push_back(groups[i].means[count]);
            observation.terms.push_back(1.0);
        }
        models.push_back(fit_model(mesh, std::move(terms), std::move(observations), query.differences));
    }
    return models;
}

template <class Call>
void model(const Query<Call>& query, const Mesh& mesh, const std::string& profile, const std::vector<BakedBlob>& blobs,
           const std::vector<Call>& calls, const CostOptions& options) {
    print_rows(measure(query, mesh.name, blobs, calls, options.repetitions), [&](const std::string& measures) {
        JsonObject row = guide_row(measures, mesh.name, mesh.triangles.size());
        row.add("query", query.name);
        row.add("profile", profile);
        return row;
    });
}

/// Fits the cost of a ray, or of overlaps() and of distance() of two blobs, for each mesh and profile, and prints it.
void model_meshes(const std::vector<std::string>& meshes, bool pairs, const CostOptions& options) {
    for (const std::string& path : meshes) {
        const Mesh mesh = tests::read_mesh(path);
        std::vector<Transform> poses;
        for (const auto& [name, profile] : tools::profile_choices) {
            if (!options.profiles.empty() &&
                std::find(options.profiles.begin(), options.profiles.end(), name) == options.profiles.end())
                continue;
            const std::vector<BakedBlob> baked = blobs_of(mesh, profile, options.bits);
            const Blob& blob = baked.front().blob;
            if (!pairs) {
                model(ray_query, mesh, name, baked, incoherent_rays(mesh, options.rays, seed), options);
                continue;
            }
            if (poses.empty())
                poses = some_poses(mesh, options.poses, seed, [&](const Transform& pose) {
                    return overlaps(blob, {blob, pose}, unlimited).yes();
                });
            for (const Query<Transform>& query : pair_queries) model(query, mesh, name, baked, poses, options);
        }
    }
}

}  // namespace

const Subcommand subcommand("cost_model", [](int count, char** words) {
    CostOptions options;
    bool pairs = false, scene = false;
    Program program("espalier_bench_study cost_model",
                    "What queries cost on this machine, fitted to measured times; JSON");
    program.allow_no_meshes();
    program.add_flag("--pairs", pairs, "Two blobs of each mesh instead of rays: overlaps and distances");
    program.add_flag("--scene", scene, "A scene of moving cubes instead of rays; takes no meshes");
    program.add_words("--profile", options.profiles, "Only this profile; may be repeated",
                      names_of(tools::profile_choices));
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
        else model_meshes(meshes, pairs, options);
    });
});

}  // namespace espalier::bench
