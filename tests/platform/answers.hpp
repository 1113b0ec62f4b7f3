// Asks a blob everything the runtime can be asked, and hashes every bit that comes back. No heap, no libc, no doubles:
// the same file runs on a server and on a Cortex-M0.
#pragma once

#include <cstdint>
#include <span>

#include "answer_counts.hpp"
#include "pair_answers.hpp"
#include "questions.hpp"
#include "ray_answers.hpp"

namespace espalier::platform {

/// Edges, bounds and nodes.
inline void read_extras(const Blob& blob, Fingerprint& fingerprint) {
    for (std::uint32_t index = 0; index <= blob.triangle_count(); index += 1 + index / 8) {
        EdgeKinds kinds;
        fingerprint.add(edge_kinds(blob, {index}, kinds));
        fingerprint.add(static_cast<std::uint32_t>(kinds.ab) << 4 | static_cast<std::uint32_t>(kinds.bc) << 2 |
                        static_cast<std::uint32_t>(kinds.ca));
        Corners corners;
        fingerprint.add(triangle_corners(blob, {index}, corners));
        fingerprint.add(corners.b);
        Vec3 normal;
        fingerprint.add(is_on_inner_edge(blob, {{index}, static_cast<Feature>(index % 7), corners.a}, normal));
        fingerprint.add(normal);
    }
    Sphere sphere;
    fingerprint.add(bounding_sphere(blob, sphere));
    fingerprint.add(sphere.center);
    fingerprint.add(sphere.radius);
    const Vec3 low = blob.bounds_min();
    const Vec3 high = blob.bounds_max();
    const Vec3 beside = {low.x, high.y, low.z};
    fingerprint.add(is_outside_bounds(blob, Sphere{beside, 0.125f * (high.x - low.x)}));
    fingerprint.add(is_outside_bounds(blob, Box{{low.x, low.y, high.z}, {low.x, low.y, high.z}}));
    OrientedBox box;
    fingerprint.add(oriented_bounds(blob, box));
    fingerprint.add(box.center);
    for (const Vec3& axis : box.half_axes) fingerprint.add(axis);
    KDop k_dop;
    fingerprint.add(k_dop_bounds(blob, k_dop));
    for (unsigned k = 0; k < KDop::count; ++k) {
        fingerprint.add(k_dop.lo[k]);
        fingerprint.add(k_dop.hi[k]);
    }
    for_each_node(blob, [&](const TreeNode& node) {
        fingerprint.add(node.number);
        fingerprint.add(std::uint32_t{node.depth});
        for (unsigned i = 0; i < node.child_count; ++i) {
            fingerprint.add(node.children[i].box.min);
            fingerprint.add(node.children[i].box.max);
            fingerprint.add(node.children[i].first.index);
        }
        return NodeVisit::descend;
    });
}

template <class Shape>
void ask_sweep(const Blob& blob, const Shape& shape, Vec3 displacement, Answers& answers) {
    SweepHit hit;
    answers.calls += 3;
    answers.fingerprint.add(
        sweep(blob, shape, displacement, hit, [](Triangle triangle) { return triangle.index % 3 != 0; }));
    answers.fingerprint.add(hit.t);
    answers.fingerprint.add(sweep(blob, shape, displacement, hit));
    answers.fingerprint.add(static_cast<std::uint32_t>(check_sweep(blob, shape, displacement)));
    answers.fingerprint.add(hit.t);
    answers.fingerprint.add(hit.point);
    answers.fingerprint.add(hit.normal);
    answers.fingerprint.add(hit.starts_overlapping);
    add_triangle(answers.fingerprint, blob, hit.triangle);
}

inline void ask_sweeps(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Ray ray = questions.ray(number);
        const Vec3 way = number % 8 == 1 || number % 8 == 5 ? questions.displacement(number) : ray.direction;
        const Sphere sphere = questions.sphere(number + 1);
        ask_sweep(blob, Sphere{ray.origin, sphere.radius}, way, answers);
        ask_sweep(blob, Capsule{ray.origin, sphere.center, sphere.radius}, way, answers);
        ask_sweep(blob, Box{ray.origin, {ray.origin.x + sphere.radius, ray.origin.y, ray.origin.z + sphere.radius}},
                  way, answers);
        ask_sweep(blob, questions.box(number), way, answers);
    }
}

inline void ask_spheres(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Sphere sphere = questions.sphere(number);
        std::uint32_t left = 40;
        answers.fingerprint.add(overlaps(blob, sphere));
        const bool saw_all = for_each_overlap(blob, sphere, [&](Triangle triangle) {
            ++answers.overlaps;
            answers.fingerprint.add(triangle.index);
            return --left == 0 ? stop : keep_going;
        });
        ++answers.spheres;
        answers.calls += 2;
        answers.fingerprint.add(saw_all);
    }
}

inline void add_nearest(Fingerprint& fingerprint, const Blob& blob, const Nearest& nearest) {
    fingerprint.add(nearest.point);
    fingerprint.add(nearest.distance);
    fingerprint.add(nearest.u);
    fingerprint.add(nearest.v);
    fingerprint.add(static_cast<std::uint32_t>(nearest.feature));
    add_triangle(fingerprint, blob, nearest.triangle);
}

template <class Shape>
void ask_volume(const Blob& blob, const Shape& shape, Answers& answers) {
    Triangle page[3];
    std::uint32_t left = 12;
    answers.calls += 5;
    answers.fingerprint.add(overlaps(blob, shape));
    answers.fingerprint.add(for_each_overlap(blob, shape, [&](Triangle triangle) {
        ++answers.overlaps;
        answers.fingerprint.add(triangle.index);
        return --left == 0 ? stop : keep_going;
    }));
    std::uint32_t first = 0;
    for (int pages = 0; pages < 3; ++pages) {
        const OverlapPage answer = collect_overlaps(blob, shape, page, first);
        answers.fingerprint.add(static_cast<std::uint32_t>(answer.status));
        answers.fingerprint.add(answer.next);
        for (std::uint32_t i = 0; i < answer.count; ++i) answers.fingerprint.add(page[i].index);
        first = answer.next;
    }
}

inline void ask_volumes(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    for (std::uint32_t number = 0; number < count; ++number) {
        ask_volume(blob, questions.sphere(number), answers);
        ask_volume(blob, questions.capsule(number), answers);
        ask_volume(blob, questions.box(number), answers);
        ask_volume(blob, questions.oriented_box(number), answers);
        ask_volume(blob, questions.corners(number), answers);
        Plane planes[6];
        const std::span<Plane> some = std::span<Plane>(planes).first(1 + number % 6);
        questions.planes(number, some);
        ask_volume(blob, std::span<const Plane>(some), answers);
    }
}

inline void ask_in_steps(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    const Lattice lattice = lattice_of(blob);
    for (std::uint32_t number = 0; number < count; ++number) {
        ask_volume(blob, questions.box_in_steps(number), answers);
        const SegmentInSteps segment = questions.segment_in_steps(number);
        HitInSteps hit;
        bool any = false;
        answers.calls += 4;
        answers.fingerprint.add(static_cast<std::uint32_t>(first_hit(blob, segment, hit)));
        answers.fingerprint.add(hit.t);
        answers.fingerprint.add(static_cast<std::uint32_t>(hit.side));
        add_triangle(answers.fingerprint, blob, hit.triangle);
        answers.fingerprint.add(static_cast<std::uint32_t>(any_hit(blob, segment, any)));
        answers.fingerprint.add(any);
        Steps nearest;
        answers.fingerprint.add(static_cast<std::uint32_t>(to_steps(lattice, questions.point(number), nearest)));
        answers.fingerprint.add(to_world(lattice, nearest));
        BoxInSteps around;
        answers.fingerprint.add(static_cast<std::uint32_t>(steps_around(lattice, questions.box(number), around)));
        answers.fingerprint.add(static_cast<std::uint32_t>(around.min.x));
        answers.fingerprint.add(static_cast<std::uint32_t>(around.max.z));
    }
}

inline void ask_approximately(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const float accuracy = questions.distance(number + 1) * 0.0625f;
        DistanceBounds bounds;
        answers.calls += 4;
        answers.fingerprint.add(may_overlap(blob, questions.sphere(number), accuracy));
        answers.fingerprint.add(may_overlap(blob, questions.box(number), accuracy));
        answers.fingerprint.add(may_be_occluded(blob, questions.ray(number), accuracy));
        const Vec3 point = questions.point(number);
        answers.fingerprint.add(distance_bounds(blob, point, questions.distance(number), accuracy, bounds));
        answers.fingerprint.add(bounds.lower);
        answers.fingerprint.add(bounds.upper);
    }
}

inline void ask_closest_points(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Vec3 point = questions.point(number);
        const float max_distance = questions.distance(number);
        Nearest nearest;
        const bool found = closest_point(blob, point, max_distance, nearest);
        ++answers.points;
        answers.calls += 5;
        answers.points_found += found ? 1u : 0u;
        answers.fingerprint.add(found);
        add_nearest(answers.fingerprint, blob, nearest);
        Nearest few[4];
        const std::size_t places = closest_triangles(blob, point, max_distance, few);
        answers.fingerprint.add(static_cast<std::uint32_t>(places));
        for (std::size_t i = 0; i < places; ++i) add_nearest(answers.fingerprint, blob, few[i]);
        bool inside = false;
        answers.fingerprint.add(static_cast<std::uint32_t>(contains(blob, point, inside)));
        answers.fingerprint.add(inside);
        answers.fingerprint.add(static_cast<std::uint32_t>(signed_distance(blob, point, max_distance, nearest)));
        answers.fingerprint.add(nearest.distance);
        const Result<float> moved = rounding_error(blob, Sphere{point, max_distance});
        answers.fingerprint.add(static_cast<std::uint32_t>(moved.status));
        answers.fingerprint.add(moved.value);
    }
}

inline void add_pair(Fingerprint& fingerprint, QueryStatus status, const NearestPair& pair) {
    fingerprint.add(static_cast<std::uint32_t>(status));
    fingerprint.add(pair.on_shape);
    fingerprint.add(pair.on_surface);
    fingerprint.add(pair.distance);
    fingerprint.add(pair.u);
    fingerprint.add(pair.v);
    fingerprint.add(pair.triangle.index);
}

inline void ask_closest_pairs(const Blob& blob, Questions& questions, std::uint32_t count, Answers& answers) {
    for (std::uint32_t number = 0; number < count; ++number) {
        const Capsule capsule = questions.capsule(number);
        const float max_distance = questions.distance(number);
        NearestPair pair;
        answers.calls += 2;
        const QueryStatus segment = closest_to_segment(blob, {capsule.from, capsule.to}, max_distance, pair);
        add_pair(answers.fingerprint, segment, pair);
        const QueryStatus box = closest_to_box(blob, questions.box(number), max_distance, pair);
        add_pair(answers.fingerprint, box, pair);
    }
}

/// What `open` tells about the blob, and every triangle in it.
inline void read_all(const Blob& blob, Answers& answers) {
    answers.fingerprint.add(blob.triangle_count());
    answers.fingerprint.add(blob.vertex_count());
    answers.fingerprint.add(blob.size_bytes());
    answers.fingerprint.add(blob.checksum());
    answers.fingerprint.add(std::uint32_t{blob.depth()});
    answers.fingerprint.add(std::uint32_t{blob.bits()});
    answers.fingerprint.add(blob.step());
    answers.fingerprint.add(blob.max_error());
    answers.fingerprint.add(blob.bounds_min());
    answers.fingerprint.add(blob.bounds_max());
    answers.fingerprint.add(blob.closed());
    for_each_triangle(blob, [&](Triangle triangle, const Corners& corners) {
        add_triangle(answers.fingerprint, blob, triangle);
        answers.fingerprint.add(corners.a);
        answers.fingerprint.add(corners.b);
        answers.fingerprint.add(corners.c);
        return keep_going;
    });
}

inline Answers ask_everything(const Blob& blob, std::uint32_t questions_of_a_kind) {
    Answers answers;
    Questions questions(blob);
    read_all(blob, answers);
    read_extras(blob, answers.fingerprint);
    ask_closest_hits(blob, questions, 2 * questions_of_a_kind, answers);
    ask_filtered_hits(blob, questions, questions_of_a_kind, answers);
    ask_all_hits(blob, questions, questions_of_a_kind, answers);
    ask_first_hits(blob, questions, (questions_of_a_kind + 3) / 4, answers);
    ask_batches(blob, questions, (questions_of_a_kind + 15) / 16, answers);
    ask_rounded_rays(blob, questions, questions_of_a_kind, answers);
    ask_sweeps(blob, questions, (questions_of_a_kind + 3) / 4, answers);
    ask_spheres(blob, questions, questions_of_a_kind, answers);
    ask_volumes(blob, questions, (questions_of_a_kind + 3) / 4, answers);
    ask_approximately(blob, questions, (questions_of_a_kind + 3) / 4, answers);
    ask_closest_points(blob, questions, questions_of_a_kind, answers);
    ask_closest_pairs(blob, questions, (questions_of_a_kind + 3) / 4, answers);
    ask_pairs(blob, blob, questions, (questions_of_a_kind + 3) / 4, answers);
    ask_in_steps(blob, questions, (questions_of_a_kind + 3) / 4, answers);
    return answers;
}

}  // namespace espalier::platform
