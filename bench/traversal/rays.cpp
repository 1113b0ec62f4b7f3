// Rays through the tree by each order of children.
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>

#include "../deformation/processor_time.hpp"
#include "../deformation/spread.hpp"
#include "../guide/row.hpp"
#include "../rays.hpp"
#include "ray_walk.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

constexpr std::uint64_t seed = 2026;

/// A way to find the closest hits of all rays, and what it took.
struct Run {
    std::string order;
    std::function<double(const Ray& ray, RayWork& work)> closest;
    RayWork work;
    std::vector<double> answers;      ///< t of each ray's closest hit
    std::vector<double> nanoseconds;  ///< of a ray, in each round
};

std::vector<Run> all_runs(RayWalk& walk, const Blob& blob) {
    std::vector<Run> runs;
    for (const RayOrder order : all_ray_orders)
        runs.push_back({std::string(name_of(order)),
                        [&walk, order](const Ray& ray, RayWork& work) { return walk.closest(order, ray, work); },
                        {},
                        {},
                        {}});
    runs.push_back({"espalier",
                    [&blob](const Ray& ray, RayWork&) { return static_cast<double>(raycast(blob, ray).t); },
                    {},
                    {},
                    {}});
    return runs;
}

void make_round(std::vector<Run>& runs, const std::vector<Ray>& rays) {
    for (Run& run : runs) {
        run.work = {};
        run.answers.resize(rays.size());
        const ProcessorTime time;
        for (std::size_t i = 0; i < rays.size(); ++i) run.answers[i] = run.closest(rays[i], run.work);
        run.nanoseconds.push_back(1e9 * time.seconds() / static_cast<double>(rays.size()));
    }
}

std::size_t count_hits(const Run& run) {
    std::size_t hits = 0;
    for (const double t : run.answers) hits += std::isfinite(t) ? 1u : 0u;
    return hits;
}

void print(const Subject& subject, const Run& run) {
    const auto count = static_cast<double>(run.answers.size());
    const bool is_ours = run.order == "espalier";
    JsonObject row = guide_row("traversal rays", subject.mesh.name, subject.built.tree.triangles.size());
    row.add("order", run.order);
    row.add("rays", run.answers.size());
    row.add("hits", count_hits(run));
    row.add("box_tests", static_cast<double>(run.work.box_tests) / count, 2);
    row.add("triangle_tests", static_cast<double>(run.work.triangle_tests) / count, 2);
    row.add("skipped", is_ours ? std::nullopt : std::optional(static_cast<double>(run.work.skipped) / count), 2);
    add_spread(row, "ns", run.nanoseconds, 1);
    row.print();
}

}  // namespace

void measure_rays(const Subject& subject, const TraversalOptions& options) {
    const std::vector<Ray> rays = incoherent_rays(subject.mesh, options.rays, seed);
    RayWalk walk(subject.built.tree);
    std::vector<Run> runs = all_runs(walk, subject.blob);
    for (std::size_t round = 0; round < options.rounds; ++round) make_round(runs, rays);
    for (const Run& run : runs)
        if (&run != &runs.back() && run.answers != runs.front().answers)
            throw std::runtime_error(subject.mesh.name + ": the order " + run.order + " has other answers than " +
                                     runs.front().order);
    QueryCounters counters;
    for (const Ray& ray : rays) static_cast<void>(raycast(subject.blob, ray, counters));
    runs.back().work = {counters.nodes, counters.triangles, 0};
    for (const Run& run : runs) print(subject, run);
    std::fflush(stdout);
}

}  // namespace espalier::bench
