#include "aabb_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <baker/bake_with.hpp>
#include <baker/build/build.hpp>
#include <baker/optimise/reinsertion.hpp>

#include "../deformation/processor_time.hpp"

namespace espalier::bench {
namespace {

/// The share of the largest coordinate by which a box is larger than its triangles.
constexpr float margin_share = 0x1p-19f;

float largest_coordinate(const Mesh& mesh) {
    float largest = 0.0f;
    for (const Vec3& p : mesh.positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return largest;
}

class Maker {
public:
    Maker(const Mesh& mesh, const baker::LatticeMesh& lattice_mesh, const baker::BinaryTree& binary, unsigned most)
        : binary_(binary), most_(most) {
        tree_.largest = largest_coordinate(mesh);
        tree_.triangles.reserve(binary.triangles.size());
        for (const std::uint32_t number : binary.triangles) {
            const TriangleVertices& corners = mesh.triangles[lattice_mesh.triangles[number].original_id];
            tree_.triangles.push_back(
                {mesh.positions[corners[0]], mesh.positions[corners[1]], mesh.positions[corners[2]]});
        }
        tree_.nodes.emplace_back();
        fill(0, 0, 0);
    }
    [[nodiscard]] AabbTree take() { return std::move(tree_); }

private:
    void fill(std::size_t index, std::size_t source, unsigned depth) {
        const baker::BinaryNode& node = binary_.nodes[source];
        put_box(tree_.nodes[index], std::span(tree_.triangles).subspan(node.first, node.count));
        tree_.height = std::max(tree_.height, depth);
        if (node.count <= most_) {
            tree_.nodes[index].first = node.first;
            tree_.nodes[index].count = node.count;
            return;
        }
        const std::size_t children = tree_.nodes.size();
        tree_.nodes[index].first = static_cast<std::uint32_t>(children);
        tree_.nodes[index].count = 0;
        tree_.nodes.resize(children + 2);
        fill(children, baker::BinaryTree::left_of(source), depth + 1);
        fill(children + 1, binary_.right_of(source), depth + 1);
    }
    void put_box(AabbNode& node, std::span<const FloatTriangle> triangles) const {
        float low[3], high[3];
        std::fill_n(low, 3, std::numeric_limits<float>::infinity());
        std::fill_n(high, 3, -std::numeric_limits<float>::infinity());
        for (const FloatTriangle& triangle : triangles)
            for (const Vec3& corner : triangle) {
                const float p[3] = {corner.x, corner.y, corner.z};
                for (int k = 0; k < 3; ++k) {
                    low[k] = std::min(low[k], p[k]);
                    high[k] = std::max(high[k], p[k]);
                }
            }
        for (int k = 0; k < 3; ++k) {
            node.center[k] = 0.5f * (low[k] + high[k]);
            node.half[k] = 0.5f * (high[k] - low[k]) + margin_share * tree_.largest;
        }
    }

    const baker::BinaryTree& binary_;
    unsigned most_;
    AabbTree tree_;
};

}  // namespace

TreeAndBlob build_tree_and_blob(const Mesh& mesh, unsigned most_leaf_triangles) {
    TreeAndBlob made;
    const auto make = [&](const baker::LatticeMesh& lattice_mesh, const baker::BuildSettings& settings) {
        const ProcessorTime time;
        baker::BinaryTree binary = baker::optimise(baker::build(lattice_mesh, Builder::binned_sah, settings),
                                                   baker::optimise_settings(Effort::normal));
        if (!binary.triangles.empty()) made.tree = Maker(mesh, lattice_mesh, binary, most_leaf_triangles).take();
        made.tree_seconds = time.seconds();
        return binary;
    };
    BakeOptions options;
    options.profile = Profile::fast;
    options.threads = 1;
    const MeshView view = mesh.view();
    BakeResult baked = baker::bake_with(make, {&view, 1}, options);
    if (!baked) throw std::runtime_error(mesh.name + ": " + baked.message);
    if (made.tree.nodes.empty()) throw std::runtime_error(mesh.name + ": there are no triangles");
    made.blob = std::move(baked.bytes);
    return made;
}

}  // namespace espalier::bench
