// A volume of one hierarchy against a volume of another one, which is placed. What is the same for all pairs is
// computed once for a pose, and what is the same for all pairs of a placed volume once for that volume.
#pragma once

#include "../study/walks.hpp"
#include "trees.hpp"
#include "volume_tests.hpp"

namespace espalier::bench {

/// A pose for volumes of one kind. `placed` returns a volume of the second hierarchy as tests take it, and `touch`
/// tests it against a volume of the first.
template <class Stored>
class PreparedPose;

/// For volumes whose tests need the placement as it is.
class ByPlacement {
public:
    explicit ByPlacement(const Placement& placement) : placement_(&placement) {}

protected:
    const Placement* placement_;
};

/// Tests the distance of the centers.
template <>
class PreparedPose<StoredSphere> : ByPlacement {
public:
    using Placed = StoredSphere;
    using ByPlacement::ByPlacement;
    [[nodiscard]] Placed placed(const StoredSphere& b) const {
        Placed moved;
        place(*placement_, b.center, moved.center);
        moved.radius = b.radius;
        return moved;
    }
    [[nodiscard]] bool touch(const StoredSphere& a, const Placed& b) const {
        float out[3];
        for (int i = 0; i < 3; ++i) out[i] = b.center[i] - a.center[i];
        const float reach = a.radius + b.radius;
        return dot3(out, out) <= reach * reach;
    }
};

/// A placed box is an oriented one, so all boxes of a hierarchy are turned alike.
template <>
class PreparedPose<StoredAabb> : ByPlacement {
public:
    using Placed = StoredAabb;
    using ByPlacement::ByPlacement;
    [[nodiscard]] Placed placed(const StoredAabb& b) const {
        Placed moved = b;
        place(*placement_, b.center, moved.center);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredAabb& a, const Placed& b) const {
        float t[3];
        for (int i = 0; i < 3; ++i) t[i] = b.center[i] - a.center[i];
        return boxes_touch(a.half, b.half, placement_->rotation, placement_->magnitude, t);
    }
};

/// Each pair of boxes has a rotation of its own.
template <>
class PreparedPose<StoredObb> : ByPlacement {
public:
    using Placed = StoredObb;
    using ByPlacement::ByPlacement;
    [[nodiscard]] Placed placed(const StoredObb& b) const {
        Placed moved = b;
        place(*placement_, b.center, moved.center);
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) moved.axes[j][i] = dot3(placement_->rotation[i], b.axes[j]);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredObb& a, const Placed& b) const {
        float out[3], t[3], r[3][3], m[3][3];
        for (int i = 0; i < 3; ++i) out[i] = b.center[i] - a.center[i];
        for (int i = 0; i < 3; ++i) {
            t[i] = dot3(a.axes[i], out);
            for (int j = 0; j < 3; ++j) {
                r[i][j] = dot3(a.axes[i], b.axes[j]);
                m[i][j] = std::abs(r[i][j]) + nearly_parallel;
            }
        }
        return boxes_touch(a.half, b.half, r, m, t);
    }

private:
    static constexpr float nearly_parallel = 1e-6f;  ///< for edges whose cross product is almost zero
};

/// Encloses the second k-DOP in one with the normals of the first, and tests k / 2 intervals.
template <std::size_t k>
class PreparedPose<StoredDop<k>> {
public:
    using Placed = StoredDop<k>;
    explicit PreparedPose(const Placement& placement) : turn_(placement.exact) {}
    [[nodiscard]] Placed placed(const StoredDop<k>& b) const {
        Placed moved;
        turn_.enclose(b.reach, moved.reach);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredDop<k>& a, const Placed& b) const {
        for (std::size_t i = 0; i < k / 2; ++i)
            if (a.reach[i] + b.reach[i + k / 2] < 0.0f || b.reach[i] + a.reach[i + k / 2] < 0.0f) return false;
        return true;
    }

private:
    DopTurn<k> turn_;
};

/// A walk in which all children of both nodes replace a pair, so that each child is placed once for two tests: the same
/// steps for all kinds, so that these alone make a difference. `Pose` tests the volumes, as PreparedPose does.
template <class Pose, class Stored>
class VolumePairWalk {
public:
    VolumePairWalk(const NodesOfTree<Stored>& a, const NodesOfTree<Stored>& b)
        : a_(a), b_(b), stack_(3 * (std::size_t{a.tree->height} + b.tree->height) + 1) {}

    /// Calls `visit(a, b)` for each pair of volumes that is tested.
    template <class Visit>
    [[nodiscard]] PairWork run(PairQuestion question, const Placement& placement, const Visit& visit) {
        const Pose pose(placement);
        const TrianglePairTest triangles(*a_.tree, *b_.tree, placement, question);
        PairWork work;
        std::size_t size = 0;
        const auto push_touching = [&](const Range& of_a, const Range& of_b) {
            for (std::uint32_t b = of_b.first; b < of_b.end; ++b) {
                const typename Pose::Placed placed = pose.placed(b_.nodes[b]);
                for (std::uint32_t a = of_a.first; a < of_a.end; ++a) {
                    ++work.box_tests;
                    visit(a, b);
                    if (pose.touch(a_.nodes[a], placed)) stack_[size++] = {a, b};
                }
            }
        };
        push_touching({0, 1}, {0, 1});
        while (size > 0) {
            const Entry top = stack_[--size];
            const auto& a = a_.nodes[top.a];
            const auto& b = b_.nodes[top.b];
            if (!a.is_leaf() || !b.is_leaf()) {
                push_touching(a.is_leaf() ? Range{top.a, top.a + 1} : Range{a.first, a.first + 2},
                              b.is_leaf() ? Range{top.b, top.b + 1} : Range{b.first, b.first + 2});
                continue;
            }
            triangles.test(a_.tree->triangles_of(a), b_.tree->triangles_of(b), work);
            if (triangles.is_over(work)) break;
        }
        return work;
    }
    [[nodiscard]] PairWork run(PairQuestion question, const Placement& placement) {
        return run(question, placement, [](std::uint32_t, std::uint32_t) {});
    }

private:
    struct Entry {
        std::uint32_t a;
        std::uint32_t b;
    };
    struct Range {
        std::uint32_t first;
        std::uint32_t end;
    };
    NodesOfTree<Stored> a_, b_;
    std::vector<Entry> stack_;
};

}  // namespace espalier::bench
