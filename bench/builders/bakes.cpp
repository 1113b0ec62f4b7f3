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

/// Whether the blob touches a second one of its kind in the pose. Throws where the query is refused.
bool touches(const Blob& blob, const Transform& pose, PairCounters& counters) {
    const PairContact contact = first_contact(blob, {blob, pose}, WorkLimit::unlimited(), counters);
    if (is_refused(contact.status)) throw std::runtime_error(describe(contact.status));
    return static_cast<bool>(contact);
}
bool touches(const Blob& blob, const Transform& pose) {
    PairCounters unused;
    return touches(blob, pose, unused);
}

}  // namespace

Queries::Queries(const tests::Mesh& mesh, const Blob& blob, const QueryCounts& counts)
    : rays_(incoherent_rays(mesh, counts.rays, seed)),
      poses_(some_poses(mesh, counts.poses, seed, [&](const Transform& pose) { return touches(blob, pose); })) {}

Work Queries::count(const Blob& blob) const {
    Work work;
    for (const Ray& ray : rays_) {
        const RayHit hit = raycast(blob, ray, work.rays);
        work.answers = 31 * work.answers + (hit ? std::bit_cast<std::uint32_t>(hit.t) : 1);
    }
    for (const Transform& pose : poses_) {
        const bool is_touching = touches(blob, pose, work.pairs);
        work.answers = 31 * work.answers + (is_touching ? 1 : 0);
        work.touching_poses += is_touching ? 1 : 0;
    }
    return work;
}

Seconds Queries::time(const Blob& blob) const {
    Seconds seconds;
    const ProcessorTime ray_time;
    for (const Ray& ray : rays_) static_cast<void>(raycast(blob, ray));
    seconds.rays = ray_time.seconds();
    const ProcessorTime pair_time;
    for (const Transform& pose : poses_) static_cast<void>(touches(blob, pose));
    seconds.pairs = pair_time.seconds();
    return seconds;
}

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
