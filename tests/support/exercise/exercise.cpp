#include "exercise.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <stdexcept>

#include <espalier/espalier.hpp>
#include <runtime/small_code.hpp>

#include "support/base/answer_hash.hpp"
#include "support/base/hostile_values.hpp"
#include "support/blobs/measured_blob.hpp"
#include "support/machine/float_mode.hpp"
#include "support/queries/hostile_arguments.hpp"

namespace espalier::tests {

namespace {

/// The first thing that was wrong. Kept until the end: nothing may be thrown through the runtime, which has no
/// exceptions.
class Verdict {
public:
    void require(bool holds, const char* what) {
        if (!holds && first_ == nullptr) first_ = what;
    }
    void speak() const {
        if (first_ != nullptr) throw std::runtime_error(first_);
    }

private:
    const char* first_ = nullptr;
};

/// What all exercises share.
struct Exercise {
    const MeasuredBlob& blob;
    Random& random;
    AnswerHash hash;
    Verdict verdict;
    bool sound;  ///< whether the order of a walk changes no answer: boxes hold what is below them
};

bool is_number(float value) { return value == value; }

Vec3 moved(Vec3 point, Vec3 by) {
    return {plain_sum(point.x, by.x), plain_sum(point.y, by.y), plain_sum(point.z, by.z)};
}

Vec3 difference(Vec3 to, Vec3 from) { return moved(to, {-from.x, -from.y, -from.z}); }

Vec3 scaled_by(Vec3 v, float factor) {
    return {plain_product(v.x, factor), plain_product(v.y, factor), plain_product(v.z, factor)};
}

float plain_dot(Vec3 a, Vec3 b) {
    return plain_sum(plain_sum(plain_product(a.x, b.x), plain_product(a.y, b.y)), plain_product(a.z, b.z));
}

void check_hit(Exercise& run, const RayHit& hit) {
    const MeasuredBlob& blob = run.blob;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    verdict.require(hit.triangle.index < blob.triangle_count(), "a ray hit a triangle that does not exist");
    verdict.require(is_number(hit.t) && hit.t >= 0.0f, "a hit's t is negative or NaN");
    verdict.require(is_number(hit.u) && is_number(hit.v), "a hit's barycentrics are NaN");
    verdict.require(is_number(hit.normal.x) && is_number(hit.normal.y) && is_number(hit.normal.z),
                    "a hit's normal is NaN");
    hash.add(hit.triangle.index);
    hash.add(hit.t);
    hash.add(hit.u);
    hash.add(hit.v);
    hash.add(hit.normal);
    const OriginalHit original = original_hit(blob, hit);
    verdict.require(original || original.status == QueryStatus::no_data, "a hit does not lead back");
    hash.add(original.triangle);
    hash.add(original.u);
    hash.add(original.v);
}

void exercise_rays(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    Ray ray;
    ray.origin = some_point(blob, random);
    if (random.coin()) {
        const Vec3 target = some_point(blob, random);
        ray.direction = difference(target, ray.origin);
    } else {
        ray.direction = some_point(blob, random);
    }
    if (random.below(3) == 0) ray.t_min = hostile_values[random.below(hostile_values.size())];
    if (random.below(3) == 0) ray.t_max = hostile_values[random.below(hostile_values.size())];
    ray.faces = static_cast<Faces>(random.below(4));  // one value more than the type names
    const std::uint32_t parity = random.below(2);
    const auto filter = [&](Triangle triangle) {
        verdict.require(triangle.index < blob.triangle_count(),
                        "a filter was asked about a triangle that does not exist");
        return triangle.index % 2 == parity;
    };

    RayHit hit;
    const bool found = raycast(blob, ray, hit);
    if (found) check_hit(run, hit);
    verdict.require(occluded(blob, ray) == found, "occluded and raycast disagree");
    QueryCounters counters;
    RayHit counted;
    verdict.require(raycast_counted(blob, ray, counted, counters) == found || !run.sound,
                    "the counted query and raycast disagree");
    verdict.require(!found || !run.sound || counted.triangle == hit.triangle, "the counted query hit something else");
    RayHit rounded_hit;
    bool rounded_any = false;
    const RoundedRay rounded = round_ray(lattice_of(blob.for_walks(2)), ray);
    const QueryStatus refused = raycast(blob, rounded, rounded_hit);
    verdict.require(occluded(blob, rounded, rounded_any) == refused, "occluded and raycast refuse differently");
    verdict.require(refused != QueryStatus::ok || rounded_any == found || !run.sound,
                    "a ray and the same one rounded before disagree");
    if (refused == QueryStatus::ok && rounded_any) check_hit(run, rounded_hit);
    if (parity != 0) {
        std::array<Ray, 20> rays;  // a group, and strangers
        rays.fill(ray);
        rays.back().direction = ray.origin;
        std::array<RayHit, 20> hits;
        std::array<std::uint8_t, 20> answers;
        const Blob& twenty = blob.for_walks(rays.size());
        const std::size_t count = raycast(twenty, rays, hits);
        verdict.require(occluded(blob.for_walks(rays.size()), rays, answers) == count,
                        "occluded and raycast disagree about a batch");
        for (std::size_t i = 0; i < rays.size(); ++i)
            verdict.require((hits[i].triangle != no_triangle) == (answers[i] != 0), "answers of a batch disagree");
        verdict.require(!found || !run.sound || hits[0].triangle == hit.triangle, "a ray alone and a batch disagree");
    }
    std::array<RayHit, 4> first;
    const HitCount count = closest_hits(blob, ray, first);
    verdict.require((count.count > 0) == found && count.count <= first.size(), "closest_hits and raycast disagree");
    verdict.require(count.status == QueryStatus::ok || count.count == first.size(),
                    "an array that is not full is told full");
    for (std::size_t i = 0; i < count.count; ++i) {
        check_hit(run, first[i]);
        verdict.require(i == 0 || first[i - 1].t <= first[i].t, "closest_hits are not sorted");
    }
    const Segment segment = {ray.origin, ray.direction};
    RayHit on_segment;
    const bool segment_hits = raycast(blob, segment, on_segment);
    if (segment_hits) check_hit(run, on_segment);
    verdict.require(!segment_hits || on_segment.t <= 1.0f, "a segment is hit beyond its end");
    verdict.require(occluded(blob, segment) == segment_hits, "occluded and raycast disagree about a segment");
    RayHit filtered;
    const bool found_filtered = raycast(blob, ray, filtered, filter);
    if (found_filtered) check_hit(run, filtered);
    verdict.require(occluded(blob, ray, filter) == found_filtered, "occluded and raycast disagree under a filter");
    std::uint32_t visited = 0;
    std::uint32_t last = 0;
    const bool saw_all = for_each_hit(blob, ray, [&](const RayHit& each) {
        check_hit(run, each);
        verdict.require(visited == 0 || each.triangle.index > last, "hits are not in storage order");
        last = each.triangle.index;
        return ++visited == 64 ? stop : keep_going;
    });
    const bool enumerates = blob.copy_count() == 0;  // copies are refused
    verdict.require((visited > 0) == (found && enumerates), "for_each_hit and raycast disagree");
    verdict.require(saw_all == (visited < 64 && enumerates), "for_each_hit says wrongly whether it saw all");
}

void exercise_spheres(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    const Sphere sphere{some_point(blob, random), some_length(blob, random)};
    const bool any = overlaps(blob, sphere);
    std::uint32_t visited = 0;
    std::uint32_t last = 0;
    for_each_overlap(blob, sphere, [&](Triangle triangle) {
        verdict.require(triangle.index < blob.triangle_count(), "a sphere overlaps a triangle that does not exist");
        verdict.require(visited == 0 || triangle.index > last, "overlaps are not in storage order");
        last = triangle.index;
        hash.add(triangle.index);
        return ++visited == 64 ? stop : keep_going;
    });
    verdict.require((visited > 0) == (any && blob.copy_count() == 0), "for_each_overlap and overlaps disagree");
}

void check_nearest(Exercise& run, const Nearest& nearest) {
    run.verdict.require(nearest.triangle.index < run.blob.triangle_count(), "the nearest triangle does not exist");
    run.verdict.require(nearest.distance >= 0.0f, "the nearest distance is negative or NaN");
    run.verdict.require(nearest.feature <= Feature::vertex_c, "the nearest point lies on no feature");
    run.hash.add(nearest.triangle.index);
    run.hash.add(nearest.distance);
    run.hash.add(nearest.u);
    run.hash.add(nearest.v);
    run.hash.add(nearest.point);
    run.hash.add(static_cast<std::uint32_t>(nearest.feature));
}

void exercise_distances(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    const Vec3 point = some_point(blob, run.random);
    const float max_distance = some_length(blob, run.random);
    Nearest nearest;
    const bool found = closest_point(blob, point, max_distance, nearest);
    if (found) check_nearest(run, nearest);
    std::array<Nearest, 9> few;
    const std::size_t count = closest_triangles(blob, point, max_distance, few);
    run.verdict.require((count > 0) == found && count <= few.size(), "closest_triangles and closest_point disagree");
    for (std::size_t i = 0; i < count; ++i) {
        check_nearest(run, few[i]);
        run.verdict.require(i == 0 || few[i].distance >= few[i - 1].distance, "the closest triangles are not sorted");
    }
    const Vec3 end = some_point(blob, run.random);
    NearestPair pairs[2];
    const bool answered[2] = {
        closest_to_segment(blob, {point, end}, max_distance, pairs[0]) == QueryStatus::ok,
        closest_to_box(blob, {point, end}, max_distance, pairs[1]) == QueryStatus::ok,
    };
    for (int i = 0; i < 2; ++i) {
        if (!answered[i]) continue;
        const NearestPair& pair = pairs[i];
        run.verdict.require(pair.triangle == no_triangle || pair.triangle.index < blob.triangle_count(),
                            "the nearest triangle of a pair does not exist");
        run.verdict.require(pair.distance >= 0.0f, "the distance of a pair is negative or NaN");
        run.hash.add(pair.triangle.index);
        run.hash.add(pair.distance);
        run.hash.add(pair.u);
        run.hash.add(pair.v);
        run.hash.add(pair.on_shape);
        run.hash.add(pair.on_surface);
    }
    for (const Result<float>& moved : {rounding_error(blob, point), rounding_error(blob, Segment{point, end}),
                                       rounding_error(blob, Ray{.origin = end, .direction = point})}) {
        run.verdict.require(moved.value >= 0.0f, "how far rounding moves a query is negative or NaN");
        run.hash.add(static_cast<std::uint32_t>(moved.status));
        run.hash.add(moved.value);
    }
    bool inside = false;
    const QueryStatus status = contains(blob, point, inside);
    run.hash.add(static_cast<std::uint32_t>(status));
    run.hash.add(std::uint32_t{inside});
    Nearest signed_nearest;
    if (signed_distance(blob.for_walks(2), point, max_distance, signed_nearest) == QueryStatus::ok) {
        run.verdict.require(status == QueryStatus::ok, "contains and signed_distance disagree");
        run.verdict.require((signed_nearest.triangle != no_triangle) == found,
                            "signed_distance and closest_point disagree");
        run.verdict.require(inside || !(signed_nearest.distance < 0.0f), "a distance outside is negative");
        run.hash.add(signed_nearest.distance);
    }
}

/// The three ways of asking about one shape.
template <class Shape>
void exercise_volume(Exercise& run, const Shape& shape) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const bool any = overlaps(blob, shape);
    std::array<Triangle, 16> seen;
    std::uint32_t visited = 0;
    for_each_overlap(blob, shape, [&](Triangle triangle) {
        verdict.require(triangle.index < blob.triangle_count(), "a volume overlaps a triangle that does not exist");
        verdict.require(visited == 0 || triangle.index > seen[visited - 1].index, "overlaps are not in storage order");
        seen[visited] = triangle;
        return ++visited == seen.size() ? stop : keep_going;
    });
    verdict.require((visited > 0) == (any && blob.copy_count() == 0), "a visitor of overlaps and any overlap disagree");
    std::array<Triangle, 5> page;
    std::uint32_t first = 0;
    for (std::uint32_t found = 0; found + page.size() <= seen.size();) {
        const OverlapPage answer = collect_overlaps(blob, shape, page, first);
        verdict.require(answer.count <= page.size(), "a page of overlaps has more than it can hold");
        for (std::uint32_t i = 0; i < answer.count; ++i, ++found) {
            verdict.require(found < visited && page[i] == seen[found], "a page of overlaps and the visitor disagree");
            run.hash.add(page[i].index);
        }
        if (answer.status != QueryStatus::output_full) {
            verdict.require(answer.status != QueryStatus::ok || found == visited, "pages of overlaps end too early");
            break;
        }
        first = answer.next;
    }
    const auto anywhere = static_cast<std::uint32_t>(run.random.next());
    run.hash.add(collect_overlaps(blob, shape, page, anywhere).next);
}

void exercise_volumes(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    const Vec3 a = some_point(blob, random), b = some_point(blob, random), c = some_point(blob, random);
    const Vec3 d = some_point(blob, random);
    const float length = some_length(blob, random);
    // Two of them a round.
    switch (random.below(4)) {
        case 0:
            exercise_volume(run, Sphere{a, length});
            exercise_volume(run, Capsule{a, b, length});
            break;
        case 1:
            exercise_volume(run, Box{a, b});
            exercise_volume(run, Box{a, moved(a, {length, length, length})});
            break;
        case 2:
            exercise_volume(run, OrientedBox{a, {b, c, d}});
            exercise_volume(run, OrientedBox{a, {{length, 0.0f, length}, difference(b, a), {}}});
            break;
        default: {
            exercise_volume(run, Corners{a, b, c});
            std::array<Plane, max_planes + 1> planes;
            for (Plane& plane : planes) {
                const Vec3 on = some_point(blob, random);
                const Vec3 normal = random.below(8) == 0 ? on : random.in_cube(1.0f);
                plane = {normal, plain_sum(plain_dot(normal, on), plain_product(0.1f, length))};
            }
            const std::size_t count = random.coin() ? random.below(7) : random.below(planes.size() + 1);
            exercise_volume(run, std::span<const Plane>(planes).first(count));
        }
    }
}

/// In lattice steps: near the asset more often than not, at the ends of the range, or anything.
std::int32_t some_steps(const Exercise& run, Random& random, int axis) {
    const std::int32_t extent = lattice_of(run.blob.unmeasured()).extent[axis];
    switch (random.below(8)) {
        case 0:
            return static_cast<std::int32_t>(random.next());
        case 1:
            return random.coin() ? max_segment_steps : -max_segment_steps;
        case 2:
            return 0;
        case 3:
            return extent;
        default:
            return random.between(-extent / 4 - 1, extent + extent / 4 + 1);
    }
}

void exercise_steps(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    Verdict& verdict = run.verdict;
    const auto some_place = [&] {
        const std::int32_t x = some_steps(run, random, 0);
        const std::int32_t y = some_steps(run, random, 1);
        return Steps{x, y, some_steps(run, random, 2)};
    };
    const SegmentInSteps segment = {some_place(), some_place()};
    HitInSteps hit;
    bool any = false;
    const QueryStatus status = first_hit(blob, segment, hit);
    verdict.require(any_hit(blob, segment, any) == status, "any_hit and first_hit disagree about the range");
    verdict.require(any == (hit.triangle != no_triangle), "any_hit and first_hit disagree");
    if (any) {
        verdict.require(hit.triangle.index < blob.triangle_count(), "a segment hit a triangle that does not exist");
        verdict.require(hit.t <= 1u << 31, "a segment is hit beyond its end");
        run.hash.add(hit.triangle.index);
        run.hash.add(hit.t);
        run.hash.add(static_cast<std::uint32_t>(hit.side));
    }
    exercise_volume(run, BoxInSteps{segment.from, segment.to});
    const Lattice lattice = lattice_of(blob.unmeasured());
    const Box world = {some_point(blob, random), some_point(blob, random)};
    Steps nearest;
    BoxInSteps around;
    if (to_steps(lattice, world.min, nearest) == QueryStatus::ok) {
        run.hash.add(static_cast<std::uint32_t>(nearest.x));
        const Vec3 back = to_world(lattice, nearest);
        verdict.require(is_number(back.x) && is_number(back.y) && is_number(back.z), "a lattice point is nowhere");
    }
    if (steps_around(lattice, world, around) == QueryStatus::ok) {
        verdict.require(overlaps(blob, around) || !overlaps(blob, world),
                        "a box in steps misses what the box in it overlaps");
        run.hash.add(static_cast<std::uint32_t>(around.max.z));
    }
}

void exercise_bounds(Exercise& run) {
    AnswerHash& hash = run.hash;
    Sphere sphere;
    if (bounding_sphere(run.blob, sphere)) {
        hash.add(sphere.center);
        hash.add(sphere.radius);
    }
    const Sphere asked = {some_point(run.blob, run.random), some_length(run.blob, run.random)};
    hash.add(std::uint32_t{is_outside_bounds(run.blob, asked)});
    hash.add(std::uint32_t{is_outside_bounds(run.blob, Box{some_point(run.blob, run.random), asked.center})});
    OrientedBox box;
    if (oriented_bounds(run.blob, box)) {
        hash.add(box.center);
        for (const Vec3& axis : box.half_axes) hash.add(axis);
    }
    KDop k_dop;
    if (k_dop_bounds(run.blob, k_dop)) {
        for (unsigned k = 0; k < KDop::count; ++k) {
            hash.add(k_dop.lo[k]);
            hash.add(k_dop.hi[k]);
        }
    }
}

void exercise_nodes(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    std::uint32_t visited = 0;
    const std::uint32_t until = 1 + run.random.below(300);
    const bool saw_all = for_each_node(blob, [&](const TreeNode& node) {
        run.verdict.require(node.depth >= 1 && node.depth <= blob.depth(), "a node is deeper than the tree");
        run.hash.add(node.number);
        for (unsigned i = 0; i < node.child_count; ++i) {
            const TreeChild& child = node.children[i];
            run.verdict.require(!child.is_leaf || child.first.index + child.count <= blob.triangle_count(),
                                "a leaf has triangles that do not exist");
            run.hash.add(child.box.min);
            run.hash.add(child.box.max);
        }
        if (++visited == until) return NodeVisit::end;
        return node.number % 5 == 4 ? NodeVisit::skip : NodeVisit::descend;
    });
    run.verdict.require(saw_all == (visited < until), "for_each_node says wrongly whether it saw all");
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
    verdict.require(may_overlap(blob, sphere, accuracy, &counters) || !overlaps(blob, sphere), "a sphere was missed");
    verdict.require(may_overlap(blob, sphere, 0.0f) == overlaps(blob, sphere), "accuracy 0 is not exact for a sphere");
    verdict.require(may_overlap(blob, box, accuracy) || !overlaps(blob, box), "a box was missed");
    verdict.require(may_overlap(blob, box, 0.0f) == overlaps(blob, box), "accuracy 0 is not exact for a box");
    // Small code sees the boxes of the two in different ways: what is not in its box may be met by one of them alone.
    verdict.require(may_be_occluded(blob, ray, accuracy) || !occluded(blob, ray) || (detail::small_code && !run.sound),
                    "a hit was missed");
    verdict.require(may_be_occluded(blob, ray, 0.0f) == occluded(blob, ray), "accuracy 0 is not exact for a ray");
    DistanceBounds bounds;
    if (distance_bounds(blob, sphere.center, sphere.radius, accuracy, bounds)) {
        verdict.require(bounds.lower >= 0.0f && (!run.sound || bounds.lower <= bounds.upper),
                        "bounds of a distance are none");
        run.hash.add(bounds.lower);
        run.hash.add(bounds.upper);
    }
    run.hash.add(static_cast<std::uint32_t>(counters.nodes));
}

template <class Shape>
void exercise_sweep(Exercise& run, const Shape& shape, Vec3 displacement) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const std::uint32_t parity = run.random.below(2);
    const auto filter = [&](Triangle triangle) {
        verdict.require(triangle.index < blob.triangle_count(),
                        "a filter was asked about a triangle that does not exist");
        return triangle.index % 2 == parity;
    };
    SweepHit hits[2];
    hits[0].t = hits[1].t = -1.0f;
    const bool found = sweep(blob, shape, displacement, hits[0]);
    const bool found_filtered = sweep(blob, shape, displacement, hits[1], filter);
    verdict.require(!found || check_sweep(blob, shape, displacement) == QueryStatus::ok, "a refused sweep hit");
    verdict.require(found || !found_filtered, "a sweep under a filter hits more than without");
    for (const SweepHit& hit : hits) {
        if (!(&hit == hits ? found : found_filtered)) {
            verdict.require(hit.t == -1.0f, "a sweep that hit nothing changed the hit");
            continue;
        }
        verdict.require(hit.triangle.index < blob.triangle_count(), "a sweep hit a triangle that does not exist");
        verdict.require(hit.t >= 0.0f && hit.t < 1.0f, "a sweep's t is out of range or NaN");
        verdict.require(!hit.starts_overlapping || hit.t == 0.0f, "a sweep that starts overlapping takes its time");
        const Vec3& n = hit.normal;
        verdict.require(n.x * n.x + n.y * n.y + n.z * n.z > 0.999f, "a sweep's normal is not of unit length");
        verdict.require(is_number(hit.point.x + hit.point.y + hit.point.z), "a sweep's point is NaN");
        run.hash.add(hit.triangle.index);
        run.hash.add(hit.t);
        run.hash.add(hit.point);
        run.hash.add(hit.normal);
    }
}

void exercise_sweeps(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    const Vec3 a = some_point(blob, random), b = some_point(blob, random), c = some_point(blob, random);
    const float length = some_length(blob, random);
    const Vec3 way = random.coin() ? difference(c, a) : c;
    exercise_sweep(run, Sphere{a, length}, way);
    exercise_sweep(run, Capsule{a, b, length}, way);
    exercise_sweep(run, Box{a, b}, way);
    exercise_sweep(run, Box{a, moved(a, {length, length, length})}, way);
}

Placement some_placement(const Blob& blob, Random& random) {
    Placement placement;
    if (random.coin()) {
        const Vec3 axis = random.below(4) == 0 ? some_point(blob, random) : random.in_cube(1.0f);
        placement.rotation = {axis.x, axis.y, axis.z, random.signed_unit()};
    }
    if (random.below(8) == 0) {
        placement.translation = some_point(blob, random);
    } else {
        const float length = some_length(blob, random);
        placement.translation = scaled_by(random.in_cube(1.0f), length);
    }
    if (random.below(3) == 0) placement.scale = random.coin() ? random.unit() * 4.0f : some_length(blob, random);
    return placement;
}

/// The blob against itself.
void exercise_pairs(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Verdict& verdict = run.verdict;
    const Placement placement = some_placement(blob, run.random);
    // Less for large leaves: each pair of them takes as many tests as they have pairs of triangles.
    const std::uint64_t most = std::min<std::uint64_t>(2'000, 20'000 / (blob.triangle_count() + 1) + 20);
    const WorkLimit limit = {run.random.below(4) == 0 ? run.random.below(50) : most};
    const auto check_pair = [&](const TrianglePair& pair) {
        verdict.require(pair.a.index < blob.triangle_count() && pair.b.index < blob.triangle_count(),
                        "a triangle of a pair does not exist");
        run.hash.add(pair.a.index);
        run.hash.add(pair.b.index);
    };
    bool touching = false, found = false;
    const Blob& other = blob.unmeasured();
    const QueryStatus status = collides(blob.for_pairs(limit.pairs), other, placement, touching, limit);
    run.hash.add(static_cast<std::uint32_t>(status));
    TrianglePair first;
    verdict.require(first_contact(blob.for_pairs(limit.pairs), other, placement, first, found, limit) == status &&
                        found == touching,
                    "collides and first_contact disagree");
    if (found) check_pair(first);
    std::array<TrianglePair, 9> pairs;
    std::size_t count = 0;
    const QueryStatus listed = all_contacts(blob.for_pairs(limit.pairs), other, placement, pairs, count, limit);
    if (blob.copy_count() != 0) {
        verdict.require(listed == QueryStatus::has_copies, "pairs of copies are listed");
    } else {
        verdict.require(count <= pairs.size(), "more pairs than there is room for");
        verdict.require((count > 0) == found && (count == 0 || pairs[0] == first), "the first pair is not the first");
        for (std::size_t i = 0; i < count; ++i) check_pair(pairs[i]);
    }
    std::uint32_t visited = 0;
    const QueryStatus enumerated = for_each_contact(
        blob.for_pairs(limit.pairs), other, placement,
        [&](const TrianglePair& pair) {
            verdict.require(visited >= count || pairs[visited] == pair, "a list and a visitor disagree");
            return ++visited == 64 ? stop : keep_going;
        },
        limit);
    verdict.require(
        visited >= count && (enumerated == QueryStatus::ok || enumerated == QueryStatus::work_limit || visited == 0),
        "a refused query visits pairs");
    PairDistance nearest;
    const float max_distance = some_length(blob, run.random);
    const QueryStatus answered =
        minimum_distance(blob.for_pairs(limit.pairs), other, placement, max_distance, nearest, found, limit);
    run.hash.add(static_cast<std::uint32_t>(answered));
    bool within = false;
    const QueryStatus decided =
        within_distance(blob.for_pairs(limit.pairs), other, placement, max_distance, within, limit);
    if (answered == QueryStatus::ok && decided == QueryStatus::ok)
        verdict.require(found == within, "minimum_distance and within_distance disagree");
    if ((answered == QueryStatus::ok || answered == QueryStatus::work_limit) && found) {
        check_pair(nearest.pair);
        verdict.require(nearest.distance >= 0.0f && nearest.distance <= max_distance,
                        "a distance of two blobs is NaN or out of range");
        verdict.require(!touching || !run.sound || nearest.distance == 0.0f, "blobs that touch are apart");
        run.hash.add(nearest.distance);
        run.hash.add(nearest.on_a);
        run.hash.add(nearest.on_b);
    }
}

void exercise_lookups(Exercise& run) {
    const MeasuredBlob& blob = run.blob;
    Random& random = run.random;
    AnswerHash& hash = run.hash;
    Verdict& verdict = run.verdict;
    const std::uint32_t indices[] = {0, random.below(blob.triangle_count() + 1), blob.triangle_count(), 0x80000000u,
                                     0xFFFFFFFFu};
    for (const std::uint32_t index : indices) {
        OriginalTriangle original;
        if (original_triangle(blob, {index}, original)) {
            verdict.require(index < blob.triangle_count(), "a triangle that does not exist has an original");
            hash.add(original.file);
            hash.add(original.mesh);
            hash.add(original.triangle);
            hash.add(original.first_corner);
            verdict.require(original.first_corner < 3, "a triangle begins with a corner that it does not have");
        }
        const RayHit hit = {0.0f, hostile_values[random.below(hostile_values.size())], 0.5f, {}, {index}};
        const OriginalHit turned = original_hit(blob, hit);
        verdict.require(!turned || index < blob.triangle_count(), "a hit of no triangle leads back");
        hash.add(static_cast<std::uint32_t>(turned.status));
        hash.add(std::uint32_t{material(blob, {index})});
        EdgeKinds kinds;
        if (edge_kinds(blob, {index}, kinds))
            for (const EdgeKind kind : {kinds.ab, kinds.bc, kinds.ca}) hash.add(static_cast<std::uint32_t>(kind));
        Corners corners;
        const bool exists = triangle_corners(blob, {index}, corners);
        verdict.require(exists == (index < blob.triangle_count()), "corners of a triangle that does not exist");
        hash.add(corners.c);
        Vec3 normal;
        const Contact contact = {{index}, static_cast<Feature>(random.below(8)), some_point(blob, random)};
        if (is_on_inner_edge(blob, contact, normal)) {
            verdict.require(exists, "a triangle that does not exist has an inner edge");
            hash.add(normal);
        }
    }
    hash.add(blob.step());
    hash.add(blob.bounds_min());
    hash.add(blob.bounds_max());
    std::uint32_t visited = 0;
    std::uint32_t next = 0;
    for_each_triangle(blob, [&](Triangle triangle, const Corners& corners) {
        const bool follows = blob.copy_count() == 0 ? triangle.index == next : triangle.index >= next;
        verdict.require(follows, "triangles are not walked in storage order");
        next = triangle.index + 1;
        ++visited;
        hash.add(corners.a);
        hash.add(corners.b);
        hash.add(corners.c);
        return visited == 4096 ? stop : keep_going;
    });
}

}  // namespace

std::uint64_t exercise(const Blob& blob, Random& random, unsigned rounds, bool sound) {
    const MeasuredBlob measured(blob);
    Exercise run{measured, random, {}, {}, sound};
    exercise_lookups(run);
    exercise_bounds(run);
    exercise_nodes(run);
    for (unsigned i = 0; i < rounds; ++i) {
        exercise_rays(run);
        exercise_spheres(run);
        exercise_volumes(run);
        exercise_approximate(run);
        exercise_distances(run);
        exercise_sweeps(run);
        exercise_pairs(run);
        exercise_steps(run);
    }
    run.verdict.require(measured.is_within_bounds(), "a query took more steps than it may");
    run.verdict.speak();
    return run.hash.value();
}

}  // namespace espalier::tests
