#include "tree_shape.hpp"

#include <algorithm>

#include "build_sah.hpp"
#include "sah_split.hpp"

namespace espalier::baker {

namespace {

struct Measured {
    LaneBox box;
    std::uint32_t count = 1;
    std::uint32_t height = 0;
};

class Layout {
public:
    Layout(const LatticeMesh& mesh, const TreeShape& shape, const BuildSettings& settings)
        : mesh_(mesh),
          shape_(shape),
          settings_(settings),
          triangle_count_(static_cast<std::uint32_t>(mesh.triangles.size())),
          references_(triangle_count_) {
        measure();
        tree_.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(triangle_count_));
    }

    [[nodiscard]] BinaryTree run() {
        place(shape_.root, 0, 0, 0);
        tree_.triangles.reserve(triangle_count_);
        for (const Reference& reference : references_) tree_.triangles.push_back(reference.triangle);
        return std::move(tree_);
    }

private:
    [[nodiscard]] bool is_triangle(std::uint32_t number) const { return number < triangle_count_; }
    [[nodiscard]] const std::array<std::uint32_t, 2>& children_of(std::uint32_t number) const {
        return shape_.children[number - triangle_count_];
    }

    /// Children before parents, without recursion: the shape may be as high as it has triangles.
    void measure() {
        measured_.resize(triangle_count_ + shape_.children.size());
        std::vector<std::uint32_t> parents_first;
        parents_first.reserve(measured_.size());
        parents_first.push_back(shape_.root);
        for (std::size_t i = 0; i < parents_first.size(); ++i) {
            const std::uint32_t number = parents_first[i];
            if (is_triangle(number)) continue;
            for (const std::uint32_t child : children_of(number)) parents_first.push_back(child);
        }
        for (auto number = parents_first.rbegin(); number != parents_first.rend(); ++number) {
            Measured& here = measured_[*number];
            if (is_triangle(*number)) {
                Reference reference;
                here.box = put_reference(mesh_, *number, reference);
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
        if (is_triangle(number)) {
            put_reference(mesh_, number, references_[first]);
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
            if (is_triangle(top)) {
                put_reference(mesh_, top, references_[next++]);
            } else {
                waiting.push_back(children_of(top)[1]);
                waiting.push_back(children_of(top)[0]);
            }
        }
        build_sah_below(references_, first, next - first, depth, tree_.nodes.get() + node, settings_);
    }

    const LatticeMesh& mesh_;
    const TreeShape& shape_;
    const BuildSettings& settings_;
    std::uint32_t triangle_count_;
    std::vector<Reference> references_;
    std::vector<Measured> measured_;
    BinaryTree tree_;
};

}  // namespace

BinaryTree lay_out(const LatticeMesh& mesh, const TreeShape& shape, const BuildSettings& settings) {
    return Layout(mesh, shape, settings).run();
}

}  // namespace espalier::baker
