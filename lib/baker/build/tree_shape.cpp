#include <baker/build/tree_shape.hpp>

#include <algorithm>

#include <baker/build/sah.hpp>
#include <baker/build/sah_split.hpp>

namespace espalier::baker {

namespace {

struct Measured {
    LaneBox box;
    std::uint32_t count = 1;
    std::uint32_t height = 0;
};

class Layout {
public:
    Layout(std::span<const Reference> leaves, const TreeShape& shape, const BuildSettings& settings)
        : leaves_(leaves),
          shape_(shape),
          settings_(settings),
          leaf_count_(static_cast<std::uint32_t>(leaves.size())),
          placed_(leaves.size()) {
        measure();
        tree_.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(leaf_count_));
    }

    [[nodiscard]] BinaryTree run() {
        place(shape_.root, 0, 0, 0);
        tree_.triangles.reserve(leaf_count_);
        for (const Reference& reference : placed_) tree_.triangles.push_back(reference.triangle);
        return std::move(tree_);
    }

private:
    [[nodiscard]] bool is_leaf(std::uint32_t number) const { return number < leaf_count_; }
    [[nodiscard]] const std::array<std::uint32_t, 2>& children_of(std::uint32_t number) const {
        return shape_.children[number - leaf_count_];
    }

    /// Children before parents, without recursion: the shape may be as high as it has leaves.
    void measure() {
        measured_.resize(leaf_count_ + shape_.children.size());
        std::vector<std::uint32_t> parents_first;
        parents_first.reserve(measured_.size());
        parents_first.push_back(shape_.root);
        for (std::size_t i = 0; i < parents_first.size(); ++i) {
            const std::uint32_t number = parents_first[i];
            if (is_leaf(number)) continue;
            for (const std::uint32_t child : children_of(number)) parents_first.push_back(child);
        }
        for (auto number = parents_first.rbegin(); number != parents_first.rend(); ++number) {
            Measured& here = measured_[*number];
            if (is_leaf(*number)) {
                here.box = lane_box_of(leaves_[*number]);
            } else {
                const Measured& left = measured_[children_of(*number)[0]];
                const Measured& right = measured_[children_of(*number)[1]];
                here.box = left.box;
                here.box.add(right.box);
                here.count = left.count + right.count;
                here.height = std::max(left.height, right.height) + 1;
            }
        }
    }

    /// Recursion goes no deeper than most_height, or than a balanced tree must be.
    void place(std::uint32_t number, std::uint32_t first, std::size_t node, unsigned depth) {
        const Measured& here = measured_[number];
        if (is_leaf(number)) {
            placed_[first] = leaves_[number];
        } else {
            const auto [left, right] = children_of(number);
            const std::uint32_t left_count = measured_[left].count;
            const std::uint32_t right_count = measured_[right].count;
            const bool is_too_high = here.height > settings_.most_height - std::min(depth, settings_.most_height);
            if (is_too_high && !leaves_room(depth, std::max(left_count, right_count), settings_.most_height)) {
                build_anew(number, first, node, depth);
                return;
            }
            place(left, first, node + 1, depth + 1);
            place(right, first + left_count, node + 1 + subtree_nodes(left_count), depth + 1);
        }
        std::memcpy(&tree_.nodes[node], &here.box, sizeof(BinaryNode));
        tree_.nodes[node].first = first;
        tree_.nodes[node].count = here.count;
    }

    void build_anew(std::uint32_t number, std::uint32_t first, std::size_t node, unsigned depth) {
        std::vector<std::uint32_t> waiting = {number};
        std::uint32_t next = first;
        while (!waiting.empty()) {
            const std::uint32_t top = waiting.back();
            waiting.pop_back();
            if (is_leaf(top)) {
                placed_[next++] = leaves_[top];
            } else {
                waiting.push_back(children_of(top)[1]);
                waiting.push_back(children_of(top)[0]);
            }
        }
        build_sah_below(placed_, first, next - first, depth, tree_.nodes.get() + node, settings_);
    }

    std::span<const Reference> leaves_;
    const TreeShape& shape_;
    const BuildSettings& settings_;
    std::uint32_t leaf_count_;
    std::vector<Reference> placed_;  // in the order of the tree
    std::vector<Measured> measured_;
    BinaryTree tree_;
};

}  // namespace

BinaryTree lay_out(std::span<const Reference> references, const TreeShape& shape, const BuildSettings& settings) {
    return Layout(references, shape, settings).run();
}

BinaryTree lay_out(const LatticeMesh& mesh, const TreeShape& shape, const BuildSettings& settings) {
    std::vector<Reference> references(mesh.triangles.size());
    for (std::uint32_t i = 0; i < references.size(); ++i) put_reference(mesh, i, references[i]);
    return lay_out(references, shape, settings);
}

}  // namespace espalier::baker
