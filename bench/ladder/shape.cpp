#include "shape.hpp"

#include <algorithm>

namespace espalier::bench {
namespace {

/// Adds the children of node `index`, then what is below each of them, the first child first.
/// `children_of(source)` returns the sources that stand for the children of a source.
template <class Source, class ChildrenOf>
void add_below(TreeShape& shape, std::uint32_t index, unsigned level, const std::vector<Source>& children,
               const ChildrenOf& children_of) {
    shape.height = std::max(shape.height, level);
    if (children.empty()) return;
    const auto first = static_cast<std::uint32_t>(shape.nodes.size());
    shape.nodes[index].first_child = first;
    shape.nodes[index].child_count = static_cast<std::uint32_t>(children.size());
    for (const Source& child : children) shape.nodes.push_back({index, 0, 0, child.first, child.count});
    for (std::uint32_t i = 0; i < children.size(); ++i)
        add_below(shape, first + i, level + 1, children_of(children[i]), children_of);
}

/// A node of the tree that a shape is made from.
struct Source {
    std::size_t node;
    std::uint32_t first;
    std::uint32_t count;
};

/// Which nodes of a binary shape become the children of a wide one.
class Widening {
public:
    Widening(const TreeShape& binary, std::span<const Aabb> boxes, unsigned degree)
        : binary_(&binary), degree_(degree), choices_(binary.nodes.size() * degree) {
        for (std::size_t i = binary.nodes.size(); i-- > 0;)
            if (!binary.nodes[i].is_leaf()) choose(i, boxes[i].half_area());
    }
    [[nodiscard]] std::vector<std::uint32_t> children_of(std::size_t node) const {
        std::vector<std::uint32_t> children;
        if (!binary_->nodes[node].is_leaf()) add_children(node, choice(node, 1), degree_, children);
        return children;
    }

private:
    /// How a subtree becomes `roots` wide nodes or leaves, or fewer.
    struct Choice {
        double areas = 0.0;     ///< of all inner nodes
        unsigned of_first = 0;  ///< roots in the first child; 0: as with one root less
    };
    [[nodiscard]] Choice& choice(std::size_t node, unsigned roots) { return choices_[node * degree_ + roots - 1]; }
    [[nodiscard]] const Choice& choice(std::size_t node, unsigned roots) const {
        return choices_[node * degree_ + roots - 1];
    }
    void choose(std::size_t node, double area) {
        Choice& one = choice(node, 1);
        one = best_split(node, degree_);
        one.areas += area;
        for (unsigned roots = 2; roots <= degree_; ++roots) {
            const Choice split = best_split(node, roots), &fewer = choice(node, roots - 1);
            choice(node, roots) = split.areas < fewer.areas ? split : Choice{fewer.areas, 0};
        }
    }
    [[nodiscard]] Choice best_split(std::size_t node, unsigned roots) const {
        const std::uint32_t first = binary_->nodes[node].first_child;
        Choice best;
        for (unsigned of_first = 1; of_first < roots; ++of_first) {
            const double areas = choice(first, of_first).areas + choice(first + 1, roots - of_first).areas;
            if (best.of_first == 0 || areas < best.areas) best = {areas, of_first};
        }
        return best;
    }
    void add_children(std::size_t node, const Choice& split, unsigned roots, std::vector<std::uint32_t>& to) const {
        const std::uint32_t first = binary_->nodes[node].first_child;
        add_roots(first, split.of_first, to);
        add_roots(first + 1, roots - split.of_first, to);
    }
    void add_roots(std::uint32_t node, unsigned roots, std::vector<std::uint32_t>& to) const {
        if (binary_->nodes[node].is_leaf()) roots = 1;
        while (roots > 1 && choice(node, roots).of_first == 0) --roots;
        if (roots == 1) to.push_back(node);
        else add_children(node, choice(node, roots), roots, to);
    }

    const TreeShape* binary_;
    unsigned degree_;
    std::vector<Choice> choices_;
};

}  // namespace

std::size_t TreeShape::inner_count() const {
    return static_cast<std::size_t>(
        std::count_if(nodes.begin(), nodes.end(), [](const ShapeNode& node) { return !node.is_leaf(); }));
}

TreeShape binary_shape(const baker::BinaryTree& tree, unsigned most_leaf_triangles) {
    const auto source = [&](std::size_t node) { return Source{node, tree.nodes[node].first, tree.nodes[node].count}; };
    const auto children_of = [&](const Source& of) -> std::vector<Source> {
        if (of.count <= most_leaf_triangles) return {};
        return {source(baker::BinaryTree::left_of(of.node)), source(tree.right_of(of.node))};
    };
    TreeShape shape;
    shape.nodes.push_back({0, 0, 0, tree.nodes[0].first, tree.nodes[0].count});
    add_below(shape, 0, 0, children_of(source(0)), children_of);
    return shape;
}

TreeShape widened(const TreeShape& binary, std::span<const Aabb> boxes, unsigned degree) {
    const Widening widening(binary, boxes, degree);
    const auto source = [&](std::size_t node) {
        return Source{node, binary.nodes[node].first, binary.nodes[node].count};
    };
    const auto children_of = [&](const Source& of) {
        std::vector<Source> children;
        for (const std::uint32_t node : widening.children_of(of.node)) children.push_back(source(node));
        return children;
    };
    TreeShape shape;
    shape.degree = degree;
    shape.nodes.push_back({0, 0, 0, binary.nodes[0].first, binary.nodes[0].count});
    add_below(shape, 0, 0, children_of(source(0)), children_of);
    return shape;
}

std::vector<Aabb> boxes_of(const TreeShape& shape, std::span<const TriangleVertices> triangles,
                           std::span<const Vec3> positions) {
    std::vector<Aabb> boxes(shape.nodes.size(), Aabb::none());
    for (std::size_t i = shape.nodes.size(); i-- > 0;) {
        const ShapeNode& node = shape.nodes[i];
        for (std::uint32_t child = 0; child < node.child_count; ++child) boxes[i].add(boxes[node.first_child + child]);
        if (!node.is_leaf()) continue;
        for (const TriangleVertices& triangle : triangles.subspan(node.first, node.count))
            for (const std::uint32_t vertex : triangle) boxes[i].add(positions[vertex]);
    }
    return boxes;
}

}  // namespace espalier::bench
