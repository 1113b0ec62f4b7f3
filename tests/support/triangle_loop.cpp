#include "triangle_loop.hpp"

#include <algorithm>

namespace espalier::tests {

TriangleLoop::TriangleLoop(const DecodedBlob& decoded) : owners_(decoded.owners) {
    triangles_.reserve(decoded.triangles.size());
    for (const GridTriangle& t : decoded.triangles) {
        triangles_.push_back({{{t.a[0], t.a[1], t.a[2]}, {t.b[0], t.b[1], t.b[2]}, {t.c[0], t.c[1], t.c[2]}}});
    }
}

std::vector<detail::FoundHit> TriangleLoop::every_hit(const detail::LatticeRay& ray) const {
    std::vector<detail::FoundHit> hits;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (owners_[i] != i) continue;
        detail::TriangleHit hit{};
        if (detail::intersect(ray, triangles_[i], hit)) hits.push_back({hit, i});
    }
    return hits;
}

std::vector<std::uint32_t> TriangleLoop::every_overlap(const detail::LatticePoint& point) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (owners_[i] != i) continue;
        if (detail::is_within_radius(point, detail::distance_to(point, triangles_[i]), point.radius))
            found.push_back(i);
    }
    return found;
}

std::vector<std::uint32_t> TriangleLoop::every_overlap(const detail::Volume& volume) const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        if (owners_[i] == i && volume.meets(volume, triangles_[i])) found.push_back(i);
    return found;
}

std::vector<detail::FoundNearest> TriangleLoop::by_distance(const detail::LatticePoint& point) const {
    std::vector<detail::FoundNearest> found;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (owners_[i] != i) continue;
        const detail::PointDistance distance = detail::distance_to(point, triangles_[i]);
        if (detail::is_within_radius(point, distance, point.radius)) found.push_back({distance, i, triangles_[i]});
    }
    std::stable_sort(found.begin(), found.end(), [](const detail::FoundNearest& a, const detail::FoundNearest& b) {
        return a.distance.squared < b.distance.squared;
    });
    return found;
}

std::optional<detail::FoundPair> TriangleLoop::closest_pair(const detail::DistantShape& shape) const {
    std::optional<detail::FoundPair> best;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (owners_[i] != i) continue;
        const detail::SegmentDistance distance = shape.distance_to(shape, triangles_[i]);
        if (!shape.is_within_radius(shape, triangles_[i], distance, shape.radius)) continue;
        if (!best || distance.squared < best->distance.squared) best = {distance, i, triangles_[i]};
    }
    return best;
}

detail::Winding TriangleLoop::winding(const detail::WindingRay& ray) const {
    detail::Winding winding;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (owners_[i] != i) continue;
        const auto relative = detail::relative_to(ray, triangles_[i]);
        if (detail::distance_to(relative, ray.fraction_bits).numerator.is_zero()) winding.on_surface = true;
        winding.number += detail::crossing(ray, triangles_[i]);
    }
    return winding;
}

}  // namespace espalier::tests
