#include "layouts.hpp"

#include <algorithm>
#include <type_traits>

namespace espalier::bench {
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
