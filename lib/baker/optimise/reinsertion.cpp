#include <baker/optimise/reinsertion.hpp>

#include <algorithm>
#include <array>
#include <numeric>

#include <baker/build/sah_split.hpp>
#include <baker/build/tree_shape.hpp>

namespace espalier::baker {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;
constexpr unsigned most_places = 256;  // looked at for one subtree: where all boxes overlap, all places look promising
constexpr float least_gain = 1e-3f;    // of a node's area: less is lost in the rounding of the sums

/// A tree that can be changed. Its leaves are subtrees of the given one, which stay as they are.
struct LooseNode {
    LaneBox box;
    std::uint32_t parent = none;
    std::uint32_t left = none;  ///< none: a subtree that stays together
    std::uint32_t right = none;
    std::uint32_t binary_node = none;  ///< of such a subtree: its root in the given tree

    [[nodiscard]] bool is_inner() const { return left != none; }
};

class LooseTree {
public:
    LooseTree(const BinaryTree& tree, std::uint32_t least_triangles) : tree_(tree) { loosen(0, none, least_triangles); }

    [[nodiscard]] std::size_t size() const { return nodes_.size(); }

    /// Tries to move every subtree once.
    void pass() {
        std::vector<float> areas;
        for (const LooseNode& node : nodes_) areas.push_back(node.box.half_area());
        std::vector<std::uint32_t> order(nodes_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
        for (const std::uint32_t node : order) {
            if (node == root || nodes_[node].parent == root) continue;
            const std::uint32_t place = best_place(node);
            if (place != none) move(node, place);
        }
    }

    /// Returns the same tree in the order that BinaryTree requires; an empty one if it is no better than the given one.
    [[nodiscard]] BinaryTree tightened(unsigned most_height) const {
        BinaryTree result;
        result.triangles.reserve(tree_.triangles.size());
        result.nodes = std::make_unique_for_overwrite<BinaryNode[]>(tree_.node_count());
        std::size_t next = 0;
        if (tighten(root, 0, most_height, result, next)) return result;
        BinaryTree low = lowered(most_height);
        const bool is_better = sum_of_areas(low) < sum_of_areas(tree_) || height_of(0) > most_height;
        return is_better ? std::move(low) : BinaryTree{};
    }

private:
    static constexpr std::uint32_t root = 0;

    std::uint32_t loosen(std::uint32_t binary_node, std::uint32_t parent, std::uint32_t least_triangles) {
        const auto number = static_cast<std::uint32_t>(nodes_.size());
        const BinaryNode& binary = tree_.nodes[binary_node];
        nodes_.push_back({binary.box(), parent, none, none, binary_node});
        if (binary.count >= least_triangles && !binary.is_leaf()) {
            const auto left =
                loosen(static_cast<std::uint32_t>(BinaryTree::left_of(binary_node)), number, least_triangles);
            const auto right = loosen(static_cast<std::uint32_t>(tree_.right_of(binary_node)), number, least_triangles);
            nodes_[number].left = left;
            nodes_[number].right = right;
        }
        return number;
    }

    [[nodiscard]] std::uint32_t sibling(std::uint32_t node) const {
        const LooseNode& parent = nodes_[nodes_[node].parent];
        return parent.left == node ? parent.right : parent.left;
    }

    /// Where `node` costs least: beside which node. None when it had better stay.
    ///
    /// Taken out, it saves its parent's area and shrinks every ancestor above. Put in beside another node, it costs the
    /// area of a new parent of both and enlarges all nodes on the way there from the lowest common ancestor. The search
    /// goes up from the old place; from every ancestor it goes down the other side, as long as what is saved so far
    /// exceeds what the best place saves by more than the node's own area, which any new parent costs.
    [[nodiscard]] std::uint32_t best_place(std::uint32_t node) {
        const LaneBox box = nodes_[node].box;
        const float area = box.half_area();
        const std::uint32_t parent = nodes_[node].parent;
        float saved_above = nodes_[parent].box.half_area();
        float best_saving = area * least_gain;
        std::uint32_t best = none;
        unsigned places = 0;
        LaneBox without_node = nodes_[sibling(node)].box;
        for (std::uint32_t from = node; nodes_[from].parent != none; from = nodes_[from].parent) {
            const std::uint32_t ancestor = nodes_[from].parent;
            waiting_.push_back(place_beside(sibling(from), box, saved_above));
            while (!waiting_.empty()) {
                const Place place = waiting_.back();
                waiting_.pop_back();
                if (place.saved - area <= best_saving) continue;
                if (++places > most_places) {
                    waiting_.clear();
                    return best;
                }
                const bool is_old_place = from == node && place.node == sibling(node);
                if (place.saving > best_saving && !is_old_place) {
                    best_saving = place.saving;
                    best = place.node;
                }
                const LooseNode& beside = nodes_[place.node];
                if (!beside.is_inner()) continue;
                const float saved_below = place.saving + beside.box.half_area();
                const Place left = place_beside(beside.left, box, saved_below);
                const Place right = place_beside(beside.right, box, saved_below);
                const bool left_first = left.saving > right.saving;
                waiting_.push_back(left_first ? right : left);
                waiting_.push_back(left_first ? left : right);
            }
            if (ancestor != parent) {
                without_node.add(nodes_[sibling(from)].box);
                saved_above += nodes_[ancestor].box.half_area() - without_node.half_area();
            }
        }
        return best;
    }

    struct Place {
        std::uint32_t node;  ///< beside which
        float saved;         ///< before the new parent of both costs anything
        float saving;        ///< after it
    };
    [[nodiscard]] Place place_beside(std::uint32_t node, const LaneBox& box, float saved) const {
        LaneBox both = nodes_[node].box;
        both.add(box);
        return {node, saved, saved - both.half_area()};
    }

    /// The old parent becomes the new one.
    void move(std::uint32_t node, std::uint32_t place) {
        const std::uint32_t parent = nodes_[node].parent;
        const std::uint32_t left_behind = sibling(node);
        replace(parent, left_behind);
        refit(nodes_[left_behind].parent);
        replace(place, parent);
        nodes_[parent].left = place;
        nodes_[parent].right = node;
        nodes_[place].parent = parent;
        refit(parent);
    }

    void replace(std::uint32_t old_child, std::uint32_t new_child) {
        const std::uint32_t parent = nodes_[old_child].parent;
        (nodes_[parent].left == old_child ? nodes_[parent].left : nodes_[parent].right) = new_child;
        nodes_[new_child].parent = parent;
    }

    void refit(std::uint32_t node) {
        for (; node != none; node = nodes_[node].parent) {
            nodes_[node].box = nodes_[nodes_[node].left].box;
            nodes_[node].box.add(nodes_[nodes_[node].right].box);
        }
    }

    /// Appends a subtree; false when it goes deeper than allowed.
    bool tighten(std::uint32_t number, unsigned depth, unsigned most_height, BinaryTree& result,
                 std::size_t& next) const {
        if (depth > most_height) return false;
        const LooseNode& node = nodes_[number];
        const std::size_t at = next;
        const auto first = static_cast<std::uint32_t>(result.triangles.size());
        if (!node.is_inner()) {
            copy_subtree(node.binary_node, result, next);
            return depth + height_of(node.binary_node) <= most_height;
        }
        ++next;
        if (!tighten(node.left, depth + 1, most_height, result, next)) return false;
        if (!tighten(node.right, depth + 1, most_height, result, next)) return false;
        std::memcpy(&result.nodes[at], &node.box, sizeof(BinaryNode));
        result.nodes[at].first = first;
        result.nodes[at].count = static_cast<std::uint32_t>(result.triangles.size()) - first;
        return true;
    }

    [[nodiscard]] static double sum_of_areas(const BinaryTree& tree) {
        double sum = 0.0;
        for (std::size_t i = 0; i < tree.node_count(); ++i) sum += tree.nodes[i].half_area();
        return sum;
    }

    /// Returns the same tree, changed only where it is higher than allowed. Without recursion, since any height is
    /// possible.
    [[nodiscard]] BinaryTree lowered(unsigned most_height) const {
        const auto leaf_count = static_cast<std::uint32_t>(tree_.triangles.size());
        std::vector<Reference> references(leaf_count);
        std::vector<std::uint32_t> shape_numbers(nodes_.size());        // of loose nodes
        std::vector<std::uint32_t> binary_numbers(tree_.node_count());  // of nodes in subtrees that stay together
        std::uint32_t next_inner = leaf_count;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (nodes_[i].is_inner()) {
                shape_numbers[i] = next_inner++;
                continue;
            }
            const std::size_t top = nodes_[i].binary_node;
            for (std::size_t below = top; below < top + subtree_nodes(tree_.nodes[top].count); ++below) {
                const BinaryNode& binary = tree_.nodes[below];
                binary_numbers[below] = binary.is_leaf() ? binary.first : next_inner++;
                if (!binary.is_leaf()) continue;
                const LaneBox box = binary.box();
                std::memcpy(&references[binary.first], &box, sizeof(Reference));
                references[binary.first].triangle = tree_.triangles[binary.first];
            }
            shape_numbers[i] = binary_numbers[top];
        }
        TreeShape shape;
        shape.root = shape_numbers[root];
        shape.children.resize(leaf_count - 1);
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            if (nodes_[i].is_inner()) {
                shape.children[shape_numbers[i] - leaf_count] = {shape_numbers[nodes_[i].left],
                                                                 shape_numbers[nodes_[i].right]};
                continue;
            }
            const std::size_t top = nodes_[i].binary_node;
            for (std::size_t below = top; below < top + subtree_nodes(tree_.nodes[top].count); ++below) {
                if (tree_.nodes[below].is_leaf()) continue;
                shape.children[binary_numbers[below] - leaf_count] = {binary_numbers[BinaryTree::left_of(below)],
                                                                      binary_numbers[tree_.right_of(below)]};
            }
        }
        BuildSettings settings;
        settings.most_height = most_height;
        return lay_out(references, shape, settings);
    }

    /// Subtrees lie together, so that moving one only moves its `first`.
    void copy_subtree(std::uint32_t binary_node, BinaryTree& result, std::size_t& next) const {
        const BinaryNode& top = tree_.nodes[binary_node];
        const auto first = static_cast<std::uint32_t>(result.triangles.size());
        const auto triangles = tree_.triangles.begin() + top.first;
        result.triangles.insert(result.triangles.end(), triangles, triangles + top.count);
        for (std::size_t i = 0; i < subtree_nodes(top.count); ++i) {
            BinaryNode& copy = result.nodes[next++];
            copy = tree_.nodes[binary_node + i];
            copy.first = copy.first - top.first + first;
        }
    }

    [[nodiscard]] unsigned height_of(std::size_t binary_node) const {
        if (tree_.nodes[binary_node].is_leaf()) return 0;
        return 1 + std::max(height_of(BinaryTree::left_of(binary_node)), height_of(tree_.right_of(binary_node)));
    }

    const BinaryTree& tree_;
    std::vector<LooseNode> nodes_;
    std::vector<Place> waiting_;
};

}  // namespace

OptimiseSettings optimise_settings(Effort effort) {
    constexpr std::array<unsigned, 3> passes = {0, 1, 3};
    constexpr std::array<std::uint32_t, 3> least_triangles = {0, 8, 4};
    const auto level = static_cast<std::size_t>(effort);
    return {passes[level], least_triangles[level], max_binary_height};
}

BinaryTree optimise(BinaryTree tree, const OptimiseSettings& settings) {
    if (settings.passes == 0 || tree.triangles.empty()) return tree;
    LooseTree loose(tree, settings.least_triangles);
    for (unsigned i = 0; i < settings.passes; ++i) loose.pass();
    BinaryTree better = loose.tightened(settings.most_height);
    return better.triangles.empty() ? std::move(tree) : std::move(better);
}

}  // namespace espalier::baker
