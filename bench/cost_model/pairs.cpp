// The cost of two blobs: Nv pairs of boxes visited, Np pairs of triangles compared.
#include <cstdio>
#include <stdexcept>
#include <utility>

#include <espalier/pair.hpp>
#include <espalier/statistics.hpp>

#include "../../tests/support/meshes/files.hpp"
#include "../guide/row.hpp"
#include "../pairs/poses.hpp"
#include "blobs.hpp"
#include "groups.hpp"
#include "model.hpp"
#include "options.hpp"

namespace espalier::bench {
namespace {

constexpr WorkLimit unlimited = WorkLimit::unlimited();

/// A query of a blob at the origin and the same blob in a pose.
struct PairQuery {
    const char* name;
    /// Makes it and adds its work.
    QueryStatus (*count)(const Blob& blob, const Transform& pose, PairCounters& counters);
    /// Makes it as a program does. Returns whether it found something.
    bool (*run)(const Blob& blob, const Transform& pose);
};
constexpr PairQuery queries[] = {{"overlaps",
                                  [](const Blob& blob, const Transform& pose, PairCounters& counters) {
                                      return first_contact(blob, {blob, pose}, unlimited, counters).status;
                                  },
                                  [](const Blob& blob, const Transform& pose) {
                                      return overlaps(blob, {blob, pose}, unlimited).yes();
                                  }},
                                 {"distance",
                                  [](const Blob& blob, const Transform& pose, PairCounters& counters) {
                                      return distance(blob, {blob, pose}, unlimited, infinity, counters).status;
                                  },
                                  [](const Blob& blob, const Transform& pose) {
                                      return bool(distance(blob, {blob, pose}, unlimited));
                                  }}};

/// Means of one pose of the group.
struct PairGroup {
    Blob blob;
    std::vector<Transform> poses;
    double box_pairs = 0.0;
    double leaf_pairs = 0.0;
    double triangle_pairs = 0.0;
};

struct PairTerm {
    Term term;
    double PairGroup::*count;
};
constexpr PairTerm triangle_pairs = {{"Np", "pair of triangles"}, &PairGroup::triangle_pairs};
constexpr PairTerm leaf_pairs = {{"Nl", "pair of leaves"}, &PairGroup::leaf_pairs};

void append_groups(const PairQuery& query, const Blob& blob, const std::vector<Transform>& poses,
                   std::vector<PairGroup>& groups) {
    std::vector<PairCounters> work(poses.size());
    std::vector<std::uint64_t> of_boxes, of_triangles;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const QueryStatus status = query.count(blob, poses[i], work[i]);
        if (is_refused(status)) throw std::runtime_error(std::string("a pose is refused: ") + describe(status));
        of_boxes.push_back(work[i].box_pairs);
        of_triangles.push_back(work[i].triangle_pairs);
    }
    for (const Members& members : group_by_work(of_boxes, of_triangles)) {
        PairGroup group;
        group.blob = blob;
        for (const std::uint32_t pose : members) {
            group.poses.push_back(poses[pose]);
            group.box_pairs += static_cast<double>(work[pose].box_pairs);
            group.leaf_pairs += static_cast<double>(work[pose].leaf_pairs);
            group.triangle_pairs += static_cast<double>(work[pose].triangle_pairs);
        }
        for (double* sum : {&group.box_pairs, &group.leaf_pairs, &group.triangle_pairs})
            *sum /= static_cast<double>(members.size());
        groups.push_back(std::move(group));
    }
}

std::vector<Model> measure(const PairQuery& query, const std::string& mesh, const std::vector<Blob>& blobs,
                           const std::vector<Transform>& poses, unsigned repetitions) {
    std::vector<PairGroup> groups;
    for (const Blob& blob : blobs) append_groups(query, blob, poses, groups);
    std::vector<std::size_t> calls;
    for (const PairGroup& group : groups) calls.push_back(group.poses.size());
    const std::vector<double> times = time_in_turns(calls, repetitions, false, [&](std::size_t i) {
        unsigned found = 0;
        for (const Transform& pose : groups[i].poses) found += query.run(groups[i].blob, pose);
        return found;
    });
    // What stands for the compared triangles: their pairs, the pairs of leaves that they lie in, or both.
    const std::vector<PairTerm> others[] = {{triangle_pairs}, {leaf_pairs}, {leaf_pairs, triangle_pairs}};
    std::vector<Model> models;
    for (const std::vector<PairTerm>& of_triangles : others) {
        std::vector<Term> terms = {{"Nv", "pair of boxes"}};
        for (const PairTerm& other : of_triangles) terms.push_back(other.term);
        std::vector<Observation> observations;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            Observation observation = {{groups[i].box_pairs}, times[i]};
            for (const PairTerm& other : of_triangles) observation.terms.push_back(groups[i].*other.count);
            observation.terms.push_back(1.0);
            observations.push_back(std::move(observation));
        }
        models.push_back(fit_model(mesh, std::move(terms), observations, Differences::relative));
    }
    return models;
}

void model_mesh(const Mesh& mesh, const Options& options) {
    std::vector<Transform> poses;
    for (const ProfileRun& profile : chosen_profiles(options.profiles)) {
        const BlobsOfMesh baked(mesh, profile, options.bits);
        if (poses.empty()) {
            const Blob& blob = baked.blobs().front();
            poses = some_poses(mesh, options.poses, seed, [&](const Transform& pose) {
                return overlaps(blob, {blob, pose}, unlimited).yes();
            });
        }
        for (const PairQuery& query : queries) {
            const std::vector<Model> models = measure(query, mesh.name, baked.blobs(), poses, options.repetitions);
            if (options.json) {
                print_json(models, [&](const std::string& measures) {
                    JsonObject row = guide_row(measures, mesh.name, mesh.triangles.size());
                    row.add("query", std::string(query.name));
                    row.add("profile", std::string(profile.name));
                    return row;
                });
            } else {
                std::printf("%s, %s, %s:\n", mesh.name.c_str(), profile.name, query.name);
                for (const Model& model : models) print_text(model, "a pose");
            }
            std::fflush(stdout);
        }
    }
}

}  // namespace

void model_pairs(const std::vector<std::string>& meshes, const Options& options) {
    if (!options.json)
        std::printf(
            "Nv: pairs of boxes visited; Np: pairs of triangles in the leaves that were compared; Nl: pairs of these\n"
            "leaves. Nu is 0: Nv includes that a box is placed beside another.\n");
    for (const std::string& path : meshes) model_mesh(tests::read_mesh(path), options);
}

}  // namespace espalier::bench
