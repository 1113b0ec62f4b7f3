#include "bakes.hpp"

#include <baker/bake_with.hpp>
#include <baker/optimise/reinsertion.hpp>

namespace espalier::bench {
namespace {

double volume(const baker::BinaryNode& node) {
    double product = 1.0;
    for (int axis = 0; axis < 3; ++axis) product *= double(node.hi[axis]) - double(node.lo[axis]);
    return product;
}

unsigned height(const baker::BinaryTree& tree, std::size_t node) {
    if (tree.nodes[node].is_leaf()) return 0;
    return 1 + std::max(height(tree, baker::BinaryTree::left_of(node)), height(tree, tree.right_of(node)));
}

}  // namespace

BinaryTreeQuality quality_of(const baker::BinaryTree& tree) {
    BinaryTreeQuality quality;
    double volumes = 0.0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const baker::BinaryNode& node = tree.nodes[i];
        (node.is_leaf() ? quality.leaf_areas : quality.inner_areas) += node.half_area();
        volumes += volume(node);
    }
    const baker::BinaryNode& root = tree.nodes[0];
    quality.inner_areas /= root.half_area();
    quality.leaf_areas /= root.half_area();
    if (volume(root) > 0.0) quality.volumes = volumes / volume(root);
    quality.height = height(tree, 0);
    return quality;
}

namespace {

constexpr double shortest_building = 0.1;  // seconds, or the first builds, into cold memory, would count too much
constexpr double longest_building = 1.5;

/// In the profile that every builder's tree fits.
BakedBlob bake_with(const tests::Mesh& mesh, const baker::TreeMaker& make_tree) {
    const MeshView view = mesh.view();
    return opened(mesh.name, baker::bake_with(make_tree, {&view, 1}, {.profile = Profile::fast}));
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
        bake_with(mesh_, [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
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

TimedBlob Bakes::bake(const baker::BinaryTree& tree) const {
    baker::BinaryTree given = copy_of(tree);
    const ProcessorTime time;
    TimedBlob built{bake_with(mesh_, [&](const auto&, const auto&) { return std::move(given); })};
    built.seconds = time.seconds();
    return built;
}

}  // namespace espalier::bench
