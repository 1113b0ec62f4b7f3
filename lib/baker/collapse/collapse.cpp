#include <baker/collapse/collapse.hpp>

#include <algorithm>
#include <bit>
#include <limits>

#include <baker/collapse/vertex_list.hpp>

namespace espalier::baker {

namespace {

constexpr unsigned most_roots = format::max_children;
constexpr float impossible = std::numeric_limits<float>::infinity();

/// What was chosen for one subtree, packed into 64 bits. A subtree may stand as 1 .. 16 roots side by side.
///   bits 0-3    as one wide node: how many of its children come from the left
///   bits 4-52   as k = 2 .. 16 roots, in bit_width(k - 1) bits: how many come from the left; 0: k - 1 roots are no
///   worse bit 53      as one root it is a leaf bits 54-59  height of the binary subtree
class Choice {
public:
    static constexpr unsigned leaf_shift = 53;
    static constexpr unsigned height_shift = 54;

    /// For k roots: where the number of those from the left stands.
    static constexpr auto root_shifts = [] {
        std::array<unsigned, most_roots + 2> shifts{};
        shifts[2] = std::bit_width(most_roots - 1);
        for (unsigned roots = 2; roots <= most_roots; ++roots)
            shifts[roots + 1] = shifts[roots] + static_cast<unsigned>(std::bit_width(roots - 1));
        return shifts;
    }();
    static_assert(root_shifts[most_roots + 1] == leaf_shift);

    explicit Choice(std::uint64_t packed) : packed_(packed) {}
    [[nodiscard]] bool is_leaf() const { return (packed_ >> leaf_shift & 1) != 0; }
    [[nodiscard]] unsigned height() const { return static_cast<unsigned>(packed_ >> height_shift); }
    [[nodiscard]] unsigned left_children() const { return field(0, root_shifts[2]); }
    [[nodiscard]] unsigned left_roots(unsigned roots) const {
        return field(root_shifts[roots], root_shifts[roots + 1]);
    }

private:
    [[nodiscard]] unsigned field(unsigned begin, unsigned end) const {
        return static_cast<unsigned>(packed_ >> begin) & ((1u << (end - begin)) - 1);
    }

    std::uint64_t packed_;
};

/// The plan of a subtree for its parent. costs[k]: of at most k roots, of which there are no more than triangles.
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
          costs_(settings.costs),
          sizes_(sizes),
          max_leaf_triangles_(std::min(settings.max_leaf_triangles, sizes.most_triangles())),
          most_children_(plan.most_children_),
          node_bytes_(static_cast<float>(format::node_bytes(settings.profile))),
          plan_(plan),
          relative_area_(1.0f / static_cast<float>(std::max(tree.nodes[0].half_area(), 1.0))),
          byte_cost_(settings.byte_price * sizes.byte_weight() / static_cast<float>(tree.triangles.size())) {
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
    static constexpr std::uint64_t leaf_bit = std::uint64_t{1} << Choice::leaf_shift;

    void plan_triangle(std::size_t node, Subtree& subtree) {
        subtree.vertices = list_of(mesh_.triangles[tree_.triangles[tree_.nodes[node].first]].corners);
        subtree.height = 0;
        subtree.costs.fill(leaf_cost(tree_.nodes[node], sizes_.of(tree_.nodes[node], 3)));
        plan_.choices_[node] = leaf_bit;
    }

    /// Leaves the result in place of the right subtree.
    void plan_inner(std::size_t node, const Subtree& left, Subtree& right) {
        const BinaryNode& binary = tree_.nodes[node];
        const unsigned left_triangles = tree_.nodes[BinaryTree::left_of(node)].count;
        const unsigned right_triangles = binary.count - left_triangles;
        std::uint64_t packed = 0;
        std::array<float, most_roots + 1> split_costs;
        std::array<std::uint32_t, most_roots + 1> from_left;
        for (unsigned roots = 2; roots <= most_children_; ++roots) {
            // More roots than a side has triangles cost what so many do.
            const unsigned most_here = std::min(roots - 1, left_triangles);
            const unsigned least_here = std::min(std::max(roots, right_triangles + 1) - right_triangles, most_here);
            split_costs[roots] = impossible;
            from_left[roots] = least_here;
            for (unsigned here = least_here; here <= most_here; ++here) {
                const float cost = left.costs[here] + right.costs[roots - here];
                if (cost < split_costs[roots]) {
                    split_costs[roots] = cost;
                    from_left[roots] = here;
                }
            }
        }
        packed |= from_left[most_children_];

        const float area = area_of(binary);
        const float node_cost = area * costs_.node_visit + byte_cost_ * node_bytes_;
        float as_leaf = impossible;
        VertexList vertices;
        vertices.count = VertexList::too_many;
        if (binary.count <= max_leaf_triangles_) {
            vertices = merge(left.vertices, right.vertices);
            const LeafSize size = vertices.fits() ? sizes_.of(binary, vertices.count) : LeafSize{};
            if (size.fits) as_leaf = leaf_cost(binary, size);
        }
        const float as_node = node_cost + split_costs[most_children_];
        if (as_leaf <= as_node) packed |= leaf_bit;

        right.costs[1] = std::min(as_leaf, as_node);
        for (unsigned roots = 2; roots <= most_children_; ++roots) {
            right.costs[roots] = std::min(split_costs[roots], right.costs[roots - 1]);
            if (split_costs[roots] < right.costs[roots - 1])
                packed |= std::uint64_t{from_left[roots]} << Choice::root_shifts[roots];
        }
        const unsigned height = std::max(left.height, right.height) + 1;
        packed |= std::uint64_t{height} << Choice::height_shift;
        plan_.choices_[node] = packed;

        right.vertices = vertices;
        right.height = height;
    }

    [[nodiscard]] float area_of(const BinaryNode& node) const {
        return static_cast<float>(node.half_area()) * relative_area_;
    }

    [[nodiscard]] float leaf_cost(const BinaryNode& node, const LeafSize& size) const {
        const unsigned groups = (size.slots + 7) / 8;
        const float visit = costs_.leaf_visit + costs_.leaf_group * static_cast<float>(groups);
        return area_of(node) * visit + byte_cost_ * static_cast<float>(size.bytes);
    }

    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    const RayCosts& costs_;
    const LeafSizes& sizes_;
    unsigned max_leaf_triangles_;
    unsigned most_children_;
    float node_bytes_;
    CollapsePlan& plan_;
    float relative_area_;
    float byte_cost_;
};

CollapsePlan::CollapsePlan(const LatticeMesh& mesh, const BinaryTree& tree, const LeafSizes& sizes,
                           const CollapseSettings& settings)
    : tree_(tree), most_children_(format::max_node_children(settings.profile)) {
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
    // levels instead, at most 8 children: what hangs below those is 3 lower, so height(child) <= 3 * levels - 3 =
    // 3 * (levels - 1). With one level left, children have height 0: single triangles, which are leaves. Hence no way
    // down has more than max_depth nodes.
    const unsigned from_left = choice.left_children();
    add_roots(static_cast<std::uint32_t>(BinaryTree::left_of(binary_node)), from_left, children);
    add_roots(static_cast<std::uint32_t>(tree_.right_of(binary_node)), most_children_ - from_left, children);
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
