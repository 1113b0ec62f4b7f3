#include <baker/build/linear.hpp>

#include <algorithm>

#include <baker/base/fork_join.hpp>
#include <baker/build/morton_order.hpp>
#include <baker/build/sah_split.hpp>

namespace espalier::baker {

namespace {

class LinearBuilder {
public:
    LinearBuilder(const LatticeMesh& mesh, std::span<const MortonEntry> entries, const BuildSettings& settings,
                  BinaryNode* nodes)
        : mesh_(mesh), entries_(entries), settings_(settings), nodes_(nodes) {}

    LaneBox build(std::uint32_t first, std::uint32_t count, std::size_t node, unsigned depth, unsigned threads) {
        LaneBox box;
        if (count == 1) {
            Reference reference;
            box = put_reference(mesh_, entries_[first].triangle, reference);
        } else {
            std::uint32_t left_count = morton_split(entries_.subspan(first, count));
            if (!leaves_room(depth, std::max(left_count, count - left_count), settings_.most_height))
                left_count = count / 2;
            const std::uint32_t right_count = count - left_count;
            LaneBox right;
            fork_join(
                threads, left_count, right_count,
                [&](unsigned share) { box = build(first, left_count, node + 1, depth + 1, share); },
                [&](unsigned share) {
                    right =
                        build(first + left_count, right_count, node + 1 + subtree_nodes(left_count), depth + 1, share);
                });
            box.add(right);
        }
        std::memcpy(&nodes_[node], &box, sizeof(BinaryNode));
        nodes_[node].first = first;
        nodes_[node].count = count;
        return box;
    }

private:
    const LatticeMesh& mesh_;
    std::span<const MortonEntry> entries_;
    const BuildSettings& settings_;
    BinaryNode* nodes_;
};

}  // namespace

BinaryTree build_linear(const LatticeMesh& mesh, const BuildSettings& settings) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    const std::vector<MortonEntry> entries = morton_order(mesh);
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    LinearBuilder(mesh, entries, settings, tree.nodes.get()).build(0, count, 0, 0, settings.threads);
    tree.triangles.reserve(count);
    for (const MortonEntry& entry : entries) tree.triangles.push_back(entry.triangle);
    return tree;
}

}  // namespace espalier::baker
