#include "collapse.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "vertex_list.hpp"

namespace espalier::baker {

namespace {

constexpr unsigned most_roots = format::max_children;
constexpr float impossible = std::numeric_limits<float>::infinity();

/// What was chosen for one subtree, packed into 32 bits. A subtree may stand as k = 1 .. 8 roots side by side.
///   bits 0-2     as one wide node: how many of its 8 children come from the left
///   bits 3k-3 .. as k = 2 .. 8 roots: how many come from the left; 0: k - 1 roots are no worse
///   bit 24       as one root it is a leaf
///   bits 25-30   height of the binary subtree
class Choice {
public:
    static constexpr std::uint32_t leaf_bit = 1u << 24;
    static constexpr unsigned height_shift = 25;

    explicit Choice(std::uint32_t packed) : packed_(packed) {}
    [[nodiscard]] bool is_leaf() const { return (packed_ & leaf_bit) != 0; }
    [[nodiscard]] unsigned height() const { return packed_ >> height_shift; }
    [[nodiscard]] unsigned left_children() const { return packed_ & 7; }
    [[nodiscard]] unsigned left_roots(unsigned roots) const { return packed_ >> (3 * roots - 3) & 7; }

private:
    std::uint32_t packed_;
};

/// What the parent needs to know of a subtree. costs[k]: of at most k roots.
struct Subtree {
    std::array<float, most_roots + 1> costs;
    VertexList vertices;
    unsigned height;
};

}  // namespace

/// Visits the binary nodes backwards, so that children come before their parents: the right subtree, the left one, then
/// their parent. What children leave behind lies on a stack no higher than the tree.
class CollapsePlanner {
public:
    CollapsePlanner(const LatticeMesh& mesh, const BinaryTree& tree, const LeafSizes& sizes,
                    const CollapseSettings& settings, CollapsePlan& plan)
        : mesh_(mesh),
          tree_(tree),
          model_(settings.cost_model),
          sizes_(sizes),
          max_leaf_triangles_(std::min(settings.max_leaf_triangles, sizes.most_triangles())),
          plan_(plan),
          relative_area_(1.0f / static_cast<float>(std::max(tree.nodes[0].half_area(), 1.0))),
          byte_cost_(settings.cost_model.byte_price * sizes.byte_weight() / static_cast<float>(tree.triangles.size())) {
        plan.choices_.resize(tree.node_count());
        std::vector<Subtree> stack(max_binary_height + 2);
        std::size_t top = 0;
        for (std::size_t node = tree.node_count(); node-- > 0;) {
            if (tree.nodes[node].is_leaf()) {
                plan_triangle(node, stack[top++]);
            } else {
                Subtree& left = stack[top - 1];
                Subtree& right = stack[top - 2];
                plan_inner(node, left, right);
                --top;
            }
        }
    }

private:
    void plan_triangle(std::size_t node, Subtree& subtree) {
        subtree.vertices = list_of(mesh_.triangles[tree_.triangles[tree_.nodes[node].first]].corners);
        subtree.height = 0;
        subtree.costs.fill(leaf_cost(tree_.nodes[node], sizes_.of(tree_.nodes[node], 3)));
        plan_.choices_[node] = Choice::leaf_bit;
    }

    /// Leaves the result in place of the right subtree.
    void plan_inner(std::size_t node, const Subtree& left, Subtree& right) {
        const BinaryNode& binary = tree_.nodes[node];
        std::uint32_t packed = 0;
        std::array<float, most_roots + 1> split_costs;
        std::array<std::uint32_t, most_roots + 1> from_left;
        for (unsigned roots = 2; roots <= most_roots; ++roots) {
            split_costs[roots] = impossible;
            from_left[roots] = 1;
            for (unsigned here = 1; here < roots; ++here) {
                const float cost = left.costs[here] + right.costs[roots - here];
                if (cost < split_costs[roots]) {
                    split_costs[roots] = cost;
                    from_left[roots] = here;
                }
            }
        }
        packed |= from_left[most_roots];

        const float area = area_of(binary);
        const float node_cost = area * model_.node_visit + byte_cost_ * static_cast<float>(format::node::bytes);
        float as_leaf = impossible;
        VertexList vertices;
        vertices.count = VertexList::too_many;
        if (binary.count <= max_leaf_triangles_) {
            vertices = merge(left.vertices, right.vertices);
            const LeafSize size = vertices.fits() ? sizes_.of(binary, vertices.count) : LeafSize{};
            if (size.fits) as_leaf = leaf_cost(binary, size);
        }
        const float as_node = node_cost + split_costs[most_roots];
        if (as_leaf <= as_node) packed |= Choice::leaf_bit;

        std::array<float, most_roots + 1> costs;
        costs[0] = impossible;
        costs[1] = std::min(as_leaf, as_node);
        for (unsigned roots = 2; roots <= most_roots; ++roots) {
            costs[roots] = std::min(split_costs[roots], costs[roots - 1]);
            if (split_costs[roots] < costs[roots - 1]) packed |= from_left[roots] << (3 * roots - 3);
        }
        const unsigned height = std::max(left.height, right.height) + 1;
        packed |= height << Choice::height_shift;
        plan_.choices_[node] = packed;

        right.costs = costs;
        right.vertices = vertices;
        right.height = height;
    }

    [[nodiscard]] float area_of(const BinaryNode& node) const {
        return static_cast<float>(node.half_area()) * relative_area_;
    }

    [[nodiscard]] float leaf_cost(const BinaryNode& node, const LeafSize& size) const {
        const unsigned groups = (size.slots + 7) / 8;
        const float visit = model_.leaf_visit + model_.leaf_group * static_cast<float>(groups) +
                            model_.triangle * static_cast<float>(size.slots);
        return area_of(node) * visit + byte_cost_ * static_cast<float>(size.bytes);
    }

    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    const CostModel& model_;
    const LeafSizes& sizes_;
    unsigned max_leaf_triangles_;
    CollapsePlan& plan_;
    float relative_area_;
    float byte_cost_;
};

CollapsePlan::CollapsePlan(const LatticeMesh& mesh, const BinaryTree& tree, const LeafSizes& sizes,
                           const CollapseSettings& settings)
    : tree_(tree) {
    if (!tree.triangles.empty()) CollapsePlanner(mesh, tree, sizes, settings, *this);
}

Child CollapsePlan::child_for(std::uint32_t binary_node) const {
    return {binary_node, Choice(choices_[binary_node]).is_leaf()};
}

void CollapsePlan::add_roots(std::uint32_t binary_node, unsigned roots, Children& children) const {
    const Choice choice(choices_[binary_node]);
    if (tree_.nodes[binary_node].is_leaf()) roots = 1;
    while (roots > 1 && choice.left_roots(roots) == 0) --roots;
    if (roots == 1) {
        children.add(child_for(binary_node));
        return;
    }
    const unsigned from_left = choice.left_roots(roots);
    add_roots(static_cast<std::uint32_t>(BinaryTree::left_of(binary_node)), from_left, children);
    add_roots(static_cast<std::uint32_t>(tree_.right_of(binary_node)), roots - from_left, children);
}

void CollapsePlan::add_all(std::uint32_t binary_node, unsigned levels_below, Children& children) const {
    if (levels_below == 0 || tree_.nodes[binary_node].is_leaf()) {
        children.add(child_for(binary_node));
        return;
    }
    add_all(static_cast<std::uint32_t>(BinaryTree::left_of(binary_node)), levels_below - 1, children);
    add_all(static_cast<std::uint32_t>(tree_.right_of(binary_node)), levels_below - 1, children);
}

Children CollapsePlan::children_of(std::uint32_t binary_node, unsigned levels) const {
    const Choice choice(choices_[binary_node]);
    Children children;
    if (choice.is_leaf()) {  // only a root: the whole mesh is one leaf
        children.add(child_for(binary_node));
        return children;
    }
    // Invariant: height(binary_node) <= 3 * levels. It holds for the root, where the builder keeps the height within
    // 3 * max_depth. The cheapest children are taken if they keep it. If not, the node takes its whole three binary
    // levels instead: what hangs below those is 3 lower, so height(child) <= 3 * levels - 3 = 3 * (levels - 1). With
    // one level left, children have height 0: single triangles, which are leaves. Hence no way down has more than
    // max_depth nodes.
    const unsigned from_left = choice.left_children();
    add_roots(static_cast<std::uint32_t>(BinaryTree::left_of(binary_node)), from_left, children);
    add_roots(static_cast<std::uint32_t>(tree_.right_of(binary_node)), most_roots - from_left, children);
    const auto is_too_high = [&](const Child& child) {
        return !child.is_leaf && Choice(choices_[child.binary_node]).height() > 3 * (levels - 1);
    };
    if (std::any_of(children.list().begin(), children.list().end(), is_too_high)) {
        children = {};
        add_all(binary_node, 3, children);
    }
    return children;
}

}  // namespace espalier::baker
