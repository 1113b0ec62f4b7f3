// The cost of a ray: Nv nodes visited, Np triangles tested.
#include <cstdio>

#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>

#include "../../tests/support/meshes/files.hpp"
#include "../guide/row.hpp"
#include "../rays.hpp"
#include "blobs.hpp"
#include "groups.hpp"
#include "model.hpp"
#include "options.hpp"

namespace espalier::bench {
namespace {

/// Means of one ray of the group.
struct RayGroup {
    Blob blob;
    std::vector<Ray> rays;
    double nodes = 0.0;
    double leaves = 0.0;
    double groups = 0.0;  ///< of 8 triangles
    double triangles = 0.0;
};

/// What stands for the tested triangles: themselves (the classic Np), the groups of 8 of a leaf that lanes test at
/// once, or the leaves they lie in.
struct RayTerm {
    Term term;
    double RayGroup::*count;
};
constexpr RayTerm ray_terms[] = {{{"Np", "triangle"}, &RayGroup::triangles},
                                 {{"Ng", "group of 8 triangles"}, &RayGroup::groups},
                                 {{"Nl", "leaf"}, &RayGroup::leaves}};

void append_groups(const Blob& blob, const std::vector<Ray>& rays, std::vector<RayGroup>& groups) {
    std::vector<QueryCounters> work(rays.size());
    std::vector<std::uint64_t> nodes, triangles;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        static_cast<void>(raycast(blob, rays[i], work[i]));
        nodes.push_back(work[i].nodes);
        triangles.push_back(work[i].triangles);
    }
    for (const Members& members : group_by_work(nodes, triangles)) {
        RayGroup group;
        group.blob = blob;
        for (const std::uint32_t ray : members) {
            group.rays.push_back(rays[ray]);
            group.nodes += static_cast<double>(work[ray].nodes);
            group.leaves += static_cast<double>(work[ray].leaves);
            group.groups += static_cast<double>(work[ray].groups);
            group.triangles += static_cast<double>(work[ray].triangles);
        }
        for (double* sum : {&group.nodes, &group.leaves, &group.groups, &group.triangles})
            *sum /= static_cast<double>(members.size());
        groups.push_back(std::move(group));
    }
}

std::vector<Model> measure(const Mesh& mesh, const Options& options, const ProfileRun& profile) {
    const BlobsOfMesh baked(mesh, profile, options.bits);
    const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
    std::vector<RayGroup> groups;
    for (const Blob& blob : baked.blobs()) append_groups(blob, rays, groups);
    std::vector<std::size_t> calls;
    for (const RayGroup& group : groups) calls.push_back(group.rays.size());
    const std::vector<double> times = time_in_turns(calls, options.repetitions, false, [&](std::size_t i) {
        unsigned found = 0;
        for (const Ray& ray : groups[i].rays) found += bool(raycast(groups[i].blob, ray));
        return found;
    });
    std::vector<Model> models;
    for (const RayTerm& other : ray_terms) {
        std::vector<Observation> observations;
        for (std::size_t i = 0; i < groups.size(); ++i)
            observations.push_back({{groups[i].nodes, groups[i].*other.count, 1.0}, times[i]});
        models.push_back(fit_model(mesh.name, {{"Nv", "node"}, other.term}, observations, Differences::absolute));
    }
    return models;
}

void print_text(const std::string& mesh, const char* profile, const std::vector<Model>& models) {
    std::printf("%s, %s:\n", mesh.c_str(), profile);
    for (const Model& model : models) print_text(model, "a ray");
    const double node = models[1].fit.coefficients[0], group = models[1].fit.coefficients[1];
    if (node > 0.0 && group >= 0.0)
        std::printf("  RayCosts of collapse.hpp: node_visit 1, leaf_visit 0, leaf_group %.3f\n", group / node);
    else std::printf("  no cost model: a cost came out negative; measure on a quiet machine, with more rays\n");
}

}  // namespace

void model_rays(const std::vector<std::string>& meshes, const Options& options) {
    if (!options.json)
        std::printf(
            "Nv: nodes visited; Np: triangles tested; Ng: groups of 8 of them in a leaf; Nl: leaves visited; all\n"
            "counted by the scalar path. Nu is 0: a ray updates no boxes.\n");
    for (const std::string& path : meshes) {
        const Mesh mesh = tests::read_mesh(path);
        for (const ProfileRun& profile : chosen_profiles(options.profiles)) {
            const std::vector<Model> models = measure(mesh, options, profile);
            if (options.json) {
                print_json(models, [&](const std::string& measures) {
                    JsonObject row = guide_row(measures, mesh.name, mesh.triangles.size());
                    row.add("query", std::string("raycast"));
                    row.add("profile", std::string(profile.name));
                    return row;
                });
            } else {
                print_text(mesh.name, profile.name, models);
            }
            std::fflush(stdout);
        }
    }
}

}  // namespace espalier::bench
