#include "expecting.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace espalier::tests {

template <class Shape>
void Expecting::volume(const Shape& shape) {
    tell(overlaps(blob_, shape).status());
    visits_ = asked_.bits % 9;
    tell(for_each_overlap(
        blob_, shape, [&](TriangleId triangle, const Triangle& corners) { return visit_triangle(triangle, corners); }));
    std::array<TriangleId, 4> triangles;
    Cursor from;
    for (const std::size_t places : {4u, 3u}) {
        const Filled page = collect_overlaps(blob_, shape, std::span(triangles).first(places), from);
        tell(page.status);
        tell(std::uint64_t{page.count});
        for (const std::uint32_t place : page.next.place) tell(place);
        for (const TriangleId triangle : page.in(triangles)) tell(triangle);
        from = page.next;
    }
}

void Expecting::volumes() {
    volume(sphere());
    volume(capsule());
    volume(box());
    volume(oriented_box());
    volume(cone());
    volume(triangle());
    std::array<Plane, 4> planes;
    for (int i = 0; i < 4; ++i) planes[static_cast<std::size_t>(i)] = {direction(i), length(i)};
    volume(ConvexVolume{std::span<const Plane>(planes).first(asked_.bits % 5)});
    volume(*to_lattice(blob_.lattice(), box()));
    volume(LatticeBox{bits_of(asked_.points[0]), bits_of(asked_.points[1])});
}

void Expecting::points() {
    tell(closest_point(blob_, point(0), length(0)));
    std::array<ClosestPoint, 6> some;
    const Filled filled = closest_triangles(blob_, point(0), some, length(0));
    tell(std::uint64_t{filled.count});
    tell(filled.status);
    for (const ClosestPoint& each : filled.in(some)) tell(each);
    tell(closest_point(blob_, segment(), length(1)));
    tell(closest_point(blob_, box(), length(2)));
    const YesNo inside = contains(blob_, point(0));
    tell(inside.status());
    tell(inside.yes());
    tell(inside.no());
    const Result<float> winding = winding_number(blob_, point(0), asked_.bits % 9u);
    tell(winding.value);
    tell(winding.status);
    tell(signed_distance(blob_, point(1), length(3)));
    const auto contacts = [&](const auto& shape) {
        std::array<Contact, 9> found;
        const Filled places = find_contacts(blob_, shape, length(3), found);
        tell(std::uint64_t{places.count});
        tell(places.status);
        tell(std::uint64_t{reduce_contacts(places.in(found))});
        for (const Contact& contact : places.in(found)) {
            tell(contact.point);
            tell(contact.normal);
            tell(contact.distance);
            tell(contact.triangle);
            tell(contact.feature);
            tell(contact.side);
        }
    };
    contacts(sphere());
    contacts(capsule());
    contacts(oriented_box());
    const std::array<Vec3, 4> vertices = all_points();
    contacts(convex_hull(vertices));
    const auto rounding = [&](const auto& shape, auto... way) {
        const Result<float> moved = rounding_error(blob_, shape, way...);
        tell(moved.value);
        tell(moved.status);
    };
    rounding(point(0));
    rounding(Ray{.origin = point(0), .direction = direction(0)});
    rounding(segment());
    rounding(sphere());
    rounding(capsule());
    rounding(box());
    rounding(oriented_box());
    rounding(triangle());
    rounding(sphere(), direction(1));
    rounding(capsule(), direction(1));
    rounding(box(), direction(1));
    rounding(oriented_box(), direction(1));
    rounding(convex_hull(vertices), direction(1));
}

template <class Shape>
void Expecting::moving(const Shape& shape) {
    tell(sweep(blob_, shape, direction(0)));
    const auto filter = [&](TriangleId triangle) { return counts(triangle); };
    tell(sweep(blob_, shape, direction(0), filter));
    SweepOptions options;
    if ((asked_.bits & 4) != 0) options.filter = filter;
    options.skin = asked_.lengths[1];
    options.culling = static_cast<FaceCulling>(asked_.bits & 3);
    options.ignore_leaving = (asked_.bits & 8) != 0;
    tell(sweep(blob_, shape, direction(0), options));
}

void Expecting::sweeps() {
    moving(sphere());
    moving(capsule());
    moving(box());
    moving(oriented_box());
    const std::array<Vec3, 4> vertices = all_points();
    moving(convex_hull(vertices));
}

void Expecting::tell(const PairContact& contact) {
    tell(contact.a);
    tell(contact.b);
    tell(contact.status);
}

void Expecting::tell(const PairTouch& touch) {
    tell(touch.a);
    tell(touch.b);
    tell(touch.status);
    tell(std::uint32_t{touch.count});
    for (unsigned i = 0; i < touch.count; ++i) tell(touch.points[i]);
    tell(touch.normal);
    tell(touch.depth);
    const Contact first = touch.contact(0);
    tell(first.point);
    tell(first.distance);
}

void Expecting::tell(const BlobDistance& nearest) {
    tell(nearest.distance);
    tell(nearest.on_a);
    tell(nearest.on_b);
    tell(nearest.a);
    tell(nearest.b);
    tell(nearest.status);
}

void Expecting::placed(const Transform& own_placement, const Transform& placement, WorkLimit limit) {
    const PlacedBlob a(blob_, own_placement), b(other_, placement);
    tell(overlaps(a, b, limit).status());
    const PairContact first = first_contact(a, b, limit);
    tell(first);
    visits_ = asked_.bits % 9;
    const auto visit = [&](const PairContact& each) {
        tell(each);
        return visit_one();
    };
    tell(for_each_contact(a, b, visit, limit));
    Cursor from;
    for (int page = 0; page < 2; ++page) {
        std::array<PairContact, 5> contacts;
        const Filled filled = collect_contacts(a, b, contacts, limit, from);
        tell(std::uint64_t{filled.count});
        tell(filled.status);
        for (const PairContact& each : filled.in(contacts)) tell(each);
        from = filled.next;
        for (const std::uint32_t place : from.place) tell(place);
    }
    std::array<PairTouch, 5> touches;
    const Filled filled = collect_touches(a, b, touches, limit);
    tell(std::uint64_t{filled.count});
    tell(filled.status);
    for (const std::uint32_t place : filled.next.place) tell(place);
    for (const PairTouch& each : filled.in(touches)) tell(each);
    tell(pair_touch(a, b, first));
    visits_ = asked_.bits % 5;
    const auto visit_touch = [&](const PairTouch& each) {
        tell(each);
        return visit_one();
    };
    tell(for_each_touch(a, b, visit_touch, limit));
    tell(distance(a, b, limit, length(1)));
    tell(within_distance(a, b, length(2), limit).status());
    PairCounters counters = {1, 2, 3};
    tell(first_contact(a, b, limit, counters));
    tell(distance(a, b, limit, length(1), counters));
    tell(counters.box_pairs);
    tell(counters.leaf_pairs);
    tell(counters.triangle_pairs);
}

void Expecting::pairs() {
    const WorkLimit limit(asked_.bits % 8 == 0 ? asked_.bits % 50 : 300);
    placed({}, {{}, direction(0)}, limit);
    const float* q = asked_.rotation;
    const Transform placement = {{q[0], q[1], q[2], q[3]}, direction(1), length(0)};
    placed({}, placement, limit);
    placed(placement, {{}, direction(0)}, limit);
}

void Expecting::approximations() {
    QueryCounters counters;
    QueryCounters* counting = asked_.bits % 3 == 0 ? nullptr : &counters;
    tell(overlaps(blob_, sphere(), Accuracy{length(3)}, counting).status());
    tell(counters);
    tell(overlaps(blob_, box(), Accuracy{length(3)}, counting).status());
    tell(counters);
    tell(occluded(blob_, {point(1), direction(1)}, Accuracy{length(3)}, counting));
    tell(counters);
    const Result<DistanceBounds> bounds = distance_bounds(blob_, point(2), length(1), Accuracy{length(3)}, counting);
    tell(bounds.status);
    tell(bounds->lower);
    tell(bounds->upper);
    tell(counters);
}

}  // namespace espalier::tests
