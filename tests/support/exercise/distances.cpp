#include "run.hpp"

namespace espalier::tests::exercises {

namespace {

void check_nearest(Exercise& run, const ClosestPoint& nearest) {
    run.verdict.require(nearest.triangle.index < run.blob.triangle_count(), "the nearest triangle does not exist");
    run.verdict.require(nearest.distance >= 0.0f, "the nearest distance is negative or NaN");
    run.verdict.require(nearest.feature <= Feature::vertex_c, "the nearest point lies on no feature");
    run.hash.add(nearest.triangle.index, nearest.distance, nearest.u, nearest.v, nearest.point,
                 static_cast<std::uint32_t>(nearest.feature), nearest.on_shape, nearest.face_normal,
                 static_cast<std::uint32_t>(nearest.side));
}

/// The contacts of a body: sorted, of triangles that exist, and the few that are kept are among them.
template <class Shape>
void check_contacts(Exercise& run, const Shape& shape, float margin) {
    std::array<Contact, 12> contacts;
    const Filled found = find_contacts(run.blob.for_contacts(), shape, margin, contacts);
    run.hash.add(static_cast<std::uint32_t>(found.status));
    run.verdict.require(found.count <= contacts.size(), "there are more contacts than places");
    for (std::size_t i = 0; i < found.count; ++i) {
        const Contact& contact = contacts[i];
        run.verdict.require(contact.triangle.index < run.blob.triangle_count(), "a contact has no triangle");
        run.verdict.require(contact.distance <= margin, "a contact is farther than the margin, or NaN");
        run.verdict.require(i == 0 || contacts[i - 1].distance <= contact.distance, "contacts are not sorted");
        run.verdict.require(contact.feature <= Feature::vertex_c, "a contact lies on no feature");
        run.hash.add(contact.triangle.index, contact.distance, contact.point, contact.normal,
                     static_cast<std::uint32_t>(contact.feature), static_cast<std::uint32_t>(contact.side));
    }
    const std::size_t kept = reduce_contacts(found.in(contacts));
    run.verdict.require(kept <= max_reduced_contacts && (kept == 0) == (found.count == 0),
                        "more or fewer contacts are kept than can be");
    for (std::size_t i = 0; i < kept; ++i) run.hash.add(contacts[i].triangle.index);
}

/// The planes of a capsule: sorted, of triangles that exist; and the way along them keeps off each.
void check_planes(Exercise& run, const Capsule& capsule, float margin, const Vec3& wish) {
    std::array<ContactPlane, 5> planes;
    const Filled found = collect_planes(run.blob.for_contacts(), capsule, margin, planes);
    run.hash.add(static_cast<std::uint32_t>(found.status));
    run.verdict.require(found.count <= planes.size(), "there are more planes than places");
    for (std::size_t i = 0; i < found.count; ++i) {
        const ContactPlane& plane = planes[i];
        run.verdict.require(plane.triangle.index < run.blob.triangle_count(), "a plane has no triangle");
        run.verdict.require(plane.distance <= margin, "a plane is farther than the margin, or NaN");
        run.verdict.require(i == 0 || planes[i - 1].distance <= plane.distance, "planes are not sorted");
        run.hash.add(plane.triangle.index, plane.distance, plane.normal);
    }
    const Result<Vec3> way = solve_planes(found.in(planes), wish, margin);
    run.hash.add(static_cast<std::uint32_t>(way.status), way.value);
}

void check_contacts_of_hull(Exercise& run, float margin) {
    std::array<Vec3, max_hull_vertices + 1> vertices;
    const std::size_t count = run.random.below(4) != 0 ? run.random.below(9) : run.random.below(vertices.size() + 1);
    for (std::size_t i = 0; i < count; ++i)
        vertices[i] = run.random.coin() ? some_point(run.blob, run.random)
                                        : vertices[run.random.below(vertices.size()) % (i + 1)];
    check_contacts(run, ConvexHull{std::span(vertices).first(count)}, margin);
}

}  // namespace

void exercise_contacts(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    const Vec3 from = some_point(blob, run.random), to = some_point(blob, run.random);
    const float radius = some_length(blob, run.random), margin = some_length(blob, run.random);
    // One body a round: the contacts of all four would take longer than most other queries together.
    const auto kind = run.random.below(4);
    if (kind == 0) return check_contacts(run, Sphere{from, radius}, margin);
    if (kind == 1) {
        check_planes(run, Capsule{from, to, radius}, margin, plain_difference(to, from));
        return check_contacts(run, Capsule{from, to, radius}, margin);
    }
    if (kind == 2)
        return check_contacts(
            run, OrientedBox{from, {{radius, 0.0f, 0.0f}, {0.0f, margin, radius}, plain_difference(to, from)}}, margin);
    return check_contacts_of_hull(run, margin);
}

void exercise_distances(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    const Vec3 point = some_point(blob, run.random);
    const float max_distance = some_length(blob, run.random);
    const ClosestPoint nearest = closest_point(blob, point, max_distance);
    const bool found{nearest};
    if (found) check_nearest(run, nearest);
    std::array<ClosestPoint, 9> few;
    const Filled filled = closest_triangles(blob, point, few, max_distance);
    const std::size_t count = filled.count;
    run.verdict.require(is_refused(filled.status) == is_refused(nearest.status),
                        "one of closest_triangles and closest_point refuses");
    run.verdict.require((count > 0) == found && count <= few.size(), "closest_triangles and closest_point disagree");
    for (std::size_t i = 0; i < count; ++i) {
        check_nearest(run, few[i]);
        run.verdict.require(i == 0 || few[i].distance >= few[i - 1].distance, "the closest triangles are not sorted");
    }
    const Vec3 end = some_point(blob, run.random);
    for (const ClosestPoint& pair :
         {closest_point(blob, Segment{point, end}, max_distance), closest_point(blob, Box{point, end}, max_distance)})
        if (pair) check_nearest(run, pair);
    for (const Result<float>& moved : {rounding_error(blob, point), rounding_error(blob, Segment{point, end}),
                                       rounding_error(blob, Ray{.origin = end, .direction = point})}) {
        run.verdict.require(moved.value >= 0.0f, "how far rounding moves a query is negative or NaN");
        run.hash.add(static_cast<std::uint32_t>(moved.status), moved.value);
    }
    const YesNo inside = contains(blob.for_lists(), point);
    run.hash.add(static_cast<std::uint32_t>(inside.status()));
    const Result<float> winding = winding_number(blob.for_lists(1), point, 2);
    run.hash.add(static_cast<std::uint32_t>(winding.status), winding.value);
    const ClosestPoint with_sign = signed_distance(blob.for_lists(1), point, max_distance);
    run.hash.add(static_cast<std::uint32_t>(with_sign.status));
    if (is_refused(with_sign.status)) return;
    run.verdict.require(!is_refused(inside.status()), "contains and signed_distance disagree");
    run.verdict.require(bool(with_sign) == found, "signed_distance and closest_point disagree");
    run.verdict.require(inside.yes() || !(with_sign.distance < 0.0f), "a distance outside is negative");
    run.hash.add(with_sign.distance);
}

void exercise_approximate(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    const float length = some_length(blob, random);
    const float accuracy = plain_product(length, random.coin() ? 0.01f : 1.0f);
    const Sphere sphere{some_point(blob, random), some_length(blob, random)};
    const Box box{some_point(blob, random), some_point(blob, random)};
    Ray ray{some_point(blob, random), some_point(blob, random)};
    if (random.coin()) ray.t_max = some_length(blob, random);
    QueryCounters counters;
    verdict.require(overlaps(blob, sphere, Accuracy{accuracy}, &counters).yes() || !overlaps(blob, sphere).yes(),
                    "a sphere was missed");
    verdict.require(overlaps(blob, sphere, Accuracy{0.0f}).yes() == overlaps(blob, sphere).yes(),
                    "accuracy 0 is not exact for a sphere");
    verdict.require(overlaps(blob, box, Accuracy{accuracy}).yes() || !overlaps(blob, box).yes(), "a box was missed");
    verdict.require(overlaps(blob, box, Accuracy{0.0f}).yes() == overlaps(blob, box).yes(),
                    "accuracy 0 is not exact for a box");
    // Small code sees the boxes of the two in different ways: what is not in its box may be met by one of them alone.
    verdict.require(occluded(blob, ray, Accuracy{accuracy}).yes() || !occluded(blob, ray).yes() ||
                        (small_code_casts_rays() && !run.sound),
                    "a hit was missed");
    verdict.require(occluded(blob, ray, Accuracy{0.0f}) == occluded(blob, ray), "accuracy 0 is not exact for a ray");
    const Result<DistanceBounds> bounds = distance_bounds(blob, sphere.center, sphere.radius, Accuracy{accuracy});
    run.hash.add(static_cast<std::uint32_t>(bounds.status));
    if (bounds) {
        verdict.require(bounds->lower >= 0.0f && (!run.sound || bounds->lower <= bounds->upper),
                        "bounds of a distance are none");
        run.hash.add(bounds->lower, bounds->upper);
    }
    run.hash.add(static_cast<std::uint32_t>(counters.nodes));
}

}  // namespace espalier::tests::exercises
