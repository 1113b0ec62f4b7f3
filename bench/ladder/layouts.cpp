#include "layouts.hpp"

#include <type_traits>

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

namespace {

/// Returns for each node its place among the inner nodes.
std::vector<std::uint32_t> places_of_inner_nodes(const TreeShape& shape) {
    std::vector<std::uint32_t> places;
    std::uint32_t count = 0;
    for (const ShapeNode& node : shape.nodes) {
        places.push_back(count);
        count += node.is_leaf() ? 0u : 1u;
    }
    return places;
}

Link link_to(const TreeShape& shape, std::size_t index, std::span<const std::uint32_t> places) {
    const ShapeNode& node = shape.nodes[index];
    return node.is_leaf() ? Link::to_leaf(node.first, node.count) : Link::to_node(places[index]);
}

}  // namespace

CompleteTree::CompleteTree(const BoxedShape& from) {
    for (std::size_t i = 0; i < from.shape->nodes.size(); ++i) {
        const ShapeNode& node = from.shape->nodes[i];
        nodes.push_back(
            {from.boxes[i], node.is_leaf() ? Link::to_leaf(node.first, node.count) : Link::to_node(node.first_child)});
    }
}

BoxGrid::BoxGrid(const Aabb& around) {
    constexpr double most_steps = 65534.0;  // one less than there are: the origin is rounded down
    double extent = 0.0;
    for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, double(around.high[k] - around.low[k]));
    int exponent = 0;
    static_cast<void>(std::frexp(extent / most_steps, &exponent));
    if (std::ldexp(most_steps, exponent - 1) >= extent) --exponent;
    step = std::ldexp(1.0f, exponent);
    for (std::size_t k = 0; k < 3; ++k) origin[k] = step * std::floor(around.low[k] / step);
}

QuantisedBox BoxGrid::rounded(const Aabb& box) const {
    const auto steps = [&](float at, std::size_t k) { return (double(at) - double(origin[k])) / double(step); };
    QuantisedBox to;
    for (std::size_t k = 0; k < 3; ++k) {
        to.low[k] = static_cast<std::uint16_t>(std::floor(steps(box.low[k], k)));
        to.high[k] = static_cast<std::uint16_t>(std::ceil(steps(box.high[k], k)));
    }
    return to;
}

template <class Box>
NoLeafTree<Box>::NoLeafTree(const BoxedShape& from) : grid(from.boxes[0]) {
    const std::vector<std::uint32_t> places = places_of_inner_nodes(*from.shape);
    for (std::size_t i = 0; i < from.shape->nodes.size(); ++i) {
        const ShapeNode& node = from.shape->nodes[i];
        if (node.is_leaf()) continue;
        NoLeafNode<Box>& made = nodes.emplace_back();
        if constexpr (std::is_same_v<Box, Aabb>) made.box = from.boxes[i];
        else made.box = grid.rounded(from.boxes[i]);
        for (std::uint32_t child = 0; child < 2; ++child)
            made.links[child] = link_to(*from.shape, node.first_child + child, places);
    }
}
template struct NoLeafTree<Aabb>;
template struct NoLeafTree<QuantisedBox>;

template <unsigned most_children>
WideTree<most_children>::WideTree(const BoxedShape& from) : box(from.boxes[0]) {
    const std::vector<std::uint32_t> places = places_of_inner_nodes(*from.shape);
    for (const ShapeNode& node : from.shape->nodes) {
        if (node.is_leaf()) continue;
        WideNode<degree>& made = nodes.emplace_back();
        std::fill_n(made.boxes, degree, Aabb::none());
        for (std::uint32_t child = 0; child < node.child_count; ++child) {
            made.boxes[child] = from.boxes[node.first_child + child];
            made.links[child] = link_to(*from.shape, node.first_child + child, places);
        }
    }
}
template struct WideTree<2>;
template struct WideTree<4>;
template struct WideTree<8>;
template struct WideTree<16>;

}  // namespace espalier::bench
