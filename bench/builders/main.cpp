// What each builder costs and brings: bytes, visits of a random ray (counted, the same on every machine) and seconds.
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <baker/bake_with.hpp>
#include <baker/build/build.hpp>
#include <baker/optimise/reinsertion.hpp>
#include <espalier/blob.hpp>
#include <espalier/statistics.hpp>

#include "../../tests/support/meshes/files.hpp"
#include "../program.hpp"
#include "../rays.hpp"
#include "textbook.hpp"

namespace {

using namespace espalier;
using namespace espalier::bench;

constexpr std::uint64_t seed = 2026;

struct NamedBuilder {
    std::string name;
    std::function<baker::BinaryTree(const baker::LatticeMesh&, const baker::BuildSettings&)> build;
};

std::vector<NamedBuilder> all_builders(bool with_textbook) {
    std::vector<NamedBuilder> builders;
    const auto shipped = [&](const char* name, Builder builder) {
        builders.push_back({name, [builder](const auto& mesh, const auto& settings) {
                                return baker::build(mesh, builder, settings);
                            }});
    };
    shipped("binned_sah", Builder::binned_sah);
    shipped("sweep_sah", Builder::sweep_sah);
    shipped("spatial_splits", Builder::spatial_splits);
    shipped("agglomerative", Builder::agglomerative);
    shipped("linear", Builder::linear);
    shipped("insertion", Builder::insertion);
    if (!with_textbook) return builders;
    const auto textbook = [&](const char* name, Textbook rule) {
        builders.push_back(
            {name, [rule](const auto& mesh, const auto& settings) { return build_textbook(mesh, rule, settings); }});
    };
    textbook("object median", Textbook::object_median);
    textbook("object mean", Textbook::object_mean);
    textbook("spatial median", Textbook::spatial_median);
    textbook("minimum sum", Textbook::minimum_sum);
    textbook("minimum of the maximum", Textbook::minimum_maximum);
    textbook("minimum intersection", Textbook::minimum_intersection);
    textbook("maximum separation", Textbook::maximum_separation);
    return builders;
}

/// The surface area heuristic's cost of the binary tree: nodes with children that a random line through the root's box
/// is expected to meet.
double expected_nodes(const baker::BinaryTree& tree) {
    double sum = 0.0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        if (!tree.nodes[i].is_leaf()) sum += tree.nodes[i].half_area();
    }
    return tree.node_count() == 0 ? 0.0 : sum / tree.nodes[0].half_area();
}

Effort value_of(const std::string& name) {
    return name == "fast" ? Effort::fast : name == "normal" ? Effort::normal : Effort::best;
}

void measure(const Mesh& mesh, const NamedBuilder& named, const std::string& effort_name,
             const std::vector<Ray>& rays) {
    BakeOptions options;
    options.profile = Profile::fast;  // the one that every builder's tree fits
    const Effort effort = value_of(effort_name);
    options.effort = effort;
    double cost = 0.0;
    const auto make_tree = [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        auto tree = baker::optimise(named.build(lattice_mesh, settings), baker::optimise_settings(effort));
        cost = expected_nodes(tree);
        return tree;
    };
    const MeshView view = mesh.view();
    const auto baked = baker::bake_with(make_tree, {&view, 1}, options);
    if (!baked) throw std::runtime_error(baked.message);
    const Blob blob = open(baked.bytes);
    if (!blob) throw std::runtime_error(std::string("what was baked does not open: ") + describe(blob.status()));
    QueryCounters counters;
    for (const Ray& ray : rays) static_cast<void>(raycast(blob, ray, counters));
    const auto per_ray = [&](std::uint64_t count) {
        return static_cast<double>(count) / static_cast<double>(rays.size());
    };
    std::printf("| %s | %s | %s | %.2f | %.1f | %.2f | %.2f | %.1f | %.3f |\n", mesh.name.c_str(), named.name.c_str(),
                effort_name.c_str(),
                static_cast<double>(baked.bytes.size()) / static_cast<double>(baked.report.tree.triangles), cost,
                per_ray(counters.nodes), per_ray(counters.leaves), per_ray(counters.triangles), baked.report.seconds);
    std::fflush(stdout);
}

struct Options {
    std::vector<std::string> efforts{"fast", "normal"};
    std::size_t rays = 100'000;
    bool with_textbook = true;
};

void run(const std::vector<std::string>& files, const Options& options) {
    std::printf(
        "| mesh | builder | effort | bytes/triangle | expected binary nodes | nodes/ray | leaves/ray | triangles/ray | "
        "bake s |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& file : files) {
        const Mesh mesh = tests::read_mesh(file);
        const std::vector<Ray> rays = incoherent_rays(mesh, options.rays, seed);
        for (const std::string& effort : options.efforts) {
            for (const NamedBuilder& named : all_builders(options.with_textbook)) measure(mesh, named, effort, rays);
        }
    }
}

}  // namespace

int main(int count, char** words) {
    Options options;
    Program program("espalier_bench_builders",
                    "What each builder's tree costs rays, profile fast, counted; a table in Markdown");
    program.add_choices("--effort", options.efforts, {"fast", "normal", "best"},
                        "Of the build; fast is without reinsertion; may be repeated");
    program.add_count("--rays", options.rays, "Incoherent rays");
    program.add_flag("--shipped{false}", options.with_textbook, "Without the builders from the textbook");
    return program.run(count, words, [&](const std::vector<std::string>& meshes) { run(meshes, options); });
}
