#include "expecting.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier::tests {

template <class Shape>
void Expecting::volume(const Shape& shape) {
    tell(overlaps(blob_, shape));
    visits_ = asked_.bits % 9;
    tell(for_each_overlap(blob_, shape, [&](Triangle triangle) {
        tell(triangle);
        return visit_one();
    }));
    std::array<Triangle, 4> triangles;
    std::uint32_t first = 0;
    for (const std::size_t places : {4u, 3u}) {
        const OverlapPage page = collect_overlaps(blob_, shape, std::span(triangles).first(places), first);
        tell(page.status);
        tell(page.count);
        tell(page.next);
        for (std::uint32_t i = 0; i < page.count; ++i) tell(triangles[i]);
        first = page.next;
    }
}

void Expecting::volumes() {
    volume(Sphere{point(0), length(0)});
    volume(Capsule{point(1), point(2), length(1)});
    volume(Box{point(0), point(3)});
    volume(OrientedBox{point(1), {direction(0), direction(1), direction(2)}});
    volume(Corners{point(0), point(1), point(2)});
    std::array<Plane, 4> planes;
    for (int i = 0; i < 4; ++i) planes[static_cast<std::size_t>(i)] = {direction(i), length(i)};
    volume(std::span<const Plane>(planes).first(asked_.bits % 5));
    BoxInSteps steps;
    static_cast<void>(steps_around(lattice_of(blob_), {point(0), point(3)}, steps));
    volume(steps);
    volume(BoxInSteps{bits_of(asked_.points[0]), bits_of(asked_.points[1])});
}

void Expecting::points() {
    Nearest nearest;
    tell(closest_point(blob_, point(0), length(0), nearest));
    tell(nearest);
    std::array<Nearest, 6> some;
    const std::size_t count = closest_triangles(blob_, point(0), length(0), some);
    tell(std::uint64_t{count});
    for (std::size_t i = 0; i < count; ++i) tell(some[i]);
    NearestPair pair;
    tell(closest_to_segment(blob_, {point(0), point(1)}, length(1), pair));
    tell(pair);
    tell(closest_to_box(blob_, {point(2), point(3)}, length(2), pair));
    tell(pair);
    bool inside = false;
    tell(contains(blob_, point(0), inside));
    tell(inside);
    tell(signed_distance(blob_, point(1), length(3), nearest));
    tell(nearest);
    const auto rounding = [&](const auto& shape) {
        const Result<float> moved = rounding_error(blob_, shape);
        tell(moved.value);
        tell(moved.status);
    };
    rounding(point(0));
    rounding(Ray{.origin = point(0), .direction = direction(0)});
    rounding(Segment{point(0), point(1)});
    rounding(Sphere{point(2), length(0)});
    rounding(Capsule{point(2), point(3), length(1)});
    rounding(Box{point(0), point(3)});
    rounding(OrientedBox{point(1), {direction(0), direction(1), direction(2)}});
    rounding(Corners{point(0), point(1), point(2)});
}

template <class Shape>
void Expecting::moving(const Shape& shape) {
    SweepHit hit;
    tell(check_sweep(blob_, shape, direction(0)));
    tell(sweep(blob_, shape, direction(0), hit));
    tell(hit);
    tell(sweep(blob_, shape, direction(0), hit, [&](Triangle triangle) { return counts(triangle); }));
    tell(hit);
}

void Expecting::sweeps() {
    moving(Sphere{point(0), length(0)});
    moving(Capsule{point(0), point(1), length(1)});
    moving(Box{point(2), point(3)});
}

void Expecting::placed(const Placement& placement, WorkLimit limit) {
    bool answer = false;
    tell(collides(blob_, other_, placement, answer, limit));
    tell(answer);
    TrianglePair contact = {{8}, {8}};
    tell(first_contact(blob_, other_, placement, contact, answer, limit));
    tell(answer);
    tell(contact.a);
    tell(contact.b);
    visits_ = asked_.bits % 9;
    tell(for_each_contact(
        blob_, other_, placement,
        [&](const TrianglePair& each) {
            tell(each.a);
            tell(each.b);
            return visit_one();
        },
        limit));
    std::array<TrianglePair, 5> contacts;
    std::size_t count = 99;
    tell(all_contacts(blob_, other_, placement, contacts, count, limit));
    tell(std::uint64_t{count});
    for (const TrianglePair& each : contacts) {
        tell(each.a);
        tell(each.b);
    }
    PairDistance nearest;
    tell(minimum_distance(blob_, other_, placement, length(1), nearest, answer, limit));
    tell(answer);
    tell(nearest.distance);
    tell(nearest.on_a);
    tell(nearest.on_b);
    tell(nearest.pair.a);
    tell(nearest.pair.b);
    tell(within_distance(blob_, other_, placement, length(2), answer, limit));
    tell(answer);
}

void Expecting::pairs() {
    const WorkLimit limit = {asked_.bits % 8 == 0 ? asked_.bits % 50 : 300};
    placed({{}, direction(0)}, limit);
    const float* q = asked_.rotation;
    placed({{q[0], q[1], q[2], q[3]}, direction(1), length(0)}, limit);
}

void Expecting::approximations() {
    QueryCounters counters;
    QueryCounters* counting = asked_.bits % 3 == 0 ? nullptr : &counters;
    tell(may_overlap(blob_, Sphere{point(0), length(0)}, length(3), counting));
    tell(counters);
    tell(may_overlap(blob_, Box{point(0), point(1)}, length(3), counting));
    tell(counters);
    tell(may_be_occluded(blob_, {point(1), direction(1)}, length(3), counting));
    tell(counters);
    DistanceBounds bounds = {-1.0f, -2.0f};
    tell(distance_bounds(blob_, point(2), length(1), length(3), bounds, counting));
    tell(bounds.lower);
    tell(bounds.upper);
    tell(counters);
}

}  // namespace espalier::tests
