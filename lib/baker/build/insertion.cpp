#include <baker/build/insertion.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

#include <baker/base/indexed_hash_set.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/build/tree_shape.hpp>

namespace espalier::baker {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;
constexpr std::uint32_t insertions_between_reports = 1 << 12;  // triangles between two calls

struct GrowingNode {
    LaneBox box;
    std::uint32_t parent = none;
    std::array<std::uint32_t, 2> children = {none, none};
};

/// Numbered as a TreeShape.
class GrowingTree {
public:
    GrowingTree(const LatticeMesh& mesh, unsigned most_places)
        : triangle_count_(static_cast<std::uint32_t>(mesh.triangles.size())),
          most_places_(most_places),
          next_inner_(triangle_count_),
          nodes_(2 * mesh.triangles.size() - 1) {
        Reference unused;
        for (std::uint32_t i = 0; i < triangle_count_; ++i) nodes_[i].box = put_reference(mesh, i, unused);
    }

    void insert(std::uint32_t triangle) {
        if (root_ == none) {
            root_ = triangle;
            return;
        }
        const std::uint32_t beside = best_place(nodes_[triangle].box);
        const std::uint32_t joint = next_inner_++;
        const std::uint32_t parent = nodes_[beside].parent;
        nodes_[joint].parent = parent;
        if (parent == none) root_ = joint;
        else replace_child(parent, beside, joint);
        adopt(joint, 0, beside);
        adopt(joint, 1, triangle);
        for (std::uint32_t node = joint; node != none; node = nodes_[node].parent) {
            refit(node);
            rotate(node);
        }
    }

    [[nodiscard]] TreeShape shape() const {
        TreeShape shape;
        shape.root = root_;
        shape.children.reserve(nodes_.size() - triangle_count_);
        for (std::size_t i = triangle_count_; i < nodes_.size(); ++i) shape.children.push_back(nodes_[i].children);
        return shape;
    }

private:
    /// Beside a node that is still to be looked at, no place costs less than `bound`.
    struct Candidate {
        float bound;
        float induced;  ///< what the ancestors grow by
        std::uint32_t node;
        /// For a heap with the least bound on top; of equal ones the lower number.
        bool operator<(const Candidate& other) const {
            return bound != other.bound ? bound > other.bound : node > other.node;
        }
    };

    [[nodiscard]] bool is_inner(std::uint32_t node) const { return node >= triangle_count_; }

    /// The node beside which the sum of all areas grows least: branch and bound, best bound first (Bittner et al.
    /// 2015). Every node that is looked at was preceded by its parent, so that no place is deeper than most_places_.
    [[nodiscard]] std::uint32_t best_place(const LaneBox& box) {
        const float area = box.half_area();
        std::uint32_t best = root_;
        float best_cost = std::numeric_limits<float>::infinity();
        waiting_.clear();
        waiting_.push_back({area, 0.0f, root_});
        for (unsigned places = 0; places < most_places_ && !waiting_.empty(); ++places) {
            std::pop_heap(waiting_.begin(), waiting_.end());
            const Candidate candidate = waiting_.back();
            waiting_.pop_back();
            if (candidate.bound >= best_cost) break;
            const GrowingNode& node = nodes_[candidate.node];
            LaneBox both = node.box;
            both.add(box);
            const float direct = both.half_area();
            const float cost = candidate.induced + direct;
            if (cost < best_cost) {
                best_cost = cost;
                best = candidate.node;
            }
            if (!is_inner(candidate.node)) continue;
            const float induced = candidate.induced + (direct - node.box.half_area());
            if (induced + area >= best_cost) continue;
            for (const std::uint32_t child : node.children) {
                waiting_.push_back({induced + area, induced, child});
                std::push_heap(waiting_.begin(), waiting_.end());
            }
        }
        return best;
    }

    [[nodiscard]] LaneBox box_around(std::uint32_t a, std::uint32_t b) const {
        LaneBox both = nodes_[a].box;
        both.add(nodes_[b].box);
        return both;
    }

    void refit(std::uint32_t node) {
        nodes_[node].box = box_around(nodes_[node].children[0], nodes_[node].children[1]);
    }

    void adopt(std::uint32_t parent, unsigned side, std::uint32_t child) {
        nodes_[parent].children[side] = child;
        nodes_[child].parent = parent;
    }

    void replace_child(std::uint32_t parent, std::uint32_t old_child, std::uint32_t new_child) {
        adopt(parent, nodes_[parent].children[0] == old_child ? 0 : 1, new_child);
    }

    /// Lets two nodes change places, neither of which lies below the other.
    void exchange(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t parent_a = nodes_[a].parent;
        const std::uint32_t parent_b = nodes_[b].parent;
        const unsigned side_a = nodes_[parent_a].children[0] == a ? 0 : 1;
        const unsigned side_b = nodes_[parent_b].children[0] == b ? 0 : 1;
        adopt(parent_a, side_a, b);
        adopt(parent_b, side_b, a);
    }

    /// The rotation below `node` that saves most area, if any does (Kopta et al. 2012): a child with a child of the
    /// other one, or two grandchildren.
    void rotate(std::uint32_t node) {
        float best_saving = 0.0f;
        std::pair<std::uint32_t, std::uint32_t> best = {none, none};
        const auto consider = [&](float saving, std::uint32_t a, std::uint32_t b) {
            if (saving > best_saving) {
                best_saving = saving;
                best = {a, b};
            }
        };
        const std::array<std::uint32_t, 2> children = nodes_[node].children;
        for (unsigned side = 0; side < 2; ++side) {
            const std::uint32_t child = children[side];
            const std::uint32_t other = children[1 - side];
            if (!is_inner(other)) continue;
            const float area = nodes_[other].box.half_area();
            const auto [a, b] = nodes_[other].children;
            consider(area - box_around(child, b).half_area(), child, a);
            consider(area - box_around(child, a).half_area(), child, b);
        }
        if (is_inner(children[0]) && is_inner(children[1])) {
            const float area = nodes_[children[0]].box.half_area() + nodes_[children[1]].box.half_area();
            const auto [a, b] = nodes_[children[0]].children;
            const auto [c, d] = nodes_[children[1]].children;
            consider(area - (box_around(c, b).half_area() + box_around(a, d).half_area()), a, c);
            consider(area - (box_around(d, b).half_area() + box_around(c, a).half_area()), a, d);
        }
        if (best.first == none) return;
        exchange(best.first, best.second);
        for (const std::uint32_t child : nodes_[node].children) {
            if (is_inner(child)) refit(child);
        }
    }

    std::uint32_t triangle_count_;
    unsigned most_places_;
    std::uint32_t next_inner_;
    std::uint32_t root_ = none;
    std::vector<GrowingNode> nodes_;
    std::vector<Candidate> waiting_;
};

/// Neighbours in the file are neighbours in space; put in one after the other they would make a lopsided tree. Mixing
/// the bits of a number is one-to-one, so that no two triangles tie.
std::vector<std::uint32_t> shuffled(std::uint32_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [](std::uint32_t a, std::uint32_t b) { return mix_bits(a + 1u) < mix_bits(b + 1u); });
    return order;
}

}  // namespace

BinaryTree build_insertion(const LatticeMesh& mesh, const BuildSettings& settings) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return {};
    GrowingTree tree(mesh, settings.most_insert_places);
    std::uint32_t placed = 0;
    for (const std::uint32_t triangle : shuffled(count)) {
        tree.insert(triangle);
        if (++placed % insertions_between_reports == 0 && settings.progress) settings.progress(double(placed) / count);
    }
    return lay_out(mesh, tree.shape(), settings);
}

}  // namespace espalier::baker
