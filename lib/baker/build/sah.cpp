#include <baker/build/sah.hpp>

#include <atomic>

#include <baker/base/fork_join.hpp>
#include <baker/base/threads.hpp>

namespace espalier::baker {

namespace {

constexpr std::uint32_t splits_between_reports = 1 << 16;  // triangles between two calls

class SahBuilder {
public:
    SahBuilder(std::span<Reference> references, BinaryNode* nodes, const BuildSettings& settings)
        : references_(references), nodes_(nodes), settings_(settings), caller_(this_thread()) {}

    void build(const SplitRange& range, std::size_t node, unsigned depth, unsigned threads) {
        const auto references = references_.subspan(range.first, range.count);
        BinaryNode& written = nodes_[node];
        std::memcpy(&written, &range.box, sizeof written);
        written.first = range.first;
        written.count = range.count;
        if (range.count == 1) {
            report_placed();
            return;
        }
        // Every split leaves at least one triangle on each side, so a child has at most count - 1; when a balanced tree
        // over that many would no longer fit below this node, this split is balanced, and by the same test all further
        // ones.
        const bool must_balance = !leaves_room(depth, range.count - 1, settings_.most_height);
        const SplitRule rule =
            must_balance ? SplitRule{0, 0, 0} : SplitRule{settings_.bins, settings_.exact_below, settings_.full_leaf};
        const std::pair<SplitRange, SplitRange> parts = split(references, range, rule);
        const SplitRange& left = parts.first;
        const SplitRange& right = parts.second;
        const std::size_t left_node = node + 1;
        const std::size_t right_node = left_node + subtree_nodes(left.count);
        fork_join(
            threads, left.count, right.count, [&](unsigned share) { build(left, left_node, depth + 1, share); },
            [&](unsigned share) { build(right, right_node, depth + 1, share); });
    }

private:
    void report_placed() {
        if (!settings_.progress) return;
        const std::uint32_t placed = placed_.fetch_add(1, std::memory_order_relaxed) + 1;
        if (this_thread() != caller_ || placed < next_report_) return;
        next_report_ = placed + splits_between_reports;
        settings_.progress(static_cast<double>(placed) / static_cast<double>(references_.size()));
    }

    std::span<Reference> references_;
    BinaryNode* nodes_;
    const BuildSettings& settings_;
    ThreadId caller_;
    std::atomic<std::uint32_t> placed_ = 0;
    std::uint32_t next_report_ = splits_between_reports;  // the calling thread's alone
};

}  // namespace

BinaryTree build_sah(const LatticeMesh& mesh, const BuildSettings& settings) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    const auto references = std::make_unique_for_overwrite<Reference[]>(count);
    SplitRange all{0, count, {}, {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        const LaneBox box = put_reference(mesh, i, references[i]);
        all.box.add(box);
        all.centers.add(box.lo + box.hi);
    }
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    SahBuilder({references.get(), count}, tree.nodes.get(), settings).build(all, 0, 0, settings.threads);
    tree.triangles.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) tree.triangles[i] = references[i].triangle;
    return tree;
}

void build_sah_below(std::span<Reference> references, std::uint32_t first, std::uint32_t count, unsigned depth,
                     BinaryNode* nodes, const BuildSettings& settings) {
    SplitRange range{first, count, {}, {}};
    for (const Reference& reference : references.subspan(first, count)) {
        const LaneBox box = lane_box_of(reference);
        range.box.add(box);
        range.centers.add(box.lo + box.hi);
    }
    BuildSettings quiet = settings;
    quiet.progress = nullptr;
    SahBuilder(references, nodes, quiet).build(range, 0, depth, 1);
}

}  // namespace espalier::baker
