#include "box_tree.hpp"

namespace espalier::bench {
namespace {

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

using Symmetric = std::array<std::array<float, 3>, 3>;
using Axes = std::array<Vec3, 3>;

float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 scaled(const Vec3& v, float factor) { return {v.x * factor, v.y * factor, v.z * factor}; }
Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
float length_of(const Vec3& v) { return std::sqrt(dot(v, v)); }

/// Returns a direction that is perpendicular to one of length 1.
Vec3 perpendicular_to(const Vec3& v) {
    const Vec3 other = std::abs(v.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 across = cross(v, other);
    return scaled(across, 1.0f / length_of(across));
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
    axes[0] = scaled(longest, 1.0f / std::sqrt(most));
    const float height = length_of(normal);
    axes[2] = height > 0.0f ? scaled(normal, 1.0f / height) : perpendicular_to(axes[0]);
    axes[1] = cross(axes[2], axes[0]);
    return axes;
}

Symmetric covariance_of(std::span<const TriangleVertices> triangles, std::span<const Vec3> positions) {
    const Vec3 origin = positions[triangles.front()[0]];  // keeps the numbers small
    float sum[3] = {}, products[6] = {};
    for (const TriangleVertices& triangle : triangles)
        for (const std::uint32_t vertex : triangle) {
            const Vec3 p = difference(positions[vertex], origin);
            sum[0] += p.x, sum[1] += p.y, sum[2] += p.z;
            products[0] += p.x * p.x, products[1] += p.y * p.y, products[2] += p.z * p.z;
            products[3] += p.x * p.y, products[4] += p.y * p.z, products[5] += p.z * p.x;
        }
    const float share = 1.0f / (3.0f * static_cast<float>(triangles.size()));
    const auto entry = [&](std::size_t product, std::size_t i, std::size_t j) {
        return products[product] * share - (sum[i] * share) * (sum[j] * share);
    };
    const float xy = entry(3, 0, 1), yz = entry(4, 1, 2), zx = entry(5, 2, 0);
    return {{{entry(0, 0, 0), xy, zx}, {xy, entry(1, 1, 1), yz}, {zx, yz, entry(2, 2, 2)}}};
}

/// Returns the eigenvectors, by Jacobi's rotations.
Axes eigenvectors_of(Symmetric matrix) {
    float columns[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // columns[k] is an eigenvector
    for (unsigned sweep = 0; sweep < 8; ++sweep) {
        const float trace = std::abs(matrix[0][0]) + std::abs(matrix[1][1]) + std::abs(matrix[2][2]);
        const float outside = std::abs(matrix[0][1]) + std::abs(matrix[1][2]) + std::abs(matrix[0][2]);
        if (!(outside > 1e-7f * trace)) break;
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = p + 1; q < 3; ++q) {
                if (matrix[p][q] == 0.0f) continue;
                const float theta = (matrix[q][q] - matrix[p][p]) / (2.0f * matrix[p][q]);
                const float tangent = std::copysign(1.0f, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0f));
                const float cosine = 1.0f / std::sqrt(tangent * tangent + 1.0f), sine = tangent * cosine;
                const std::size_t r = 3 - p - q;
                const float pr = matrix[p][r], qr = matrix[q][r], shift = tangent * matrix[p][q];
                matrix[p][p] -= shift;
                matrix[q][q] += shift;
                matrix[p][q] = matrix[q][p] = 0.0f;
                matrix[p][r] = matrix[r][p] = cosine * pr - sine * qr;
                matrix[q][r] = matrix[r][q] = sine * pr + cosine * qr;
                for (std::size_t k = 0; k < 3; ++k) {
                    const float a = columns[p][k], b = columns[q][k];
                    columns[p][k] = cosine * a - sine * b;
                    columns[q][k] = sine * a + cosine * b;
                }
            }
    }
    Axes axes;
    for (std::size_t k = 0; k < 3; ++k) axes[k] = {columns[k][0], columns[k][1], columns[k][2]};
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
        const Axes axes = triangles.size() == 1 ? axes_of(triangles.front(), positions)
                                                : eigenvectors_of(covariance_of(triangles, positions));
        boxes[i] = box_along(axes, triangles, positions);
    }
}

}  // namespace espalier::bench
