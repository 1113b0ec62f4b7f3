#include <baker/collapse/order.hpp>

#include <algorithm>

namespace espalier::baker {

namespace {

class Orderer {
public:
    Orderer(const BinaryTree& tree, const CollapsePlan& plan, const StripMaker* strips, WideTree& wide)
        : tree_(tree), plan_(plan), strips_(strips), wide_(wide) {}

    /// `depth` counts from 1; the recursion goes no deeper than format::max_depth.
    void visit(std::uint32_t binary_node, std::uint32_t number, unsigned depth) {
        Children children = plan_.children_of(binary_node, format::max_depth - depth + 1);
        const auto list = children.list();
        std::sort(list.begin(), list.end(), [&](const Child& a, const Child& b) { return comes_before(a, b); });
        const auto leaf_start =
            std::find_if(list.begin(), list.end(), [](const Child& child) { return child.is_leaf; });

        WideNode node;
        node.node_children = static_cast<std::uint8_t>(leaf_start - list.begin());
        node.leaves = static_cast<std::uint8_t>(list.end() - leaf_start);
        node.first_child = node.node_children == 0 ? 0 : static_cast<std::uint32_t>(wide_.nodes.size());
        node.first_leaf = static_cast<std::uint32_t>(wide_.leaves.size());
        for (std::size_t slot = 0; slot < list.size(); ++slot) node.binary_nodes[slot] = list[slot].binary_node;
        wide_.nodes[number] = node;
        wide_.nodes.resize(wide_.nodes.size() + node.node_children);
        wide_.depth = std::max(wide_.depth, depth);

        for (auto leaf = leaf_start; leaf != list.end(); ++leaf) add_leaf(leaf->binary_node);
        for (std::uint32_t i = 0; i < node.node_children; ++i)
            visit(node.binary_nodes[i], node.first_child + i, depth + 1);
    }

private:
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::uint32_t binary_node) const {
        const BinaryNode& node = tree_.nodes[binary_node];
        return std::span(tree_.triangles).subspan(node.first, node.count);
    }

    /// Triangle numbers ascend with original ids, so that a lower number is a lower id.
    [[nodiscard]] std::uint32_t lowest_triangle(std::uint32_t binary_node) const {
        const auto triangles = triangles_of(binary_node);
        return *std::min_element(triangles.begin(), triangles.end());
    }

    [[nodiscard]] bool comes_before(const Child& a, const Child& b) const {
        if (a.is_leaf != b.is_leaf) return b.is_leaf;
        const double area_a = tree_.nodes[a.binary_node].half_area();
        const double area_b = tree_.nodes[b.binary_node].half_area();
        if (area_a != area_b) return area_a > area_b;
        const std::uint32_t lowest_a = lowest_triangle(a.binary_node);
        const std::uint32_t lowest_b = lowest_triangle(b.binary_node);
        return lowest_a != lowest_b ? lowest_a < lowest_b : a.binary_node < b.binary_node;  // the same only by copies
    }

    void add_leaf(std::uint32_t binary_node) {
        const BinaryNode& node = tree_.nodes[binary_node];
        const auto first = static_cast<std::ptrdiff_t>(wide_.triangles.size());
        wide_.leaves.push_back({static_cast<std::uint32_t>(first), node.count, binary_node});
        if (strips_ != nullptr) {
            const Strip& strip = wide_.strips.emplace_back(strips_->make_leaf(node));
            for (unsigned i = 0; i < strip.triangle_count; ++i) {
                wide_.triangles.push_back(tree_.triangles[strip.triangles[i].place]);
                wide_.first_corners.push_back(strip.triangles[i].first_corner);
            }
            return;
        }
        const auto triangles = triangles_of(binary_node);
        wide_.triangles.insert(wide_.triangles.end(), triangles.begin(), triangles.end());
        std::sort(wide_.triangles.begin() + first, wide_.triangles.end());
        // Two parts of one triangle that meet again in a leaf are one.
        wide_.triangles.erase(std::unique(wide_.triangles.begin() + first, wide_.triangles.end()),
                              wide_.triangles.end());
        wide_.leaves.back().count = static_cast<std::uint32_t>(wide_.triangles.end() - wide_.triangles.begin() - first);
        wide_.first_corners.resize(wide_.triangles.size(), 0);
    }

    const BinaryTree& tree_;
    const CollapsePlan& plan_;
    const StripMaker* strips_;
    WideTree& wide_;
};

}  // namespace

WideTree put_in_order(const LatticeMesh& mesh, const BinaryTree& tree, const CollapsePlan& plan,
                      const StripMaker* strips) {
    WideTree wide;
    if (mesh.triangles.empty()) return wide;
    wide.triangles.reserve(mesh.triangles.size());
    wide.first_corners.reserve(mesh.triangles.size());
    wide.nodes.resize(1);
    Orderer(tree, plan, strips, wide).visit(0, 0, 1);
    wide.copies = static_cast<std::uint32_t>(wide.triangles.size() - mesh.triangles.size());
    return wide;
}

}  // namespace espalier::baker
