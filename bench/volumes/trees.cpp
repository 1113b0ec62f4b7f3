// Walks through trees of volumes of any kind: the same steps, so that the kinds alone make a difference.

#include "trees.hpp"

#include "pair_walk.hpp"

namespace espalier::bench {
std::vector<Volumes> fit_nodes(const AabbTree& topology) {
    std::vector<Volumes> volumes;
    for (const TriangleRange& range : triangle_ranges(topology))
        volumes.push_back(fit_volumes(corners_in(topology, range)));
    return volumes;
}

namespace {

template <class Stored>
class TreeOf final : public KindOfTree {
public:
    TreeOf(const AabbTree& topology, std::span<const Volumes> volumes)
        : nodes_(stored(topology, volumes)), tree_{&topology, nodes_}, rays_(tree_), pairs_(tree_, tree_) {}
    [[nodiscard]] Kind kind() const override { return Stored::kind; }
    [[nodiscard]] std::size_t volume_bytes() const override { return sizeof(Stored); }
    [[nodiscard]] std::size_t node_bytes() const override { return sizeof(VolumeNode<Stored>); }

    [[nodiscard]] double closest(const Ray& ray, RayWork& work) override { return rays_.closest_by(ray, work); }
    [[nodiscard]] std::uint64_t touching(const Ball& ball, RayWork& work) override {
        const PreparedBall<Stored> prepared(ball);
        return count_touching(
            tree_, stack_, work, [&](const Stored& volume) { return prepared.touches(volume); },
            [&](const Corners3& triangle) { return touches(triangle, ball); });
    }
    [[nodiscard]] std::uint64_t touching(const Placement& placement, RayWork& work) override {
        const PairWork pairs = pairs_.run(PairQuestion::all, placement);
        work.box_tests += pairs.box_tests;
        work.triangle_tests += pairs.triangle_tests;
        return pairs.pairs;
    }
    [[nodiscard]] RayTests tests_of(const Ray& ray) override {
        RayTests tests{ray, {}};
        RayWork work;
        static_cast<void>(rays_.closest_by(ray, work, [&](std::uint32_t node) { tests.nodes.push_back(node); }));
        return tests;
    }
    [[nodiscard]] PairTests tests_of(const Placement& placement) override {
        PairTests tests{placement, {}};
        static_cast<void>(pairs_.run(PairQuestion::all, placement, [&](std::uint32_t a, std::uint32_t b) {
            tests.nodes.push_back({a, b});
        }));
        return tests;
    }
    [[nodiscard]] double time_of(std::span<const RayTests> tests, unsigned repetitions) const override {
        std::vector<PreparedRay<Stored>> prepared;
        for (const RayTests& of_ray : tests) prepared.emplace_back(of_ray.ray);
        return time_tests(repetitions, [&](std::size_t& count) {
            unsigned met = 0;
            for (std::size_t i = 0; i < tests.size(); ++i)
                for (const std::uint32_t node : tests[i].nodes) {
                    met += prepared[i].entry(tree_.nodes[node]) != no_entry ? 1u : 0u;
                    ++count;
                }
            return met;
        });
    }
    [[nodiscard]] double time_of(std::span<const PairTests> tests, unsigned repetitions) const override {
        std::vector<PreparedPose<Stored>> prepared;
        for (const PairTests& of_pose : tests) prepared.emplace_back(of_pose.placement);
        return time_tests(repetitions, [&](std::size_t& count) {
            unsigned met = 0;
            for (std::size_t i = 0; i < tests.size(); ++i) {
                typename PreparedPose<Stored>::Placed placed;
                auto last = std::uint32_t(-1);
                for (const auto& [a, b] : tests[i].nodes) {
                    if (b != last) placed = prepared[i].placed(tree_.nodes[b]);
                    last = b;
                    met += prepared[i].touch(tree_.nodes[a], placed) ? 1u : 0u;
                    ++count;
                }
            }
            return met;
        });
    }

private:
    /// `make` makes the tests once and adds their number. Once more is not timed: it fills the cache.
    template <class Make>
    static double time_tests(unsigned repetitions, const Make& make) {
        std::size_t count = 0;
        volatile unsigned kept = make(count);  // so that no compiler drops the tests
        count = 0;
        const ProcessorTime time;
        for (unsigned i = 0; i < repetitions; ++i) kept = make(count);
        static_cast<void>(kept);
        return 1e9 * time.seconds() / static_cast<double>(count);
    }

    static std::vector<VolumeNode<Stored>> stored(const AabbTree& topology, std::span<const Volumes> volumes) {
        const double margin = stored_margin_share * static_cast<double>(topology.largest);
        std::vector<VolumeNode<Stored>> nodes(topology.nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            store(volumes[i], margin, nodes[i]);
            nodes[i].first = topology.nodes[i].first;
            nodes[i].count = topology.nodes[i].count;
        }
        return nodes;
    }

    std::vector<VolumeNode<Stored>> nodes_;
    NodesOfTree<Stored> tree_;
    VolumeRayWalk<Stored> rays_;
    std::vector<std::uint32_t> stack_;
    VolumePairWalk<PreparedPose<Stored>, Stored> pairs_;
};

}  // namespace

std::string_view name_of(Kind kind) {
    constexpr const char* names[] = {"sphere", "aabb", "obb", "dop_14", "dop_18", "dop_26"};
    return names[static_cast<std::size_t>(kind)];
}

std::vector<std::unique_ptr<KindOfTree>> trees_of_all_kinds(const AabbTree& topology,
                                                            std::span<const Volumes> volumes) {
    std::vector<std::unique_ptr<KindOfTree>> trees;
    trees.push_back(std::make_unique<TreeOf<StoredSphere>>(topology, volumes));
    trees.push_back(std::make_unique<TreeOf<StoredAabb>>(topology, volumes));
    trees.push_back(std::make_unique<TreeOf<StoredObb>>(topology, volumes));
    trees.push_back(std::make_unique<TreeOf<StoredDop<14>>>(topology, volumes));
    trees.push_back(std::make_unique<TreeOf<StoredDop<18>>>(topology, volumes));
    trees.push_back(std::make_unique<TreeOf<StoredDop<26>>>(topology, volumes));
    return trees;
}

}  // namespace espalier::bench
