#include "fresh_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace espalier::bench {
namespace {

constexpr std::size_t width = 8;
constexpr std::size_t bins = 16;

/// A box that is empty at first.
struct Around {
    float low[3], high[3];
    Around() {
        std::fill_n(low, 3, std::numeric_limits<float>::infinity());
        std::fill_n(high, 3, -std::numeric_limits<float>::infinity());
    }
    explicit Around(const Box& b) : low{b.min.x, b.min.y, b.min.z}, high{b.max.x, b.max.y, b.max.z} {}
    void add(const Around& other) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], other.low[k]);
            high[k] = std::max(high[k], other.high[k]);
        }
    }
    [[nodiscard]] float middle(int k) const { return 0.5f * (low[k] + high[k]); }
    [[nodiscard]] double half_area() const {
        double side[3];
        for (int k = 0; k < 3; ++k) {
            if (high[k] < low[k]) return 0.0;
            side[k] = static_cast<double>(high[k]) - static_cast<double>(low[k]);
        }
        return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
    }
};

/// Some of the objects: they follow one another in the builder's order.
struct Range {
    std::size_t first, last;
    Around box;
    [[nodiscard]] std::size_t count() const { return last - first; }
};

class Builder {
public:
    explicit Builder(std::span<const Box> boxes) : boxes_(boxes.begin(), boxes.end()), order_(boxes.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        build(range(0, order_.size()), 1);
        shape_.area = sum_ / static_cast<double>(boxes.size());
        shape_.fill = static_cast<double>(boxes.size() + shape_.nodes - 1) / static_cast<double>(shape_.nodes);
    }
    [[nodiscard]] const TreeShape& shape() const { return shape_; }

private:
    [[nodiscard]] Range range(std::size_t first, std::size_t last) const {
        Range result = {first, last, {}};
        for (std::size_t i = first; i < last; ++i) result.box.add(boxes_[order_[i]]);
        return result;
    }
    void build(const Range& all, std::size_t depth) {
        ++shape_.nodes;
        shape_.depth = std::max(shape_.depth, depth);
        if (all.count() <= width) {
            for (std::size_t i = all.first; i < all.last; ++i) sum_ += boxes_[order_[i]].half_area();
            return;
        }
        std::vector<Range> parts = {all};
        while (parts.size() < width) {
            Range* largest = nullptr;
            for (Range& part : parts)
                if (part.count() > width && (largest == nullptr || part.box.half_area() > largest->box.half_area()))
                    largest = &part;
            if (largest == nullptr) break;
            const std::size_t middle = split(*largest), last = largest->last;
            *largest = range(largest->first, middle);
            parts.push_back(range(middle, last));
        }
        for (const Range& part : parts) {
            sum_ += part.box.half_area();
            if (part.count() > 1) build(part, depth + 1);
        }
    }
    /// Returns where the second half of a range begins, whose objects are then in order.
    std::size_t split(const Range& all) {
        Around middles;
        for (std::size_t i = all.first; i < all.last; ++i) {
            const Around& box = boxes_[order_[i]];
            for (int k = 0; k < 3; ++k) {
                middles.low[k] = std::min(middles.low[k], box.middle(k));
                middles.high[k] = std::max(middles.high[k], box.middle(k));
            }
        }
        int best_axis = -1;
        std::size_t best_bin = 0;
        double least = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            if (!(middles.high[axis] > middles.low[axis])) continue;
            Around box[bins];
            std::size_t count[bins] = {};
            for (std::size_t i = all.first; i < all.last; ++i) {
                const std::size_t bin = bin_of(middles, axis, order_[i]);
                box[bin].add(boxes_[order_[i]]);
                ++count[bin];
            }
            double behind[bins] = {};
            Around right;
            for (std::size_t bin = bins, objects = 0; bin-- > 1;) {
                right.add(box[bin]);
                behind[bin] = right.half_area() * weight(objects += count[bin]);
            }
            Around left;
            for (std::size_t bin = 1, objects = 0; bin < bins; ++bin) {
                left.add(box[bin - 1]);
                objects += count[bin - 1];
                if (objects == 0 || objects == all.count()) continue;
                const double cost = left.half_area() * weight(objects) + behind[bin];
                if (cost >= least) continue;
                least = cost;
                best_axis = axis;
                best_bin = bin;
            }
        }
        if (best_axis < 0) return (all.first + all.last) / 2;  // all middles are at one point
        const auto begin = order_.begin();
        const auto middle = std::partition(
            begin + static_cast<std::ptrdiff_t>(all.first), begin + static_cast<std::ptrdiff_t>(all.last),
            [&](std::size_t object) { return bin_of(middles, best_axis, object) < best_bin; });
        return static_cast<std::size_t>(middle - begin);
    }
    [[nodiscard]] std::size_t bin_of(const Around& middles, int axis, std::size_t object) const {
        const float share =
            (boxes_[object].middle(axis) - middles.low[axis]) / (middles.high[axis] - middles.low[axis]);
        return std::min(bins - 1, static_cast<std::size_t>(share * static_cast<float>(bins)));
    }
    /// Counts objects in whole leaf nodes, so that these become full.
    static double weight(std::size_t objects) { return static_cast<double>((objects + width - 1) / width); }

    std::vector<Around> boxes_;
    std::vector<std::size_t> order_;
    TreeShape shape_;
    double sum_ = 0.0;
};

}  // namespace

TreeShape fresh_tree(std::span<const Box> boxes) { return Builder(boxes).shape(); }

}  // namespace espalier::bench
