#include <baker/build/agglomerative.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include <baker/base/fork_join.hpp>
#include <baker/build/morton_order.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/build/tree_shape.hpp>

namespace espalier::baker {

namespace {

/// A subtree without a parent. It owns the number of an inner node that nobody uses yet: every triangle starts with
/// one, and of two that are joined one number is used and the other stays. So threads need not agree on numbers.
struct Cluster {
    LaneBox box;
    std::uint32_t node;
    std::uint32_t spare;
};
using Clusters = std::vector<Cluster>;

/// The clusters that a part of `count` triangles hands up: delta^(1/2 + e) / 2 * count^(1/2 - e) with e = 0.1 (Gu et
/// al. 2013, section 3.2), in products of which every machine rounds the same.
std::size_t clusters_of(unsigned delta, std::uint32_t count) {
    const double power = static_cast<double>(delta) * delta * delta * count * count;  // (2 * clusters)^5 at most
    std::size_t least = 1;
    std::size_t most = count;
    while (least < most) {
        const std::size_t middle = least + (most - least + 1) / 2;
        const double twice = 2.0 * static_cast<double>(middle);
        if (twice * twice * twice * twice * twice <= power) least = middle;
        else most = middle - 1;
    }
    return least;
}

float distance(const Cluster& a, const Cluster& b) {
    LaneBox both = a.box;
    both.add(b.box);
    return both.half_area();
}

/// Joins the nearest two again and again. Joining moves clusters only further away from others, rounding included: a
/// known distance to a cluster that is no more bounds the distance to the nearest one from below, and need not be
/// measured again before it is the smallest of all.
class Joiner {
public:
    Joiner(Clusters& clusters, std::vector<std::array<std::uint32_t, 2>>& children, std::uint32_t triangle_count)
        : clusters_(clusters), children_(children), triangle_count_(triangle_count), nearest_(clusters.size()) {
        for (std::size_t i = 0; i < clusters_.size(); ++i) find_nearest(i);
    }

    void join_until(std::size_t target) {
        while (clusters_.size() > target) {
            std::size_t best = 0;
            for (std::size_t i = 1; i < nearest_.size(); ++i) {
                if (nearest_[i].distance < nearest_[best].distance) best = i;
            }
            if (nearest_[best].is_known) join(best, nearest_[best].other);
            else find_nearest(best);
        }
    }

private:
    struct Nearest {
        float distance = std::numeric_limits<float>::infinity();
        std::size_t other = 0;
        bool is_known = true;
    };

    void find_nearest(std::size_t from) {
        Nearest nearest;
        for (std::size_t i = 0; i < clusters_.size(); ++i) {
            if (i == from) continue;
            const float here = distance(clusters_[from], clusters_[i]);
            if (here < nearest.distance) nearest = {here, i, true};
        }
        nearest_[from] = nearest;
    }

    void join(std::size_t a, std::size_t b) {
        const auto [first, second] = std::minmax(a, b);
        Cluster& joined = clusters_[first];
        children_[joined.spare] = {joined.node, clusters_[second].node};
        joined.box.add(clusters_[second].box);
        joined.node = triangle_count_ + joined.spare;
        joined.spare = clusters_[second].spare;

        const std::size_t last = clusters_.size() - 1;
        clusters_[second] = clusters_[last];
        nearest_[second] = nearest_[last];
        clusters_.pop_back();
        nearest_.pop_back();
        for (Nearest& nearest : nearest_) {
            if (nearest.other == first || nearest.other == second) nearest.is_known = false;
            else if (nearest.other == last) nearest.other = second;
        }
        if (clusters_.size() > 1) find_nearest(first);
    }

    Clusters& clusters_;
    std::vector<std::array<std::uint32_t, 2>>& children_;
    std::uint32_t triangle_count_;
    std::vector<Nearest> nearest_;
};

class AgglomerativeBuilder {
public:
    AgglomerativeBuilder(const LatticeMesh& mesh, const BuildSettings& settings, TreeShape& shape)
        : mesh_(mesh), delta_(settings.clusters_from), shape_(shape), entries_(morton_order(mesh)) {}

    [[nodiscard]] Clusters build(std::uint32_t first, std::uint32_t count, unsigned threads) {
        Clusters clusters;
        if (count < delta_) {
            clusters.reserve(count);
            for (std::uint32_t i = first; i < first + count; ++i) {
                Reference unused;
                const std::uint32_t triangle = entries_[i].triangle;
                clusters.push_back({put_reference(mesh_, triangle, unused), triangle, i});
            }
            reduce(clusters, clusters_of(delta_, delta_));
            return clusters;
        }
        const std::uint32_t left_count = morton_split(std::span(entries_).subspan(first, count));
        Clusters right;
        fork_join(
            threads, left_count, count - left_count,
            [&](unsigned share) { clusters = build(first, left_count, share); },
            [&](unsigned share) { right = build(first + left_count, count - left_count, share); });
        clusters.insert(clusters.end(), right.begin(), right.end());
        reduce(clusters, clusters_of(delta_, count));
        return clusters;
    }

    void reduce(Clusters& clusters, std::size_t target) {
        if (clusters.size() <= target) return;
        Joiner(clusters, shape_.children, static_cast<std::uint32_t>(entries_.size())).join_until(target);
    }

private:
    const LatticeMesh& mesh_;
    std::uint32_t delta_;
    TreeShape& shape_;
    std::vector<MortonEntry> entries_;
};

}  // namespace

BinaryTree build_agglomerative(const LatticeMesh& mesh, const BuildSettings& settings) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return {};
    TreeShape shape;
    shape.children.resize(count);  // the last spare number is never used
    AgglomerativeBuilder builder(mesh, settings, shape);
    Clusters clusters = builder.build(0, count, settings.threads);
    builder.reduce(clusters, 1);
    shape.root = clusters.front().node;
    return lay_out(mesh, shape, settings);
}

}  // namespace espalier::baker
