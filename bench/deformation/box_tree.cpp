#include "box_tree.hpp"

#include "../../tests/support/base/vectors.hpp"
#include "../obb/covariance.hpp"

namespace espalier::bench {
namespace {

using tests::cross, tests::difference, tests::dot, tests::times;

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
        const std::size_t middle =
            first + split_by_areas(std::span(order_).subspan(first, last - first), std::span<const Aabb>(boxes_),
                                   [](std::size_t triangles) { return static_cast<double>(triangles); });
        build(first, middle);
        shape_.nodes[number].right = static_cast<std::uint32_t>(shape_.nodes.size());
        build(middle, last);
    }

    std::vector<Aabb> boxes_;
    std::vector<std::uint32_t> order_;
    BoxTreeShape shape_;
};

}  // namespace

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

namespace {

// Oriented boxes, fitted anew to the triangles of each node.

using Axes = std::array<Vec3, 3>;

float length_of(const Vec3& v) { return std::sqrt(dot(v, v)); }

/// Returns a direction that is perpendicular to one of length 1.
Vec3 perpendicular_to(const Vec3& v) {
    const Vec3 other = std::abs(v.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = cross(v, other);
    return times(across, 1.0f / length_of(across));
}

/// Returns the longest edge, the normal, and the axis across both.
Axes axes_of(const TriangleVertices& triangle, std::span<const Vec3> positions) {
    Vec3 longest{}, normal{};
    float most = 0.0f;
    const Vec3& a = positions[triangle[0]];
    normal = cross(difference(positions[triangle[1]], a), difference(positions[triangle[2]], a));
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = difference(positions[triangle[(k + 1) % 3]], positions[triangle[k]]);
        const float squared = dot(edge, edge);
        if (squared <= most) continue;
        most = squared;
        longest = edge;
    }
    if (most == 0.0f) return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Axes axes;
    axes[0] = times(longest, 1.0f / std::sqrt(most));
    const float height = length_of(normal);
    axes[2] = height > 0.0f ? times(normal, 1.0f / height) : perpendicular_to(axes[0]);
    axes[1] = cross(axes[2], axes[0]);
    return axes;
}

/// Returns the eigenvectors of the vertices' covariance.
Axes axes_of(std::span<const TriangleVertices> triangles, std::span<const Vec3> positions) {
    const Vec3 origin = positions[triangles.front()[0]];  // keeps the numbers small
    PointCovariance<float> covariance;
    for (const TriangleVertices& triangle : triangles)
        for (const std::uint32_t vertex : triangle) {
            const Vec3 p = difference(positions[vertex], origin);
            covariance.add(p.x, p.y, p.z);
        }
    const auto vectors = eigenvectors_of(covariance.of(3 * triangles.size()), 1e-7f);
    Axes axes;
    for (std::size_t k = 0; k < 3; ++k) axes[k] = {vectors[k][0], vectors[k][1], vectors[k][2]};
    return axes;
}

Obb box_along(const Axes& axes, std::span<const TriangleVertices> triangles, std::span<const Vec3> positions) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Obb box = {axes, {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const TriangleVertices& triangle : triangles)
        for (const std::uint32_t vertex : triangle)
            for (std::size_t k = 0; k < 3; ++k) {
                const float along = dot(axes[k], positions[vertex]);
                box.low[k] = std::min(box.low[k], along);
                box.high[k] = std::max(box.high[k], along);
            }
    return box;
}

}  // namespace

bool Obb::contains(const Vec3& point, float rounding) const {
    for (std::size_t k = 0; k < 3; ++k) {
        const float along = dot(axes[k], point);
        if (along < low[k] - rounding || along > high[k] + rounding) return false;
    }
    return true;
}

double Obb::half_area() const {
    std::array<double, 3> side{};
    for (std::size_t k = 0; k < 3; ++k) side[k] = static_cast<double>(high[k]) - static_cast<double>(low[k]);
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

void fit_obbs(const BoxTreeShape& shape, std::span<const Vec3> positions, std::span<Obb> boxes) {
    for (std::size_t i = 0; i < shape.nodes.size(); ++i) {
        const std::span<const TriangleVertices> triangles = shape.triangles_of(shape.nodes[i]);
        const Axes axes = triangles.size() == 1 ? axes_of(triangles.front(), positions) : axes_of(triangles, positions);
        boxes[i] = box_along(axes, triangles, positions);
    }
}

}  // namespace espalier::bench
