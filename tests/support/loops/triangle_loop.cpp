#include "triangle_loop.hpp"

#include <algorithm>
#include <cmath>

#include <runtime/kernels/crossing.hpp>
#include <runtime/kernels/ray_triangle.hpp>

namespace espalier::tests {

namespace {

std::vector<std::uint32_t> indices_without_copies(const DecodedBlob& decoded) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < decoded.triangles.size(); ++i)
        if (decoded.owners[i] == i) indices.push_back(i);
    return indices;
}

std::vector<detail::LatticeTriangle> triangles_without_copies(const DecodedBlob& decoded) {
    std::vector<detail::LatticeTriangle> triangles;
    for (const std::uint32_t i : indices_without_copies(decoded)) {
        const GridTriangle& t = decoded.triangles[i];
        triangles.push_back({{{t.a[0], t.a[1], t.a[2]}, {t.b[0], t.b[1], t.b[2]}, {t.c[0], t.c[1], t.c[2]}}});
    }
    return triangles;
}

/// Lattice steps from units of 2^-fraction_bits of them.
double steps(std::int64_t units, int fraction_bits) { return std::ldexp(static_cast<double>(units), -fraction_bits); }
Place place(const std::int64_t* units, int fraction_bits) {
    return {steps(units[0], fraction_bits), steps(units[1], fraction_bits), steps(units[2], fraction_bits)};
}
Place place(const detail::Integer3& units, int fraction_bits) {
    return {steps(units.x, fraction_bits), steps(units.y, fraction_bits), steps(units.z, fraction_bits)};
}

detail::Integer3 all_three(std::int64_t a) { return {a, a, a}; }
detail::Integer3 lower(const detail::Integer3& a, const detail::Integer3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
detail::Integer3 higher(const detail::Integer3& a, const detail::Integer3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

}  // namespace

TriangleLoop::TriangleLoop(const DecodedBlob& decoded, LeftOut left_out)
    : triangles_(triangles_without_copies(decoded)),
      indices_(indices_without_copies(decoded)),
      bounds_(triangles_, left_out) {}

std::vector<detail::FoundHit> TriangleLoop::every_hit(const detail::LatticeRay& ray) const {
    const std::int64_t origin[3] = {ray.origin[0], ray.origin[1], ray.origin[2]};
    const std::int64_t direction[3] = {ray.direction[0], ray.direction[1], ray.direction[2]};
    const Place start = place(origin, ray.fraction_bits);
    std::vector<detail::FoundHit> hits;
    for (const auto& [when, i] : bounds_.on_the_way(
             {start, start}, place(direction, 0), static_cast<double>(ray.tau_min), static_cast<double>(ray.tau_max))) {
        detail::TriangleHit hit{};
        if (detail::intersect(ray, triangles_[i], hit)) hits.push_back({hit, indices_[i]});
    }
    return hits;
}

bool TriangleLoop::is_crossing(const detail::LatticeRay& ray, const detail::FoundHit& found) const {
    const auto place = std::lower_bound(indices_.begin(), indices_.end(), found.index);
    return detail::is_crossing(ray, triangles_[static_cast<std::size_t>(place - indices_.begin())]);
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::RoundedPoint& point) const {
    const Place center = place(point.origin, point.fraction_bits);
    Indices found;
    for (const std::uint32_t i : bounds_.closest_to_segment(center, center, static_cast<double>(point.radius))) {
        if (detail::is_within_radius(point, detail::distance_to(point, triangles_[i]), point.radius))
            found.push_back(indices_[i]);
    }
    return found;
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::Volume& volume,
                                                  const TriangleBounds::Numbers& numbers) const {
    Indices found;
    for (const std::uint32_t i : numbers)
        if (volume.kernel(volume, triangles_[i])) found.push_back(indices_[i]);
    return found;
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::Rounded<Capsule>& capsule) const {
    const detail::RoundedSegment& segment = capsule.segment;
    Indices found;
    for (const std::uint32_t i :
         bounds_.closest_to_segment(place(segment.from, segment.fraction_bits),
                                    place(segment.to, segment.fraction_bits), static_cast<double>(capsule.radius))) {
        const detail::SegmentDistance distance = detail::distance_to(segment, triangles_[i]);
        if (detail::is_within_radius(segment, triangles_[i], distance, capsule.radius)) found.push_back(indices_[i]);
    }
    return found;
}

LatticeHit TriangleLoop::first_hit(const detail::WholeSegment& segment) const {
    LatticeHit hit;
    hit.status = QueryStatus::not_found;
    detail::Crossing first;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        detail::Crossing crossing;
        if (!detail::crosses(segment, triangles_[i], crossing)) continue;
        if (hit.triangle != no_triangle && !detail::is_before(crossing, first)) continue;
        first = crossing;
        hit = {detail::fixed_point(crossing), TriangleId{indices_[i]}, QueryStatus::ok,
               crossing.front ? Side::front : Side::back};
    }
    return hit;
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::Rounded<Box>& box) const {
    Range range = {place(box.center, box.fraction_bits), place(box.center, box.fraction_bits)};
    const Place half = place(box.half, box.fraction_bits);
    range.low = {range.low.x - half.x, range.low.y - half.y, range.low.z - half.z};
    range.high = {range.high.x + half.x, range.high.y + half.y, range.high.z + half.z};
    return every_overlap(box, bounds_.near(range));
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::Rounded<OrientedBox>& box) const {
    detail::Integer3 half = {0, 0, 0};
    for (const detail::Integer3& axis : box.half)
        half = {half.x + std::abs(axis.x), half.y + std::abs(axis.y), half.z + std::abs(axis.z)};
    return every_overlap(
        box, bounds_.near({place(box.center - half, box.fraction_bits), place(box.center + half, box.fraction_bits)}));
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::Rounded<Triangle>& corners) const {
    const auto& [a, b, c] = corners.triangle.corner;
    return every_overlap(corners, bounds_.near({place(lower(lower(a, b), c), corners.fraction_bits),
                                                place(higher(higher(a, b), c), corners.fraction_bits)}));
}

TriangleLoop::Indices TriangleLoop::every_overlap(const detail::Rounded<ConvexVolume>& set) const {
    return every_overlap(set, bounds_.behind(std::span(set.planes, set.plane_count)));
}

std::vector<detail::FoundNearest> TriangleLoop::by_distance(const detail::RoundedPoint& point,
                                                            std::size_t count) const {
    const Place center = place(point.origin, point.fraction_bits);
    std::vector<detail::FoundNearest> found;
    for (const std::uint32_t i : bounds_.closest_to_segment(center, center, static_cast<double>(point.radius), count)) {
        const detail::PointDistance distance = detail::distance_to(point, triangles_[i]);
        if (detail::is_within_radius(point, distance, point.radius))
            found.push_back({{indices_[i]}, distance, triangles_[i]});
    }
    std::stable_sort(found.begin(), found.end(), [](const detail::FoundNearest& a, const detail::FoundNearest& b) {
        return a.distance.squared < b.distance.squared;
    });
    if (found.size() > count) found.resize(count);
    return found;
}

std::optional<detail::FoundNearest> TriangleLoop::closest_within(const detail::RoundedPoint& point) const {
    const std::vector<detail::FoundNearest> found = by_distance(point, 1);
    return found.empty() ? std::nullopt : std::optional(found[0]);
}

std::optional<detail::FoundPair> TriangleLoop::closest_pair(const detail::DistantShape& shape,
                                                            const TriangleBounds::Numbers& numbers) const {
    std::optional<detail::FoundPair> best;
    for (const std::uint32_t i : numbers) {
        const detail::SegmentDistance distance = shape.distance_to(shape.segment, triangles_[i]);
        if (!shape.is_within_radius(shape.segment, triangles_[i], distance, shape.radius)) continue;
        if (!best || distance.squared < best->distance.squared) best = {{indices_[i]}, distance, triangles_[i]};
    }
    return best;
}

std::optional<detail::FoundPair> TriangleLoop::closest_pair(const detail::DistantSegment& shape) const {
    const detail::RoundedSegment& segment = shape.segment;
    return closest_pair(shape, bounds_.closest_to_segment(place(segment.from, segment.fraction_bits),
                                                          place(segment.to, segment.fraction_bits),
                                                          static_cast<double>(shape.radius), 1));
}

std::optional<detail::FoundPair> TriangleLoop::closest_pair(const detail::DistantBox& shape) const {
    const detail::RoundedSegment& diagonal = shape.segment;
    return closest_pair(shape, bounds_.closest_to_box({place(diagonal.from, diagonal.fraction_bits),
                                                       place(diagonal.to, diagonal.fraction_bits)},
                                                      static_cast<double>(shape.radius), 1));
}

detail::Winding TriangleLoop::winding(const detail::WindingRay& ray) const {
    const Place start = place(ray.origin, ray.fraction_bits);
    const double along = ray.direction.up ? 1.0 : -1.0;
    const int axis = ray.direction.axis;
    const Place way = {axis == 0 ? along : 0.0, axis == 1 ? along : 0.0, axis == 2 ? along : 0.0};
    detail::Winding winding;
    for (const auto& [when, i] :
         bounds_.on_the_way({start, start}, way, 0.0, std::numeric_limits<double>::infinity())) {
        const auto relative = detail::relative_to(ray, triangles_[i]);
        if (detail::distance_to(relative, ray.fraction_bits).numerator.is_zero()) winding.on_surface = true;
        winding.number += detail::crossing(ray, triangles_[i]);
    }
    return winding;
}

template <class Sweep>
detail::FoundContact TriangleLoop::first_contact_of(const Sweep& sweep, const detail::Integer3& low,
                                                    const detail::Integer3& high, Filter filter,
                                                    const SweepOptions& options) const {
    std::vector<TriangleBounds::Met> met =
        bounds_.on_the_way({place(low, sweep.fraction_bits), place(high, sweep.fraction_bits)},
                           place(sweep.displacement, sweep.fraction_bits), 0.0, 1.0);
    std::sort(met.begin(), met.end(),
              [](const TriangleBounds::Met& a, const TriangleBounds::Met& b) { return a.when < b.when; });
    detail::FoundContact best;
    for (const auto& [when, i] : met) {
        // Contacts are told by the tick that they end in: none that follows is in this one.
        if (best.tick != detail::no_contact && std::ldexp(when, detail::tick_bits) > static_cast<double>(best.tick) + 1)
            break;
        if (!filter({indices_[i]})) continue;
        const detail::SweepTick step = detail::first_contact_tick(sweep, triangles_[i], detail::whole_way);
        if (step == detail::no_contact || is_left_out(sweep, triangles_[i], step, options)) continue;
        const detail::FoundContact found = found_contact(sweep, triangles_[i], indices_[i], step);
        if (comes_before(found, best)) best = found;
    }
    return best;
}

detail::FoundContact TriangleLoop::first_contact(const detail::CapsuleSweep& sweep, Filter filter,
                                                 const SweepOptions& options) const {
    const detail::Integer3 reach = all_three(sweep.moving.sphere.radius), to = sweep.from + sweep.moving.axis;
    // The kernel spares itself the start by the box that the walk culls with: it is asked with one that spares nothing.
    constexpr std::int64_t everywhere = std::int64_t{1} << 60;
    detail::CapsuleSweep unspared = sweep;
    unspared.low = all_three(-everywhere);
    unspared.high = all_three(everywhere);
    return first_contact_of(unspared, lower(sweep.from, to) - reach, higher(sweep.from, to) + reach, filter, options);
}
detail::FoundContact TriangleLoop::first_contact(const detail::BoxSweep& sweep, Filter filter,
                                                 const SweepOptions& options) const {
    return first_contact_of(sweep, sweep.low, sweep.high, filter, options);
}
detail::FoundContact TriangleLoop::first_contact(const detail::HullSweep& sweep, Filter filter,
                                                 const SweepOptions& options) const {
    detail::Integer3 low{}, high{};
    for (unsigned i = 0; i < sweep.moving.point_count; ++i) {
        const auto& p = sweep.moving.point[i];
        const detail::Integer3 at = {p[0], p[1], p[2]};
        low = i == 0 ? at : lower(low, at);
        high = i == 0 ? at : higher(high, at);
    }
    return first_contact_of(sweep, low, high, filter, options);
}

}  // namespace espalier::tests
