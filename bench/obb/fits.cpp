#include "fits.hpp"

#include "covariance.hpp"

namespace espalier::bench {
namespace {

constexpr double rest_of_diagonal = 1e-15;

BoxAxes axes_of(const SymmetricMatrix<double>& covariance) {
    const auto vectors = eigenvectors_of(covariance, rest_of_diagonal);
    BoxAxes axes;
    for (std::size_t k = 0; k < 3; ++k) axes[k] = {vectors[k][0], vectors[k][1], vectors[k][2]};
    return axes;
}

/// The integrals of 1, of a point, and of a point's products over triangles.
class SurfaceMoments {
public:
    void add(const Point& p, const Point& q, const Point& r) {
        const Point across = cross(q - p, r - p);
        const double area = 0.5 * std::sqrt(dot(across, across));
        const Point sum = p + q + r;
        area_ += area;
        first_ = first_ + (area / 3.0) * sum;
        const double share = area / 12.0;
        const auto at = [](const Point& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
        const auto of_p = at(p), of_q = at(q), of_r = at(r), of_sum = at(sum);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                second_[i][j] +=
                    share * (of_sum[i] * of_sum[j] + of_p[i] * of_p[j] + of_q[i] * of_q[j] + of_r[i] * of_r[j]);
    }
    [[nodiscard]] double area() const { return area_; }
    [[nodiscard]] SymmetricMatrix<double> covariance() const {
        const double mean[3] = {first_.x / area_, first_.y / area_, first_.z / area_};
        SymmetricMatrix<double> matrix{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) matrix[i][j] = second_[i][j] / area_ - mean[i] * mean[j];
        return matrix;
    }

private:
    double area_ = 0.0;
    Point first_{0.0, 0.0, 0.0};
    SymmetricMatrix<double> second_{};
};

}  // namespace

std::string_view name_of(BoxFit fit) {
    constexpr const char* names[] = {"aligned", "vertices", "hull", "flush", "search"};
    return names[static_cast<std::size_t>(fit)];
}

BoxAxes axes_of_vertices(std::span<const Point> points) {
    const Point& origin = points.front();
    PointCovariance<double> covariance;
    for (const Point& point : points) {
        const Point p = point - origin;
        covariance.add(p.x, p.y, p.z);
    }
    return axes_of(covariance.of(points.size()));
}

BoxAxes axes_of_surface(const HullMesh& hull) {
    const Point& origin = hull.vertices.front();
    SurfaceMoments moments;
    for (const auto& [a, b, c] : hull.triangles)
        moments.add(hull.vertices[a] - origin, hull.vertices[b] - origin, hull.vertices[c] - origin);
    return moments.area() > 0.0 ? axes_of(moments.covariance()) : axes_of_vertices(hull.vertices);
}

Block fit_box(BoxFit fit, std::span<const Point> points) {
    switch (fit) {
        case BoxFit::aligned:
            break;
        case BoxFit::vertices:
            return box_along(axes_of_vertices(points), points);
        case BoxFit::hull:
            return box_along(axes_of_surface(convex_hull_of(points)), points);
        case BoxFit::flush:
            return box_along(flush_axes(convex_hull_of(points)), points);
        case BoxFit::search:
            return box_along(search_axes(convex_hull_of(points)), points);
    }
    return box_along(Block{}.axes, points);
}

}  // namespace espalier::bench
