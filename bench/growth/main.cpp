// How the work of a query grows with the number of triangles: the loop over all of them beside a hierarchy, for a ray
// and for two meshes. One thread; one JSON object a line.
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>

#include "../../tests/support/meshes/makers.hpp"
#include "../deformation/processor_time.hpp"
#include "../deformation/spread.hpp"
#include "../guide/row.hpp"
#include "../program.hpp"
#include "../traversal/pair_walk.hpp"
#include "../traversal/ray_walk.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

constexpr std::uint64_t seed = 2026;

struct Options {
    unsigned sizes = 9;                   ///< each has four times the triangles of the one before
    std::size_t most_pairs = 70'000'000;  ///< that the loop over all pairs tests
    std::size_t most_tests = 20'000'000;  ///< of triangles by the rays of a loop
    std::size_t rays = 2'000;
    std::size_t rounds = 5;
};

/// A torus, and the way from its middle into its tube: a copy moved along it is a link of a chain.
struct Torus {
    Mesh mesh;
    TreeAndBlob built;
    Blob blob;
    Transform linked;
};

Torus make_subject(unsigned across) {
    Torus torus;
    torus.mesh = tests::make_torus(2 * across, across, 2.0, 0.7);
    torus.mesh.name = "torus";
    torus.built = build_tree_and_blob(torus.mesh, 4);
    torus.blob = open(torus.built.blob);
    if (!torus.blob) throw std::runtime_error(describe(torus.blob.status()));
    // A quarter turn about x, and so far that the tubes just cross.
    torus.linked.rotation = {std::sqrt(0.5f), 0.0f, 0.0f, std::sqrt(0.5f)};
    torus.linked.translation = {1.37f, 0.11f, 0.07f};
    return torus;
}

struct Run {
    std::string method;
    std::function<double(std::size_t query)> answer;
    std::size_t queries;  ///< 0: too costly
    std::vector<double> answers;
    std::vector<double> nanoseconds;
};

void measure_round(Run& run) {
    run.answers.clear();
    const ProcessorTime time;
    for (std::size_t query = 0; query < run.queries; ++query) run.answers.push_back(run.answer(query));
    run.nanoseconds.push_back(1e9 * time.seconds() / static_cast<double>(run.queries));
}

/// Measures the methods in turn. Throws std::runtime_error if one has another answer than the hierarchy of the bench.
void measure(const std::string& measures, const Torus& torus, std::vector<Run> runs, const Options& options) {
    std::erase_if(runs, [](const Run& run) { return run.queries == 0; });
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (Run& run : runs) measure_round(run);
    const Run& reference = runs.front();
    for (const Run& run : runs) {
        for (std::size_t i = 0; i < run.answers.size() && run.method == "loop"; ++i)
            if (run.answers[i] != reference.answers[i])
                throw std::runtime_error(measures + ": the loop and the hierarchy have different answers");
        JsonObject row = guide_row(measures, torus.mesh.name, torus.mesh.triangles.size());
        row.add("method", run.method);
        row.add("queries", run.queries);
        row.add("rounds", options.rounds);
        add_spread(row, "ns", run.nanoseconds, 1);
        row.print();
    }
}

void measure_rays(const Torus& torus, const Options& options) {
    const std::vector<Ray> rays = incoherent_rays(torus.mesh, options.rays, seed);
    const std::size_t triangles = torus.mesh.triangles.size();
    RayWalk walk(torus.built.tree);
    RayWork work;
    measure("growth of rays", torus,
            {{"hierarchy",
              [&](std::size_t i) { return walk.closest(RayOrder::nearest_first, rays[i], work); },
              rays.size(),
              {},
              {}},
             {"loop",
              [&](std::size_t i) { return closest_of_all(torus.built.tree, rays[i]); },
              std::min(rays.size(), options.most_tests / triangles),
              {},
              {}},
             {"espalier",
              [&](std::size_t i) { return static_cast<double>(raycast(torus.blob, rays[i]).t); },
              rays.size(),
              {},
              {}}},
            options);
}

void measure_pairs(const Torus& torus, const Options& options) {
    const AabbTree& tree = torus.built.tree;
    const std::size_t triangles = torus.mesh.triangles.size();
    PairWalk walk(tree, tree);
    const auto placement = [&] { return Placement(torus.linked); };
    const auto contacts = [&] {
        double pairs = 0.0;
        const QueryStatus status = for_each_contact(
            torus.blob, {torus.blob, torus.linked}, [&](const PairContact&) { ++pairs; }, WorkLimit::unlimited());
        if (is_refused(status)) throw std::runtime_error(describe(status));
        return pairs;
    };
    measure("growth of pairs", torus,
            {{"hierarchy",
              [&](std::size_t) {
                  return static_cast<double>(walk.run(PairRule::all_children, PairQuestion::all, placement()).pairs);
              },
              1,
              {},
              {}},
             {"loop",
              [&](std::size_t) { return static_cast<double>(test_all_pairs(tree, tree, placement()).pairs); },
              triangles * triangles <= options.most_pairs ? std::size_t{1} : std::size_t{0},
              {},
              {}},
             {"espalier", [&](std::size_t) { return contacts(); }, 1, {}, {}}},
            options);
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_growth", "How a query's time grows with the number of triangles; JSON");
    program.allow_no_meshes();
    program.add_number("--sizes", options.sizes, 1u, 10u, "Meshes, each of four times as many triangles");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--rounds", options.rounds, "Rounds in which the methods take turns");
    return program.run(count, words, [&](const std::vector<std::string>&) {
        for (unsigned i = 0; i < options.sizes; ++i) {
            const Torus torus = make_subject(4u << i);
            measure_rays(torus, options);
            measure_pairs(torus, options);
        }
    });
}
