#include "bakes.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include <baker/bake_with.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "../deformation/processor_time.hpp"
#include "../deformation/spread.hpp"

namespace espalier::bench {
namespace {

constexpr double shortest_building = 0.1;  // seconds, or the first builds, into cold memory, would count too much
constexpr double longest_building = 1.5;

BakeOptions bake_options() {
    BakeOptions options;
    options.profile = Profile::fast;  // the one that every builder's tree fits
    options.effort = Effort::normal;
    options.threads = 1;
    return options;
}

BakeResult bake_or_throw(const tests::Mesh& mesh, const baker::TreeMaker& make_tree) {
    const MeshView view = mesh.view();
    BakeResult baked = baker::bake_with(make_tree, {&view, 1}, bake_options());
    if (!baked) throw std::runtime_error(mesh.name + ": " + baked.message);
    return baked;
}

baker::BinaryTree copy_of(const baker::BinaryTree& tree) {
    baker::BinaryTree copy;
    copy.nodes = std::make_unique_for_overwrite<baker::BinaryNode[]>(tree.node_count());
    std::copy_n(tree.nodes.get(), tree.node_count(), copy.nodes.get());
    copy.triangles = tree.triangles;
    return copy;
}

}  // namespace

Bakes::Bakes(tests::Mesh mesh) : mesh_(std::move(mesh)) {
    static_cast<void>(
        bake_or_throw(mesh_, [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
            lattice_mesh_ = lattice_mesh;
            settings_ = settings;
            return baker::build(lattice_mesh, Builder::binned_sah, settings);
        }));
    settings_.progress = {};
    if (lattice_mesh_.triangles.empty()) throw std::runtime_error(mesh_.name + ": there are no triangles");
}

TimedTree Bakes::build(const NamedBuilder& builder, std::size_t rounds) const {
    TimedTree built;
    std::vector<double> seconds;
    double sum = 0.0;
    while (seconds.empty() || (sum < longest_building && (seconds.size() < rounds || sum < shortest_building))) {
        const ProcessorTime time;
        built.tree = builder.build(lattice_mesh_, settings_);
        seconds.push_back(time.seconds());
        sum += seconds.back();
    }
    built.seconds = median_of(seconds);
    return built;
}

TimedTree Bakes::reinsert(const baker::BinaryTree& tree) const {
    TimedTree moved;
    baker::BinaryTree copy = copy_of(tree);
    const ProcessorTime time;
    moved.tree = baker::optimise(std::move(copy), baker::optimise_settings(Effort::normal));
    moved.seconds = time.seconds();
    return moved;
}

BuiltBlob Bakes::bake(const baker::BinaryTree& tree) const {
    BuiltBlob built;
    baker::BinaryTree given = copy_of(tree);
    const ProcessorTime time;
    BakeResult baked = bake_or_throw(mesh_, [&](const auto&, const auto&) { return std::move(given); });
    built.seconds = time.seconds();
    built.bytes = std::move(baked.bytes);
    built.blob = open(built.bytes);
    if (!built.blob)
        throw std::runtime_error(mesh_.name + ": what was baked does not open: " + describe(built.blob.status()));
    return built;
}

}  // namespace espalier::bench
