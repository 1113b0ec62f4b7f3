#include "build_sah.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <exception>
#include <thread>

#include "sah_split.hpp"

namespace espalier::baker {

namespace {

constexpr std::uint32_t smallest_parallel = 4096;     // below this a thread costs more than it brings
constexpr std::uint32_t progress_interval = 1 << 16;  // triangles between two calls

class Builder {
public:
    Builder(std::span<Reference> references, BinaryNode* nodes, const BuildSettings& settings)
        : references_(references),
          nodes_(nodes),
          settings_(settings),
          caller_(std::this_thread::get_id()) {}

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
        const auto child_height = static_cast<unsigned>(std::bit_width(range.count - 2));
        const bool must_balance = depth + 1 + child_height > settings_.most_height;
        const auto [left, right] =
            split(references, range, must_balance ? SplitRule{0, 0} : SplitRule{settings_.bins, settings_.exact_below});
        const std::size_t left_node = node + 1;
        const std::size_t right_node = left_node + subtree_nodes(left.count);
        if (threads > 1 && range.count >= smallest_parallel) {
            build_both(left, left_node, right, right_node, depth + 1, threads);
        } else {
            build(left, left_node, depth + 1, 1);
            build(right, right_node, depth + 1, 1);
        }
    }

private:
    void build_both(const SplitRange& left, std::size_t left_node, const SplitRange& right, std::size_t right_node,
                    unsigned depth, unsigned threads) {
        const double share = static_cast<double>(left.count) / (static_cast<double>(left.count) + right.count);
        const unsigned left_threads = std::clamp(static_cast<unsigned>(share * threads + 0.5), 1u, threads - 1);
        std::jthread helper;  // joins on every way out
        try {
            helper = std::jthread([&, left_threads] { build(left, left_node, depth, left_threads); });
        } catch (const std::exception&) {
            // The machine gives no more threads: the same work in this one.
            build(left, left_node, depth, 1);
        }
        build(right, right_node, depth, threads - left_threads);
    }

    void report_placed() {
        if (!settings_.progress) return;
        const std::uint32_t placed = placed_.fetch_add(1, std::memory_order_relaxed) + 1;
        if (std::this_thread::get_id() != caller_ || placed < next_report_) return;
        next_report_ = placed + progress_interval;
        settings_.progress(static_cast<double>(placed) / static_cast<double>(references_.size()));
    }

    std::span<Reference> references_;
    BinaryNode* nodes_;
    const BuildSettings& settings_;
    std::thread::id caller_;
    std::atomic<std::uint32_t> placed_ = 0;
    std::uint32_t next_report_ = progress_interval;  // the calling thread's alone
};

}  // namespace

BuildSettings build_settings(unsigned effort, unsigned threads) {
    constexpr std::array<unsigned, 10> bins = {16, 16, 24, 24, 32, 32, 48, 48, 64, 64};
    constexpr std::array<unsigned, 10> exact_below = {4, 8, 8, 16, 16, 16, 32, 64, 128, 256};
    BuildSettings settings;
    settings.bins = bins[effort];
    settings.exact_below = exact_below[effort];
    settings.threads = threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
    return settings;
}

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
    Builder({references.get(), count}, tree.nodes.get(), settings).build(all, 0, 0, settings.threads);
    tree.triangles.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) tree.triangles[i] = references[i].triangle;
    return tree;
}

}  // namespace espalier::baker
