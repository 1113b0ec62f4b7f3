#include <baker/verify/check_tree.hpp>

#include <algorithm>

namespace espalier::baker {

namespace {

constexpr const char* axis_names[3] = {"x", "y", "z"};

/// Where a box of an asset of this extent does not end any more. Plain nodes round to whole units. No packed node spans
/// more than the extent, so none needs planes farther apart than 255 of them need to be to reach it; outward rounding
/// adds less than one such distance.
std::int32_t end_of_boxes(std::int32_t extent, const TreeBytes& tree) {
    if (format::has_plain_nodes(tree.profile)) {
        const unsigned unit = format::unit_shift(tree.bits);
        return ((extent >> unit) + 1) << unit;
    }
    unsigned shift = 0;
    while (255 << shift < extent) ++shift;
    return extent + (1 << shift);
}

class TreeWalk {
public:
    TreeWalk(const TreeBytes& tree, LeafCheck check_leaf, TreeCounts& counts)
        : tree_(tree), check_leaf_(check_leaf), counts_(counts) {
        for (std::size_t axis = 0; axis < 3; ++axis) ends_[axis] = end_of_boxes(tree.extent[axis], tree);
    }

    /// False after a complaint. `content` becomes the box of all vertices below. No deeper than format::max_depth.
    bool visit(std::uint32_t number, unsigned depth, const DecodedBox& region, DecodedBox& content) {
        if (depth > format::max_depth)
            return complain(number, "lies deeper than " + std::to_string(format::max_depth) + " nodes");
        DecodedNode node;
        if (!tree_.decode_node(number, node)) return complain(number, "is missing, or is no node");
        if (node.children() == 0) return complain(number, "has no children");
        if (node.first_child != (node.node_children == 0 ? 0 : counts_.nodes)) {
            return complain(number, "has " + std::to_string(node.first_child) + " as its first child instead of " +
                                        std::to_string(node.node_children == 0 ? 0 : counts_.nodes));
        }
        if (!check_ends(number, node)) return false;
        counts_.nodes += node.node_children;
        counts_.depth = std::max(counts_.depth, depth);
        std::array<DecodedBox, format::max_children> contents;
        if (!visit_leaves(number, node, region, contents)) return false;
        for (unsigned child = 0; child < node.node_children; ++child) {
            const DecodedBox inner = region.intersection(node.boxes[child]);
            if (!visit(node.first_child + child, depth + 1, inner, contents[child])) return false;
        }
        content = contents[0];
        for (unsigned child = 0; child < node.children(); ++child) {
            if (!tree_.has_copies && !node.boxes[child].contains(contents[child]))
                return complain_about_box(number, child, node, contents[child]);
            if (tree_.corners && !is_least(node.boxes[child], contents[child]))
                return complain(number,
                                "has a box around its child " + std::to_string(child) + " that could be smaller");
            content.add(contents[child]);
        }
        return true;
    }

    std::optional<std::string> complaint;

private:
    bool visit_leaves(std::uint32_t number, const DecodedNode& node, const DecodedBox& region,
                      std::array<DecodedBox, format::max_children>& contents) {
        if (node.leaf_block != (node.leaves == 0 ? 0 : counts_.leaf_bytes)) {
            return complain(number,
                            "has its leaves at byte " + std::to_string(node.leaf_block) + " of the leaf section");
        }
        if (node.leaves == 0) return true;
        std::size_t end = tree_.first_leaf_at(node);
        for (unsigned i = 0; i < node.leaves; ++i) {
            DecodedLeaf leaf;
            if (!tree_.decode_leaf(node, i, leaf)) return complain(number, "has a leaf that cannot be read");
            if (leaf.first_triangle != counts_.triangles ||
                leaf.at != (end + tree_.leaf_unit() - 1) / tree_.leaf_unit() * tree_.leaf_unit()) {
                return complain(number, "has a leaf out of its place");
            }
            contents[node.node_children + i] = leaf.box();
            const DecodedBox inner = region.intersection(node.boxes[node.node_children + i]);
            if (auto problem = check_leaf_(leaf, inner)) return complain(number, "has a leaf in which " + *problem);
            counts_.triangles += leaf.triangle_count;
            end = leaf.at + leaf.bytes;
        }
        counts_.leaf_bytes = (end + 3) / 4 * 4;
        return true;
    }

    /// Whether a box of a plain node is the least around its content.
    [[nodiscard]] bool is_least(const DecodedBox& box, const DecodedBox& content) const {
        const unsigned unit = format::unit_shift(tree_.bits);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (box.lo[axis] >> unit != content.lo[axis] >> unit || box.hi[axis] >> unit != content.hi[axis] >> unit)
                return false;
        return true;
    }

    bool check_ends(std::uint32_t number, const DecodedNode& node) {
        for (unsigned child = 0; child < node.children(); ++child) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const std::int32_t end = node.boxes[child].hi[axis];
                if (end < ends_[axis]) continue;
                return complain(number, "has a box that ends too far beyond the asset: on " +
                                            std::string(axis_names[axis]) + " that of its child " +
                                            std::to_string(child) + " ends at " + std::to_string(end) +
                                            ", the asset at " + std::to_string(tree_.extent[axis]) +
                                            ", so that boxes must end below " + std::to_string(ends_[axis]));
            }
        }
        return true;
    }

    bool complain(std::uint32_t number, const std::string& what) {
        const std::size_t at = format::header::bytes + number * format::node_bytes(tree_.profile);
        complaint = "node " + std::to_string(number) + " (byte " + std::to_string(at) + ") " + what;
        return false;
    }

    bool complain_about_box(std::uint32_t number, unsigned child, const DecodedNode& node, const DecodedBox& content) {
        const DecodedBox& box = node.boxes[child];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (box.lo[axis] <= content.lo[axis] && content.hi[axis] <= box.hi[axis]) continue;
            return complain(number, "does not hold what is below its child " + std::to_string(child) + ": on " +
                                        axis_names[axis] + " the box goes from " + std::to_string(box.lo[axis]) +
                                        " to " + std::to_string(box.hi[axis]) + ", the vertices from " +
                                        std::to_string(content.lo[axis]) + " to " + std::to_string(content.hi[axis]));
        }
        return false;
    }

    const TreeBytes& tree_;
    LeafCheck check_leaf_;
    TreeCounts& counts_;
    Coordinates ends_{};
};

}  // namespace

std::optional<std::string> check_tree(const TreeBytes& tree, LeafCheck check_leaf, TreeCounts& counts) {
    counts = {};
    if (!tree.nodes.empty()) {
        counts.nodes = 1;
        constexpr std::int32_t beyond = 1 << 30;
        const DecodedBox everywhere{{-beyond, -beyond, -beyond}, {beyond, beyond, beyond}};
        DecodedBox all;
        TreeWalk walk(tree, check_leaf, counts);
        if (!walk.visit(0, 1, everywhere, all)) return walk.complaint;
    }
    if (counts.nodes * format::node_bytes(tree.profile) != tree.nodes.size()) {
        return "the tree has " + std::to_string(counts.nodes) + " nodes, the node section " +
               std::to_string(tree.nodes.size()) + " bytes";
    }
    if (counts.leaf_bytes != tree.leaves.size()) {
        return "the leaves take " + std::to_string(counts.leaf_bytes) + " bytes, their section " +
               std::to_string(tree.leaves.size());
    }
    return std::nullopt;
}

}  // namespace espalier::baker
