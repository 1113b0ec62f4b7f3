#include "kinds.hpp"

#include "../deformation/processor_time.hpp"
#include "walks.hpp"

namespace espalier::bench {
namespace {

template <class Stored>
class TreeOf final : public KindOfTree {
public:
    TreeOf(const AabbTree& topology, std::span<const Volumes> volumes)
        : tree_(topology, volumes), rays_(tree_), balls_(tree_), pairs_(tree_) {}
    [[nodiscard]] Kind kind() const override { return Stored::kind; }
    [[nodiscard]] std::size_t volume_bytes() const override { return sizeof(Stored); }
    [[nodiscard]] std::size_t node_bytes() const override { return sizeof(VolumeNode<Stored>); }

    [[nodiscard]] double closest(const Ray& ray, VolumeWork& work) override { return rays_.closest(ray, work); }
    [[nodiscard]] std::uint64_t touching(const Ball& ball, VolumeWork& work) override {
        return balls_.count(ball, work);
    }
    [[nodiscard]] std::uint64_t touching(const Placement& placement, VolumeWork& work) override {
        return pairs_.count(placement, work);
    }
    [[nodiscard]] RayTests tests_of(const Ray& ray) override {
        RayTests tests{ray, {}};
        VolumeWork work;
        static_cast<void>(rays_.closest(ray, work, [&](std::uint32_t node) { tests.nodes.push_back(node); }));
        return tests;
    }
    [[nodiscard]] PairTests tests_of(const Placement& placement) override {
        PairTests tests{placement, {}};
        VolumeWork work;
        static_cast<void>(pairs_.count(placement, work, [&](std::uint32_t a, std::uint32_t b) {
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
                    met += prepared[i].entry(tree_.nodes[node].volume) != no_entry ? 1u : 0u;
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
                    if (b != last) placed = prepared[i].placed(tree_.nodes[b].volume);
                    last = b;
                    met += prepared[i].touch(tree_.nodes[a].volume, placed) ? 1u : 0u;
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

    VolumeTree<Stored> tree_;
    VolumeRayWalk<Stored> rays_;
    VolumeBallWalk<Stored> balls_;
    VolumePairWalk<Stored> pairs_;
};

}  // namespace

std::string_view name_of(Kind kind) {
    switch (kind) {
        case Kind::sphere:
            return "sphere";
        case Kind::aabb:
            return "aabb";
        case Kind::obb:
            return "obb";
        case Kind::dop_14:
            return "dop_14";
        case Kind::dop_18:
            return "dop_18";
        case Kind::dop_26:
            return "dop_26";
    }
    return "";
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
