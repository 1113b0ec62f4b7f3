#include "structures.hpp"

namespace espalier::bench {
namespace {

constexpr std::size_t bins = 32, most_with_all_planes = 200;
/// Rays take as long with two thirds or twice this ratio; the bytes and the time of boxes are less than with the
/// higher.
constexpr double node_cost = 20.0, triangle_cost = 15.0, empty_bonus = 0.8;

}  // namespace

KdTree::KdTree(std::span<const FloatTriangle> triangles, float margin, const FloatTest* float_test)
    : CellStructure("k-d tree", triangles, margin, float_test) {
    most_depth_ = 8 + static_cast<unsigned>(1.3 * std::log2(static_cast<double>(triangles.size())));
    std::vector<std::uint32_t> all(triangles.size());
    std::iota(all.begin(), all.end(), std::uint32_t{0});
    build(box_, std::move(all), 0);
    stack_.resize(most_depth_ + 1);
    finish(nodes_.size(), nodes_.size() * sizeof(KdNode));
}

/// The best plane of a node so far, by expected cost.
class KdTree::SplitSearch {
public:
    SplitSearch(const Aabb& box, std::size_t triangles)
        : box_(box), least_(triangle_cost * static_cast<double>(triangles)) {
        for (std::size_t k = 0; k < 3; ++k) side_[k] = double(box.high[k]) - double(box.low[k]);
        area_ = side_[0] * side_[1] + side_[1] * side_[2] + side_[2] * side_[0];
    }
    [[nodiscard]] double side(std::size_t axis) const { return side_[axis]; }
    void try_plane(std::size_t axis, double at, std::size_t below, std::size_t above) {
        const double low = at - double(box_.low[axis]), high = double(box_.high[axis]) - at;
        if (!(low > 0.0 && high > 0.0)) return;
        const double across = side_[(axis + 1) % 3] * side_[(axis + 2) % 3];
        const double around = side_[(axis + 1) % 3] + side_[(axis + 2) % 3];
        const double work = (across + low * around) * static_cast<double>(below) +
                            (across + high * around) * static_cast<double>(above);
        const double bonus = below == 0 || above == 0 ? empty_bonus : 1.0;
        const double cost = bonus * (node_cost + triangle_cost * work / area_);
        if (cost >= least_) return;
        least_ = cost;
        best_ = {axis, static_cast<float>(at)};
    }
    [[nodiscard]] Split best() const { return best_; }

private:
    const Aabb& box_;
    std::array<double, 3> side_{};
    double area_ = 0.0, least_;
    Split best_;
};

/// Tries the planes beside the ends of all triangles.
void KdTree::try_ends(SplitSearch& search, std::size_t axis, std::span<const std::uint32_t> triangles) const {
    std::vector<float> lows, highs;
    for (const std::uint32_t i : triangles) {
        const Aabb around = grown(box_of(triangles_[i]), margin_);
        lows.push_back(around.low[axis]);
        highs.push_back(around.high[axis]);
    }
    std::sort(lows.begin(), lows.end());
    std::sort(highs.begin(), highs.end());
    const auto try_at = [&](double at) {
        const auto plane = static_cast<float>(at);
        search.try_plane(axis, at,
                         static_cast<std::size_t>(std::upper_bound(lows.begin(), lows.end(), plane) - lows.begin()),
                         static_cast<std::size_t>(highs.end() - std::lower_bound(highs.begin(), highs.end(), plane)));
    };
    for (const float low : lows) try_at(double(low) - double(margin_));
    for (const float high : highs) try_at(double(high) + double(margin_));
}

/// Tries planes at equal distances.
void KdTree::try_bins(SplitSearch& search, std::size_t axis, const Aabb& box,
                      std::span<const std::uint32_t> triangles) const {
    std::array<std::size_t, bins> begins{}, ends{};
    const double low = double(box.low[axis]), side = search.side(axis);
    const auto bin_of = [&](float coordinate) {
        return static_cast<std::size_t>(std::clamp((double(coordinate) - low) / side * bins, 0.0, bins - 1.0));
    };
    for (const std::uint32_t i : triangles) {
        const Aabb around = box_of(triangles_[i]);
        ++begins[bin_of(around.low[axis])];
        ++ends[bin_of(around.high[axis])];
    }
    std::size_t below = 0, above = triangles.size();
    for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
        below += begins[bin];
        above -= ends[bin];
        search.try_plane(axis, low + static_cast<double>(bin + 1) / bins * side, below, above);
    }
}

KdTree::Split KdTree::best_split(const Aabb& box, std::span<const std::uint32_t> triangles) const {
    SplitSearch search(box, triangles.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(search.side(axis) > 0.0)) continue;
        if (triangles.size() <= most_with_all_planes) try_ends(search, axis, triangles);
        else try_bins(search, axis, box, triangles);
    }
    return search.best();
}

void KdTree::build(const Aabb& box, std::vector<std::uint32_t> triangles, unsigned depth) {
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    const Split split = depth < most_depth_ && !triangles.empty() ? best_split(box, triangles) : Split{};
    if (split.axis == 3) {
        nodes_[index].first = static_cast<std::uint32_t>(references_.size());
        nodes_[index].axis_and_rest = static_cast<std::uint32_t>(triangles.size()) << 2 | 3u;
        references_.insert(references_.end(), triangles.begin(), triangles.end());
        return;
    }
    Aabb low_box = box, high_box = box;
    low_box.high[split.axis] = split.at;
    high_box.low[split.axis] = split.at;
    const TriangleBoxTest in_low(grown(low_box, margin_)), in_high(grown(high_box, margin_));
    std::vector<std::uint32_t> low, high;
    for (const std::uint32_t i : triangles) {
        const Corners3 corners = corners_of(triangles_[i]);
        if (in_low.touches(corners)) low.push_back(i);
        if (in_high.touches(corners)) high.push_back(i);
    }
    triangles = {};
    build(low_box, std::move(low), depth + 1);
    nodes_[index].split = split.at;
    nodes_[index].axis_and_rest =
        static_cast<std::uint32_t>(nodes_.size()) << 2 | static_cast<std::uint32_t>(split.axis);
    build(high_box, std::move(high), depth + 1);
}

double KdTree::closest(const Ray& ray, RayWork& work) {
    const FloatRay from(ray);
    double nearest = std::numeric_limits<double>::infinity();
    float enter = 0.0f, leave = 0.0f;
    if (!from.meets_box(box_, enter, leave)) return nearest;
    std::size_t waiting = 0;
    std::uint32_t index = 0;
    for (;;) {
        const KdNode& node = nodes_[index];
        ++work.box_tests;
        if (!node.is_leaf()) {
            const std::size_t axis = node.axis();
            const float at = (node.split - from.origin[axis]) * from.inverse[axis];
            const bool is_low_first =
                from.origin[axis] < node.split || (from.origin[axis] == node.split && from.direction[axis] <= 0.0f);
            const std::uint32_t first = is_low_first ? index + 1 : node.rest();
            const std::uint32_t second = is_low_first ? node.rest() : index + 1;
            if (at > leave || at <= 0.0f) {
                index = first;
            } else if (at < enter) {
                index = second;
            } else {
                stack_[waiting++] = {second, at, leave};
                index = first;
                leave = at;
            }
            continue;
        }
        for (const std::uint32_t i : triangles_of(node)) {
            ++work.triangle_tests;
            nearest = std::min(nearest, from.hit(triangles_[i], i, float_test_));
        }
        if (waiting == 0 || nearest <= static_cast<double>(leave)) return nearest;
        const Waiting& next = stack_[--waiting];
        index = next.node, enter = next.enter, leave = next.leave;
    }
}

std::size_t KdTree::count_touching(const Aabb& box, RayWork& work) {
    const TriangleBoxTest test(box);
    std::size_t touching = 0;
    mailboxes_.begin_query();
    boxes_stack_.assign(1, 0);
    while (!boxes_stack_.empty()) {
        const std::uint32_t index = boxes_stack_.back();
        boxes_stack_.pop_back();
        const KdNode& node = nodes_[index];
        ++work.box_tests;
        if (!node.is_leaf()) {
            if (box.high[node.axis()] >= node.split) boxes_stack_.push_back(node.rest());
            if (box.low[node.axis()] <= node.split) boxes_stack_.push_back(index + 1);
            continue;
        }
        for (const std::uint32_t i : triangles_of(node)) {
            if (!mailboxes_.take(i)) continue;
            ++work.triangle_tests;
            touching += test.touches(corners_of(triangles_[i])) ? 1u : 0u;
        }
    }
    return touching;
}

}  // namespace espalier::bench
