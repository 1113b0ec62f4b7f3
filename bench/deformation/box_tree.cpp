#include "box_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace espalier::bench {
namespace {

constexpr std::size_t bins = 16;

float coordinate(const Vec3& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Aabb box_of(const TriangleVertices& triangle, std::span<const Vec3> positions) {
    Aabb box = Aabb::none();
    for (const std::uint32_t vertex : triangle) box.add(positions[vertex]);
    return box;
}

class Builder {
public:
    Builder(std::span<const TriangleVertices> triangles, std::span<const Vec3> positions) : order_(triangles.size()) {
        for (const TriangleVertices& triangle : triangles) boxes_.push_back(box_of(triangle, positions));
        std::iota(order_.begin(), order_.end(), std::uint32_t{0});
        build(0, triangles.size());
        for (const std::uint32_t triangle : order_) shape_.triangles.push_back(triangles[triangle]);
    }
    [[nodiscard]] BoxTreeShape& shape() { return shape_; }

private:
    void build(std::size_t first, std::size_t last) {
        const std::size_t number = shape_.nodes.size();
        shape_.nodes.push_back({0, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first)});
        if (last - first <= 1) return;
        const std::size_t middle = split(first, last);
        build(first, middle);
        shape_.nodes[number].right = static_cast<std::uint32_t>(shape_.nodes.size());
        build(middle, last);
    }

    /// Returns where the second child begins, whose triangles are then in order.
    std::size_t split(std::size_t first, std::size_t last) {
        const std::span<std::uint32_t> all = std::span(order_).subspan(first, last - first);
        Aabb middles = Aabb::none();
        for (const std::uint32_t triangle : all)
            middles.add(Vec3{middle_of(triangle, 0), middle_of(triangle, 1), middle_of(triangle, 2)});
        double least = std::numeric_limits<double>::infinity();
        std::size_t best_axis = 0, best_bin = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(middles.high[axis] > middles.low[axis])) continue;
            std::array<Aabb, bins> boxes;
            boxes.fill(Aabb::none());
            std::array<std::size_t, bins> count{};
            for (const std::uint32_t triangle : all) {
                const std::size_t bin = bin_of(triangle, middles, axis);
                boxes[bin].add(boxes_[triangle]);
                ++count[bin];
            }
            std::array<double, bins> behind{};
            Aabb right = Aabb::none();
            for (std::size_t bin = bins, triangles = 0; bin-- > 1;) {
                right.add(boxes[bin]);
                behind[bin] = right.half_area() * static_cast<double>(triangles += count[bin]);
            }
            Aabb left = Aabb::none();
            for (std::size_t bin = 1, triangles = 0; bin < bins; ++bin) {
                left.add(boxes[bin - 1]);
                triangles += count[bin - 1];
                const double cost = left.half_area() * static_cast<double>(triangles) + behind[bin];
                if (triangles == 0 || triangles == all.size() || cost >= least) continue;
                least = cost;
                best_axis = axis;
                best_bin = bin;
            }
        }
        if (best_bin == 0) return (first + last) / 2;  // all middles are at one point
        const auto middle = std::partition(all.begin(), all.end(), [&](std::uint32_t triangle) {
            return bin_of(triangle, middles, best_axis) < best_bin;
        });
        return first + static_cast<std::size_t>(middle - all.begin());
    }
    [[nodiscard]] float middle_of(std::uint32_t triangle, std::size_t axis) const {
        return 0.5f * (boxes_[triangle].low[axis] + boxes_[triangle].high[axis]);
    }
    [[nodiscard]] std::size_t bin_of(std::uint32_t triangle, const Aabb& middles, std::size_t axis) const {
        const float share = (middle_of(triangle, axis) - middles.low[axis]) / (middles.high[axis] - middles.low[axis]);
        return std::min(bins - 1, static_cast<std::size_t>(share * static_cast<float>(bins)));
    }

    std::vector<Aabb> boxes_;
    std::vector<std::uint32_t> order_;
    BoxTreeShape shape_;
};

}  // namespace

Aabb Aabb::none() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

void Aabb::add(const Vec3& point) {
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], coordinate(point, k));
        high[k] = std::max(high[k], coordinate(point, k));
    }
}

void Aabb::add(const Aabb& box) {
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], box.low[k]);
        high[k] = std::max(high[k], box.high[k]);
    }
}

bool Aabb::contains(const Vec3& point, float rounding) const {
    for (std::size_t k = 0; k < 3; ++k)
        if (coordinate(point, k) < low[k] - rounding || coordinate(point, k) > high[k] + rounding) return false;
    return true;
}

double Aabb::half_area() const {
    std::array<double, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) {
        if (high[k] < low[k]) return 0.0;
        side[k] = static_cast<double>(high[k]) - static_cast<double>(low[k]);
    }
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

BoxTreeShape build_box_tree(std::span<const TriangleVertices> triangles, std::span<const Vec3> positions) {
    return std::move(Builder(triangles, positions).shape());
}

void refit_aabbs(const BoxTreeShape& shape, std::span<const Vec3> positions, std::span<Aabb> boxes) {
    for (std::size_t i = shape.nodes.size(); i-- != 0;) {
        const BoxTreeShape::Node& node = shape.nodes[i];
        if (node.right == 0) {
            boxes[i] = box_of(shape.triangles[node.first], positions);
        } else {
            boxes[i] = boxes[i + 1];
            boxes[i].add(boxes[node.right]);
        }
    }
}

}  // namespace espalier::bench
