// Walks through trees of volumes of any kind: the same steps, so that the kinds alone make a difference.

#include "trees.hpp"

#include "pair_walk.hpp"

namespace espalier::bench {
namespace {

/// Finds the closest hit of a ray, the nearer of two children first, as section 7 of the guide describes.
template <class Stored>
class VolumeRayWalk {
public:
    explicit VolumeRayWalk(const VolumeTree<Stored>& tree) : tree_(&tree), stack_(tree.topology->height + 1) {}

    /// Returns t of the closest hit, or infinity. Calls `visit(node)` for each volume that is tested.
    template <class Visit>
    double closest(const Ray& ray, VolumeWork& work, const Visit& visit) {
        const PreparedRay<Stored> prepared(ray);
        const Line line = {point_of(ray.origin), point_of(ray.direction)};
        double nearest = std::numeric_limits<double>::infinity();
        const auto entry = [&](std::uint32_t node) {
            ++work.volume_tests;
            visit(node);
            return prepared.entry(tree_->nodes[node].volume);
        };
        const auto is_ahead = [&](float at) { return at != no_entry && static_cast<double>(at) <= nearest; };
        std::size_t size = 0;
        stack_[size++] = {0, entry(0)};
        while (size > 0) {
            const Waiting top = stack_[--size];
            if (!is_ahead(top.entry)) continue;
            std::uint32_t index = top.node;
            while (tree_->nodes[index].count == 0) {
                const std::uint32_t first = tree_->nodes[index].first;
                Waiting near = {first, entry(first)}, far = {first + 1, entry(first + 1)};
                if (far.entry < near.entry) std::swap(near, far);
                if (!is_ahead(near.entry)) break;
                if (is_ahead(far.entry)) stack_[size++] = far;
                index = near.node;
            }
            const auto& leaf = tree_->nodes[index];
            work.triangle_tests += leaf.count;
            if (leaf.count == 0) continue;
            for (const FloatTriangle& triangle : tree_->triangles_of(leaf))
                if (const auto at = meets(corners_of(triangle), line)) nearest = std::min(nearest, *at);
        }
        return nearest;
    }
    double closest(const Ray& ray, VolumeWork& work) {
        return closest(ray, work, [](std::uint32_t) {});
    }

private:
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    const VolumeTree<Stored>* tree_;
    std::vector<Waiting> stack_;
};

/// Counts the triangles that a ball touches.
template <class Stored>
class VolumeBallWalk {
public:
    explicit VolumeBallWalk(const VolumeTree<Stored>& tree) : tree_(&tree), stack_(tree.topology->height + 2) {}

    [[nodiscard]] std::uint64_t count(const Ball& ball, VolumeWork& work) {
        const PreparedBall<Stored> prepared(ball);
        std::uint64_t touching = 0;
        std::size_t size = 0;
        stack_[size++] = 0;
        while (size > 0) {
            const auto& node = tree_->nodes[stack_[--size]];
            ++work.volume_tests;
            if (!prepared.touches(node.volume)) continue;
            if (node.count == 0) {
                stack_[size++] = node.first + 1;
                stack_[size++] = node.first;
                continue;
            }
            work.triangle_tests += node.count;
            for (const FloatTriangle& triangle : tree_->triangles_of(node))
                touching += touches(corners_of(triangle), ball) ? 1u : 0u;
        }
        return touching;
    }

private:
    const VolumeTree<Stored>* tree_;
    std::vector<std::uint32_t> stack_;
};

}  // namespace

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
        : tree_(topology, volumes), rays_(tree_), balls_(tree_), pairs_(tree_.all_nodes(), tree_.all_nodes()) {}
    [[nodiscard]] Kind kind() const override { return Stored::kind; }
    [[nodiscard]] std::size_t volume_bytes() const override { return sizeof(Stored); }
    [[nodiscard]] std::size_t node_bytes() const override { return sizeof(VolumeNode<Stored>); }

    [[nodiscard]] double closest(const Ray& ray, VolumeWork& work) override { return rays_.closest(ray, work); }
    [[nodiscard]] std::uint64_t touching(const Ball& ball, VolumeWork& work) override {
        return balls_.count(ball, work);
    }
    [[nodiscard]] std::uint64_t touching(const Placement& placement, VolumeWork& work) override {
        const PairWork pairs = pairs_.run(PairQuestion::all, placement);
        work.volume_tests += pairs.box_tests;
        work.triangle_tests += pairs.triangle_tests;
        return pairs.pairs;
    }
    [[nodiscard]] RayTests tests_of(const Ray& ray) override {
        RayTests tests{ray, {}};
        VolumeWork work;
        static_cast<void>(rays_.closest(ray, work, [&](std::uint32_t node) { tests.nodes.push_back(node); }));
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
