#include "exact_geometry.hpp"

#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace espalier::oracle {

namespace {

Rational inner(const Point& a, const Point& b) { return a.dot(b); }

Rational squared_length(const Point& a) { return inner(a, a); }

Rational determinant(const Point& x, const Point& y, const Point& z) {
    Eigen::Matrix<Rational, 3, 3> columns;
    columns << x, y, z;
    return columns.determinant();
}

/// The closest point of the segment: project onto its line, then stay between its ends.
ClosestPoint closest_on_segment(const Point& from, const Point& to, const Point& point) {
    const Point along = to - from;
    Rational share = inner(point - from, along) / squared_length(along);
    if (share < Rational(0)) share = 0;
    if (share > Rational(1)) share = 1;
    const Point closest = from + along * share;
    return {closest, squared_length(point - closest)};
}

/// The corners that the bits of `face` choose.
std::vector<Point> face_of(std::span<const Point> corners, unsigned face) {
    std::vector<Point> chosen;
    for (std::size_t i = 0; i < corners.size(); ++i)
        if ((face >> i & 1u) != 0) chosen.push_back(corners[i]);
    return chosen;
}

/// Where the affine hulls of two faces are closest, if that is one pair of points and both lie inside of their faces.
std::optional<Rational> squared_distance_of_hulls(const std::vector<Point>& first, const std::vector<Point>& second) {
    using Matrix = Eigen::Matrix<Rational, Eigen::Dynamic, Eigen::Dynamic>;
    using Column = Eigen::Matrix<Rational, Eigen::Dynamic, 1>;
    const auto ways = static_cast<Eigen::Index>(first.size() + second.size() - 2);
    const auto of_first = static_cast<Eigen::Index>(first.size() - 1);
    Matrix directions(3, ways);  // the difference of the two points is offset + directions * weights
    for (Eigen::Index i = 0; i < ways; ++i) {
        directions.col(i) = i < of_first ? Point(first[static_cast<std::size_t>(i) + 1] - first[0])
                                         : Point(second[0] - second[static_cast<std::size_t>(i - of_first) + 1]);
    }
    const Point offset = first[0] - second[0];
    Column weights(ways);
    if (ways > 0) {
        // Elimination on the normal equations: their matrix has no zero pivot unless it is singular.
        Matrix system(ways, ways + 1);
        for (Eigen::Index i = 0; i < ways; ++i) {
            for (Eigen::Index j = 0; j < ways; ++j) system(i, j) = directions.col(i).dot(directions.col(j));
            system(i, ways) = -directions.col(i).dot(offset);
        }
        for (Eigen::Index pivot = 0; pivot < ways; ++pivot) {
            if (system(pivot, pivot).sign() == 0) return std::nullopt;
            for (Eigen::Index row = 0; row < ways; ++row) {
                if (row == pivot) continue;
                const Rational factor = system(row, pivot) / system(pivot, pivot);
                for (Eigen::Index j = pivot; j <= ways; ++j) system(row, j) -= factor * system(pivot, j);
            }
        }
        Rational sums[2] = {0, 0};
        for (Eigen::Index i = 0; i < ways; ++i) {
            weights(i) = system(i, ways) / system(i, i);
            if (weights(i).sign() < 0) return std::nullopt;
            sums[i < of_first ? 0 : 1] += weights(i);
        }
        if (sums[0] > Rational(1) || sums[1] > Rational(1)) return std::nullopt;
    }
    Point between = offset;
    for (Eigen::Index i = 0; i < ways; ++i) between += directions.col(i) * weights(i);
    return squared_length(between);
}

}  // namespace

Rational squared_distance(std::span<const Point> first, std::span<const Point> second) {
    std::optional<Rational> least;
    for (unsigned i = 1; i < 1u << first.size(); ++i) {
        for (unsigned j = 1; j < 1u << second.size(); ++j) {
            const auto squared = squared_distance_of_hulls(face_of(first, i), face_of(second, j));
            if (squared && (!least || *squared < *least)) least = squared;
        }
    }
    return *least;
}

Point normal_of(const Triangle& triangle) {
    const Point ab = triangle.b - triangle.a;
    const Point ac = triangle.c - triangle.a;
    return ab.cross(ac);
}

// Cramer's rule on t * (-d) + u * (b - a) + v * (c - a) = o - a.
std::optional<Crossing> cross(const Line& line, const Triangle& triangle) {
    const Point against = -line.direction;
    const Point ab = triangle.b - triangle.a;
    const Point ac = triangle.c - triangle.a;
    const Point from_a = line.origin - triangle.a;
    const Rational whole = determinant(against, ab, ac);
    if (whole.sign() == 0) return std::nullopt;
    Crossing crossing;
    crossing.u = determinant(against, from_a, ac) / whole;
    if (crossing.u < Rational(0) || crossing.u > Rational(1)) return std::nullopt;
    crossing.v = determinant(against, ab, from_a) / whole;
    if (crossing.v < Rational(0) || crossing.u + crossing.v > Rational(1)) return std::nullopt;
    crossing.t = determinant(from_a, ab, ac) / whole;
    crossing.front = whole.sign() > 0;
    return crossing;
}

// The foot of the perpendicular when it falls inside, else the best of the three sides.
ClosestPoint closest_on_triangle(const Triangle& triangle, const Point& point) {
    const Point normal = normal_of(triangle);
    const std::optional<Crossing> foot = cross({point, normal}, triangle);
    if (foot) {
        const Point closest = point + normal * foot->t;
        return {closest, squared_length(point - closest)};
    }
    ClosestPoint best = closest_on_segment(triangle.a, triangle.b, point);
    for (const ClosestPoint& other :
         {closest_on_segment(triangle.b, triangle.c, point), closest_on_segment(triangle.c, triangle.a, point)}) {
        if (other.squared_distance < best.squared_distance) best = other;
    }
    return best;
}

}  // namespace espalier::oracle
