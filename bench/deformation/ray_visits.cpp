// Rays into a mesh that has moved. All trees have the same lattice and the same triangles, so their hits are the same.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include <espalier/espalier.hpp>
#include <espalier/statistics.hpp>

#include "deformable_mesh.hpp"
#include "processor_time.hpp"
#include "spread.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

/// A tree and what rays cost in it.
struct Run {
    std::string tree;
    const Blob* blob;
    std::vector<Ray> rays;
    std::optional<float> quality = std::nullopt;    ///< of the refit
    std::optional<Transform> place = std::nullopt;  ///< rays are moved to local space
    QueryCounters counters = {};
    std::vector<float> hits = {};
    std::vector<double> nanoseconds = {};

    [[nodiscard]] std::size_t hit_count() const {
        return static_cast<std::size_t>(
            std::count_if(hits.begin(), hits.end(), [](float hit) { return hit != INFINITY; }));
    }
    [[nodiscard]] Ray local(const Ray& ray) const { return place ? to_local(*place, ray) : ray; }
};

void count(Run& run) {
    for (const Ray& ray : run.rays) {
        const RayHit hit = raycast(*run.blob, run.local(ray), run.counters);
        run.hits.push_back(hit ? hit.t : INFINITY);
    }
}

void measure_time(Run& run) {
    std::size_t found = 0;
    const ProcessorTime time;
    for (const Ray& ray : run.rays)
        if (raycast(*run.blob, run.local(ray))) ++found;
    run.nanoseconds.push_back(1e9 * time.seconds() / static_cast<double>(run.rays.size()));
    if (found != run.hit_count()) throw std::runtime_error(run.tree + ": the counted rays have other hits");
}

std::size_t differing(const Run& run, const Run& reference) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < run.hits.size(); ++i)
        if (run.hits[i] != reference.hits[i]) ++count;
    return count;
}

void print(const Subject& subject, Motion motion, const Run& run, const Run& reference) {
    const auto per_ray = [&](std::uint64_t total) {
        return static_cast<double>(total) / static_cast<double>(run.rays.size());
    };
    JsonObject row = subject.row("rays");
    row.add("motion", std::string(name_of(motion)));
    row.add("tree", run.tree);
    row.add("rays", run.rays.size());
    row.add("hit_fraction", per_ray(run.hit_count()), 4);
    row.add("quality", run.quality ? std::optional(static_cast<double>(*run.quality)) : std::nullopt, 3);
    row.add("nodes_per_ray", per_ray(run.counters.nodes), 3);
    row.add("leaves_per_ray", per_ray(run.counters.leaves), 3);
    row.add("triangles_per_ray", per_ray(run.counters.triangles), 3);
    add_spread(row, "ns_per_ray", run.nanoseconds, 2);
    row.add("times_bake_nodes",
            reference.counters.nodes == 0 ? std::nullopt
                                          : std::optional(static_cast<double>(run.counters.nodes) /
                                                          static_cast<double>(reference.counters.nodes)),
            3);
    row.add("rays_that_differ", differing(run, reference));
    row.print();
}

/// The trees that stay the same for all motions.
struct StandingTrees {
    explicit StandingTrees(const Subject& subject) : rest(subject.rest(), options(subject)) {
        DeformableOptions with_poses = options(subject);
        for (const Motion motion : deforming) with_poses.poses.push_back(subject.moving().positions(motion, 1.0));
        all_poses = std::make_unique<DeformableMesh>(subject.rest(), with_poses);
    }
    static DeformableOptions options(const Subject& subject) {
        return {.range = subject.range(), .bits = subject.options().bits};
    }
    DeformableMesh rest;
    std::unique_ptr<DeformableMesh> all_poses;
};

void measure(const Subject& subject, StandingTrees& trees, Motion motion) {
    const Mesh posed = subject.moving().posed(motion, 1.0);
    const std::vector<Ray> rays = incoherent_rays(posed, subject.options().rays, deformation_seed);
    DeformableOptions with_pose = StandingTrees::options(subject);
    with_pose.poses.push_back(posed.positions);
    DeformableMesh one_pose(subject.rest(), with_pose);
    const DeformableMesh baked(posed, StandingTrees::options(subject));
    const DeformableMesh unmoved(subject.rest(), StandingTrees::options(subject));

    std::vector<Run> runs;
    runs.push_back({"bake", &baked.blob(), rays});
    runs.push_back({"rest", &trees.rest.blob(), rays, trees.rest.move(posed.positions)});
    runs.push_back({"pose", &one_pose.blob(), rays, one_pose.move(posed.positions)});
    runs.push_back({"all poses", &trees.all_poses->blob(), rays, trees.all_poses->move(posed.positions)});
    if (motion == Motion::turn)
        runs.push_back({"moved rays", &unmoved.blob(), rays, std::nullopt, subject.moving().turned(1.0)});
    for (Run& run : runs) count(run);
    for (std::size_t round = 0; round < subject.options().rounds; ++round)
        for (Run& run : runs) measure_time(run);
    for (const Run& run : runs) print(subject, motion, run, runs.front());
    std::fflush(stdout);
}

}  // namespace

void measure_rays(const Subject& subject) {
    StandingTrees trees(subject);
    for (const Motion motion : deforming) measure(subject, trees, motion);
    measure(subject, trees, Motion::turn);
}

}  // namespace espalier::bench
