#include "triangle_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace espalier::tests {

namespace {

/// Lattice steps: doubles are exact to far less within 2^37 of them.
constexpr double slack = 1.0;
/// Of distances: what the kernels say in float is within a millionth.
constexpr double bounds_slack = 1.0 + 1e-4;

double square(double x) { return x * x; }

}  // namespace

void TriangleBounds::Bounds::extend(const double* place) {
    for (unsigned k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], place[k]);
        high[k] = std::max(high[k], place[k]);
    }
}

void TriangleBounds::Bounds::finish() {
    double squared = 0.0;
    for (unsigned k = 0; k < 3; ++k) {
        center[k] = 0.5 * (low[k] + high[k]);
        squared += square(high[k] - center[k]);
    }
    radius = std::sqrt(squared);
}

TriangleBounds::TriangleBounds(const std::vector<detail::LatticeTriangle>& triangles, LeftOut left_out)
    : left_out_(left_out) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr Bounds nothing = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {}, 0.0};
    for (const detail::LatticeTriangle& triangle : triangles) {
        if (triangles_.size() % group_size == 0) groups_.push_back(nothing);
        triangles_.push_back(nothing);
        for (const auto& corner : triangle.corner) {
            const double place[3] = {static_cast<double>(corner[0]), static_cast<double>(corner[1]),
                                     static_cast<double>(corner[2])};
            triangles_.back().extend(place);
            groups_.back().extend(place);
        }
        triangles_.back().finish();
    }
    for (Bounds& group : groups_) group.finish();
}

template <class MayMatter>
TriangleBounds::Numbers TriangleBounds::numbers_where(MayMatter may_matter) const {
    Numbers numbers;
    for (std::size_t group = 0; group < groups_.size(); ++group) {
        if (left_out_ != LeftOut::nothing && !may_matter(groups_[group])) continue;
        const std::size_t end = std::min((group + 1) * group_size, triangles_.size());
        for (std::size_t i = group * group_size; i < end; ++i)
            if (left_out_ == LeftOut::nothing || may_matter(triangles_[i]))
                numbers.push_back(static_cast<std::uint32_t>(i));
    }
    return numbers;
}

TriangleBounds::Numbers TriangleBounds::near(const Range& box) const {
    const double low[3] = {box.low.x - slack, box.low.y - slack, box.low.z - slack};
    const double high[3] = {box.high.x + slack, box.high.y + slack, box.high.z + slack};
    return numbers_where([&](const Bounds& bounds) {
        for (unsigned k = 0; k < 3; ++k)
            if (bounds.low[k] > high[k] || bounds.high[k] < low[k]) return false;
        return true;
    });
}

TriangleBounds::Numbers TriangleBounds::behind(std::span<const detail::LatticePlane> planes) const {
    return numbers_where([&](const Bounds& bounds) {
        for (const detail::LatticePlane& plane : planes) {
            double least = 0.0;  // exactly: below 2^53
            for (unsigned k = 0; k < 3; ++k) {
                const auto along = static_cast<double>(plane.normal[k]);
                least += along * (along < 0.0 ? bounds.high[k] : bounds.low[k]);
            }
            if (least > static_cast<double>(plane.offset)) return false;
        }
        return true;
    });
}

std::vector<TriangleBounds::Met> TriangleBounds::on_the_way(const Range& start, const Place& way, double first,
                                                            double last) const {
    const double low[3] = {start.low.x - slack, start.low.y - slack, start.low.z - slack};
    const double high[3] = {start.high.x + slack, start.high.y + slack, start.high.z + slack};
    // Without a way along an axis everything is met at once or never: so it is, near enough, with one that is almost
    // none.
    const auto inverse_of = [](double along) { return 1.0 / (along == 0.0 ? 1e-30 : along); };
    const double inverse[3] = {inverse_of(way.x), inverse_of(way.y), inverse_of(way.z)};
    const auto met_in = [&](const Bounds& bounds, double& begins) {
        double ends = last;
        begins = first;
        for (unsigned k = 0; k < 3; ++k) {
            const double one = (bounds.low[k] - high[k]) * inverse[k], other = (bounds.high[k] - low[k]) * inverse[k];
            begins = std::max(begins, std::min(one, other));
            ends = std::min(ends, std::max(one, other));
        }
        return begins <= ends;
    };
    std::vector<Met> met;
    double begins = first;
    for (const std::uint32_t number : numbers_where([&](const Bounds& bounds) { return met_in(bounds, begins); })) {
        met_in(triangles_[number], begins);
        met.push_back({left_out_ == LeftOut::nothing ? first : begins, number});
    }
    return met;
}

TriangleBounds::Numbers TriangleBounds::closest_to_segment(const Place& from, const Place& to, double radius,
                                                           std::size_t count) const {
    const double x = to.x - from.x, y = to.y - from.y, z = to.z - from.z;
    const double length = x * x + y * y + z * z;
    const double inverse = length > 0.0 ? 1.0 / length : 0.0;
    const auto distance_of = [&](const double* place) {
        const double px = place[0] - from.x, py = place[1] - from.y, pz = place[2] - from.z;
        const double t = std::clamp((px * x + py * y + pz * z) * inverse, 0.0, 1.0);
        return std::sqrt(square(px - t * x) + square(py - t * y) + square(pz - t * z));
    };
    return closest(distance_of, radius, count);
}

TriangleBounds::Numbers TriangleBounds::closest_to_box(const Range& box, double radius, std::size_t count) const {
    const auto distance_of = [&](const double* place) {
        const auto outside = [](double low, double at, double high) { return std::max({low - at, at - high, 0.0}); };
        return std::sqrt(square(outside(box.low.x, place[0], box.high.x)) +
                         square(outside(box.low.y, place[1], box.high.y)) +
                         square(outside(box.low.z, place[2], box.high.z)));
    };
    return closest(distance_of, radius, count);
}

/// How far the `count` triangles closest to the query reach at most.
template <class DistanceOf>
double TriangleBounds::reach_of_closest(DistanceOf distance_of, std::size_t count) const {
    std::vector<double> least;  // of each group
    for (const Bounds& group : groups_) least.push_back(distance_of(group.center) - group.radius);
    const auto begin = static_cast<std::size_t>(std::min_element(least.begin(), least.end()) - least.begin());
    std::priority_queue<double> reaches;  // the lowest `count` of them
    for (std::size_t after = 0; after < groups_.size(); ++after) {
        const std::size_t group = (begin + after) % groups_.size();
        if (reaches.size() == count && least[group] > reaches.top()) continue;
        const std::size_t end = std::min((group + 1) * group_size, triangles_.size());
        for (std::size_t i = group * group_size; i < end; ++i) {
            reaches.push(distance_of(triangles_[i].center) + triangles_[i].radius);
            if (reaches.size() > count) reaches.pop();
        }
    }
    return reaches.top();
}

template <class DistanceOf>
TriangleBounds::Numbers TriangleBounds::closest(DistanceOf distance_of, double radius, std::size_t count) const {
    if (count == 0) return {};
    const double farthest = count < triangles_.size() ? std::min(radius, reach_of_closest(distance_of, count)) : radius;
    const double limit = farthest * bounds_slack + slack;
    return numbers_where([&](const Bounds& bounds) { return distance_of(bounds.center) - bounds.radius <= limit; });
}

}  // namespace espalier::tests
