#include "volume_tests.hpp"

namespace espalier::bench {
namespace {

/// Three neighbouring normals of a k-DOP, and the inverse of the matrix whose columns they are.
struct Corner {
    std::array<std::size_t, 3> normals;
    std::array<Point, 3> inverse;  ///< rows
};

template <std::size_t k>
Point normal_of(std::size_t i) {
    const Point& d = slab_directions[dop_slabs<k>()[i % (k / 2)]];
    return i < k / 2 ? d : -1.0 * d;
}

/// Returns the triangles of the convex hull of all normals at length 1: the corners of the k-DOP around a ball.
template <std::size_t k>
std::vector<Corner> corners_of_dop() {
    std::array<Point, k> units;
    for (std::size_t i = 0; i < k; ++i) {
        const Point normal = normal_of<k>(i);
        units[i] = (1.0 / std::sqrt(dot(normal, normal))) * normal;
    }
    std::vector<Corner> corners;
    for (std::size_t a = 0; a < k; ++a)
        for (std::size_t b = a + 1; b < k; ++b)
            for (std::size_t c = b + 1; c < k; ++c) {
                const Point across = cross(units[b] - units[a], units[c] - units[a]);
                const double height = dot(across, units[a]);
                if (std::abs(height) < 1e-9) continue;
                const Point outwards = (1.0 / height) * across;
                if (std::any_of(units.begin(), units.end(),
                                [&](const Point& p) { return dot(outwards, p) > 1.0 + 1e-9; }))
                    continue;
                const Point x = normal_of<k>(a), y = normal_of<k>(b), z = normal_of<k>(c);
                const double scale = 1.0 / dot(x, cross(y, z));
                corners.push_back({{a, b, c}, {scale * cross(y, z), scale * cross(z, x), scale * cross(x, y)}});
            }
    return corners;
}

double least_of(const Point& p) { return std::min({p.x, p.y, p.z}); }

}  // namespace

template <std::size_t k>
DopTurn<k>::DopTurn(const Pose& pose) {
    static const std::vector<Corner> corners = corners_of_dop<k>();
    for (std::size_t i = 0; i < k / 2; ++i) {
        const Point normal = normal_of<k>(i);
        const auto& r = pose.rotation;
        const Point back = normal.x * r[0] + normal.y * r[1] + normal.z * r[2];
        const Corner* best = nullptr;
        Point weights{};
        double least = -std::numeric_limits<double>::infinity();
        for (const Corner& corner : corners) {
            const Point w = {dot(corner.inverse[0], back), dot(corner.inverse[1], back), dot(corner.inverse[2], back)};
            if (least_of(w) <= least) continue;
            best = &corner;
            weights = w;
            least = least_of(w);
            if (least >= 0.0) break;
        }
        Sum& sum = sums_[i];
        const double parts[3] = {weights.x, weights.y, weights.z};
        for (std::size_t j = 0; j < 3; ++j) {
            sum.normals[j] = static_cast<std::uint8_t>(best->normals[j]);
            sum.opposites[j] = static_cast<std::uint8_t>((best->normals[j] + k / 2) % k);
            sum.weights[j] = static_cast<float>(std::max(parts[j], 0.0));
        }
        sum.shift = static_cast<float>(dot(normal, pose.shift));
    }
}

template class DopTurn<14>;
template class DopTurn<18>;
template class DopTurn<26>;

}  // namespace espalier::bench
