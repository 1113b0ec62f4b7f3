// How the work of a query grows with the number of triangles: the loop over all of them beside a hierarchy, for a ray
// and for two meshes. One thread; one JSON object a line.
#include "../study/study.hpp"

namespace espalier::bench {
namespace {

struct Options {
    unsigned sizes = 9;                   ///< each has four times the triangles of the one before
    std::size_t most_pairs = 70'000'000;  ///< that the loop over all pairs tests
    std::size_t most_tests = 20'000'000;  ///< of triangles by the rays of a loop
    std::size_t rays = 2'000;
    std::size_t rounds = 5;
};

/// A torus at its own size, and the way from its middle into its tube: a copy moved along it is a link of a chain.
struct Torus {
    explicit Torus(unsigned across) : mesh(tests::make_torus(2 * across, across, 2.0, 0.7)) {
        mesh.name = "torus";
        built = build_tree_and_blob(mesh, 4);
        // A quarter turn about x, and so far that the tubes just cross.
        linked.rotation = {std::sqrt(0.5f), 0.0f, 0.0f, std::sqrt(0.5f)};
        linked.translation = {1.37f, 0.11f, 0.07f};
    }
    Mesh mesh;
    TreeAndBlob built;
    Transform linked;
};

struct Method {
    std::string name;
    std::function<double(std::size_t query)> answer;
    std::size_t queries;  ///< the first ones; 0: too costly
    Timed<double, RayWork> timed = {};
};

/// Measures the methods in turn. Throws std::runtime_error if one has another answer than the hierarchy of the bench.
void measure(const std::string& measures, const Torus& torus, std::vector<Method> methods, const Options& options) {
    std::erase_if(methods, [](const Method& method) { return method.queries == 0; });
    for (std::size_t round = 0; round < options.rounds; ++round)
        for (Method& method : methods) {
            std::vector<std::size_t> queries(method.queries);
            std::iota(queries.begin(), queries.end(), std::size_t{0});
            method.timed.make_round(queries, [&](std::size_t query, RayWork&) { return method.answer(query); });
        }
    for (const Method& method : methods) {
        if (method.name == "loop" && method.timed.differing(methods.front().timed) > 0)
            throw std::runtime_error(measures + ": the loop and the hierarchy have different answers");
        JsonObject row = guide_row(measures, torus.mesh.name, torus.mesh.triangles.size());
        row.add("method", method.name);
        row.add("queries", method.queries);
        row.add("rounds", options.rounds);
        add_spread(row, "ns", method.timed.nanoseconds, 1);
        row.print();
    }
}

void measure_rays(const Torus& torus, const Options& options) {
    const std::vector<Ray> rays = incoherent_rays(torus.mesh, options.rays, seed);
    const AabbTree& tree = torus.built.tree;
    const Blob& blob = torus.built.baked.blob;
    RayWalk walk(tree);
    RayWork work;
    measure("growth of rays", torus,
            {{"hierarchy", [&](std::size_t i) { return walk.closest(RayOrder::nearest_first, rays[i], work); },
              rays.size()},
             {"loop", [&](std::size_t i) { return closest_of_all(tree.triangles, rays[i]); },
              std::min(rays.size(), options.most_tests / tree.triangles.size())},
             {"espalier", [&](std::size_t i) { return static_cast<double>(raycast(blob, rays[i]).t); }, rays.size()}},
            options);
}

void measure_pairs(const Torus& torus, const Options& options) {
    const AabbTree& tree = torus.built.tree;
    const Blob& blob = torus.built.baked.blob;
    const std::size_t triangles = tree.triangles.size();
    PairWalk walk(tree, tree);
    const auto by_hierarchy = [&](std::size_t) {
        return static_cast<double>(walk.run(PairRule::all_children, PairQuestion::all, Placement(torus.linked)).pairs);
    };
    const auto by_loop = [&](std::size_t) {
        return static_cast<double>(test_all_pairs(tree, tree, Placement(torus.linked)).pairs);
    };
    const auto by_espalier = [&](std::size_t) { return static_cast<double>(count_contacts(blob, torus.linked)); };
    measure("growth of pairs", torus,
            {{"hierarchy", by_hierarchy, 1},
             {"loop", by_loop, triangles * triangles <= options.most_pairs ? std::size_t{1} : std::size_t{0}},
             {"espalier", by_espalier, 1}},
            options);
}

}  // namespace

const Subcommand subcommand("growth", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_study growth", "How a query's time grows with the number of triangles; JSON");
    program.allow_no_meshes();
    program.add_number("--sizes", options.sizes, 1u, 10u, "Meshes, each of four times as many triangles");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_count("--rounds", options.rounds, "Rounds in which the methods take turns");
    return program.run(count, words, [&](const std::vector<std::string>&) {
        for (unsigned i = 0; i < options.sizes; ++i) {
            const Torus torus(4u << i);
            measure_rays(torus, options);
            measure_pairs(torus, options);
        }
    });
});

}  // namespace espalier::bench
