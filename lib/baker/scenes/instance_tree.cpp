#include <baker/scenes/instance_tree.hpp>

#include <algorithm>

#include <espalier/format.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/build/build.hpp>
#include <baker/collapse/collapse.hpp>
#include <baker/optimise/reinsertion.hpp>

namespace espalier::baker {

namespace {

namespace layout = format::packed_node;

constexpr OptimiseSettings one_pass_over_instances = {.passes = 1, .least_triangles = 1};

/// Returns those of packed nodes. A byte has no price: the nodes are few beside the meshes.
CollapseSettings collapse_settings() {
    CollapseSettings settings;
    settings.profile = Profile::balanced;
    settings.byte_price = 0.0f;
    settings.max_leaf_triangles = 1;
    return settings;
}

/// Returns a mesh with one triangle for each box, from corner to corner: builders need no more of a triangle than its
/// box.
LatticeMesh mesh_of(std::span<const ChildBox> boxes) {
    LatticeMesh mesh;
    mesh.lattice.bits = format::scene::bits;
    for (const ChildBox& box : boxes) {
        const auto corner = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back({box.lo[0], box.lo[1], box.lo[2]});
        mesh.vertices.push_back({box.hi[0], box.hi[1], box.hi[2]});
        mesh.triangles.push_back({{corner, corner + 1, corner}, corner / 2});
    }
    return mesh;
}

/// A leaf is an instance, whatever its box.
class InstanceLeaves final : public LeafSizes {
public:
    [[nodiscard]] LeafSize of(const BinaryNode&, unsigned) const override {
        return {true, 1, format::scene::instance_bytes};
    }
    [[nodiscard]] unsigned most_triangles() const override { return 1; }
    [[nodiscard]] float byte_weight() const override { return 1.0f; }
};

class TreeWriter {
public:
    TreeWriter(std::span<const ChildBox> boxes, const BinaryTree& binary, const CollapsePlan& plan)
        : boxes_(boxes), binary_(binary), plan_(plan) {}

    InstanceTree write() {
        tree_.nodes.resize(layout::bytes);
        put(0, 0, 1);
        return std::move(tree_);
    }

private:
    [[nodiscard]] std::uint32_t instance_of(std::uint32_t binary_node) const {
        return binary_.triangles[binary_.nodes[binary_node].first];
    }
    [[nodiscard]] ChildBox box_of(std::uint32_t binary_node) const {
        const BinaryNode& node = binary_.nodes[binary_node];
        if (node.is_leaf()) return boxes_[instance_of(binary_node)];
        ChildBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = static_cast<std::int32_t>(node.lo[k]);
            box.hi[k] = static_cast<std::int32_t>(node.hi[k]);
        }
        return box;
    }

    /// Writes node `number` and all below it.
    void put(std::size_t number, std::uint32_t binary_node, unsigned depth) {
        tree_.depth = std::max(tree_.depth, depth);
        Children children = plan_.children_of(binary_node, format::max_depth + 1 - depth);
        const std::span<Child> list = children.list();
        const auto leaves_begin =
            std::stable_partition(list.begin(), list.end(), [](const Child& child) { return !child.is_leaf; });
        const auto nodes = static_cast<std::size_t>(leaves_begin - list.begin());
        const std::size_t leaves = list.size() - nodes, first_child = tree_.nodes.size() / layout::bytes;
        std::vector<ChildBox> boxes;
        for (const Child& child : list) boxes.push_back(box_of(child.binary_node));
        std::byte* const bytes = tree_.nodes.data() + number * layout::bytes;
        put_packed_boxes(boxes, format::scene::bits, bytes);
        set_u32(bytes + layout::children_at,
                static_cast<std::uint32_t>((nodes == 0 ? 0 : first_child) | nodes << 24 | leaves << 28));
        if (leaves != 0) set_u32(bytes + layout::leaf_block_at, static_cast<std::uint32_t>(tree_.order.size()));
        for (const Child& leaf : list.subspan(nodes)) tree_.order.push_back(instance_of(leaf.binary_node));
        tree_.nodes.resize(tree_.nodes.size() + nodes * layout::bytes);
        for (std::size_t i = 0; i < nodes; ++i) put(first_child + i, list[i].binary_node, depth + 1);
    }

    std::span<const ChildBox> boxes_;
    const BinaryTree& binary_;
    const CollapsePlan& plan_;
    InstanceTree tree_;
};

}  // namespace

InstanceTree build_instance_tree(std::span<const ChildBox> boxes) {
    if (boxes.empty()) return {};
    const LatticeMesh mesh = mesh_of(boxes);
    const BinaryTree binary =
        optimise(build(mesh, Builder::binned_sah, build_settings(Effort::normal, 1)), one_pass_over_instances);
    const CollapsePlan plan(mesh, binary, InstanceLeaves(), collapse_settings());
    return TreeWriter(boxes, binary, plan).write();
}

}  // namespace espalier::baker
