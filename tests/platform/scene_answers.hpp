// Asks a scene what it can be asked, and hashes every bit that comes back. The questions are those of its meshes, moved
// to the places of instances.
#pragma once

#include <cstdint>
#include <iterator>
#include <span>

#include <espalier/scene.hpp>

#include "answer_counts.hpp"
#include "questions.hpp"

namespace espalier::platform {

/// Questions in world space, about one of the instances.
class SceneQuestions {
public:
    SceneQuestions(const Blob& mesh, const Transform& transform) : local_(mesh), transform_(transform) {}

    Ray ray(std::uint32_t number) {
        Ray ray = local_.ray(number);
        const Vec3 end = to_world(transform_, {ray.origin.x + ray.direction.x, ray.origin.y + ray.direction.y,
                                               ray.origin.z + ray.direction.z});
        ray.origin = to_world(transform_, ray.origin);
        ray.direction = difference(end, ray.origin);
        return ray;
    }
    Sphere sphere(std::uint32_t number) {
        const Sphere local = local_.sphere(number);
        return {to_world(transform_, local.center), local.radius * transform_.scale};
    }
    Capsule capsule(std::uint32_t number) {
        const Capsule local = local_.capsule(number);
        return {to_world(transform_, local.from), to_world(transform_, local.to), local.radius * transform_.scale};
    }
    Box box(std::uint32_t number) {
        const Box local = local_.box(number);
        const Vec3 min = to_world(transform_, local.min), away = difference(local.max, local.min);
        return {min, {min.x + away.x, min.y + away.y, min.z + away.z}};
    }
    Triangle corners(std::uint32_t number) {
        const Triangle local = local_.corners(number);
        return {to_world(transform_, local.a), to_world(transform_, local.b), to_world(transform_, local.c)};
    }
    OrientedBox oriented_box(std::uint32_t number) {
        OrientedBox box = local_.oriented_box(number);
        box.center = to_world(transform_, box.center);
        return box;
    }
    Cone cone(std::uint32_t number) {
        const Ray axis = ray(number);
        return {axis.origin, axis.direction, static_cast<float>(number % 5) * 0.25f};
    }
    Vec3 point(std::uint32_t number) { return to_world(transform_, local_.point(number)); }
    float distance(std::uint32_t number) { return local_.distance(number); }
    Vec3 displacement(std::uint32_t number) { return local_.displacement(number); }

private:
    static Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

    Questions local_;
    Transform transform_;
};

/// Where an answer is. A refusal enters as its status alone.
template <class Hit>
void add_place(Fingerprint& fingerprint, const InScene<Hit>& hit) {
    fingerprint.add(bool(hit), hit->status, hit.instance.index, hit.instance.in_tile, hit->triangle.index);
}
inline void add_hit(Fingerprint& fingerprint, const InScene<RayHit>& hit) {
    add_place(fingerprint, hit);
    fingerprint.add(hit->t, hit->u, hit->v, hit->normal);
}
inline void add_hit(Fingerprint& fingerprint, const InScene<SweepHit>& hit) {
    add_place(fingerprint, hit);
    fingerprint.add(hit->t, hit->point, hit->normal, hit->face_normal, hit->starts_overlapping,
                    static_cast<std::uint32_t>(hit->feature));
}

inline void add_answer(Fingerprint& fingerprint, const YesNo& answer) {
    fingerprint.add(answer.yes(), answer.status());
}

inline void ask_rays(const BakedScene& scene, const Ray& ray, std::uint32_t mask, Answers& answers) {
    Fingerprint& fingerprint = answers.fingerprint;
    answers.calls += 5;
    const InScene<RayHit> hit = raycast(scene, ray);
    answers.rays += 1;
    answers.rays_hit += bool(hit);
    add_hit(fingerprint, hit);
    const auto odd = [](InstanceId instance, TriangleId triangle) {
        return (instance.index + triangle.index) % 3 != 0;
    };
    add_hit(fingerprint, raycast(scene, ray, {mask, odd}));
    add_answer(fingerprint, occluded(scene, ray, mask));
    if (const Result<Lattice> common = scene.common_lattice()) {
        const RoundedRay rounded = round_ray(*common, ray);
        add_hit(fingerprint, raycast(scene, ray, rounded));
        add_answer(fingerprint, occluded(scene, ray, rounded));
        answers.calls += 2;
    }
    const QueryStatus status = for_each_hit(scene, ray, [&](InstanceId instance, const RayHit& each) {
        answers.hits += 1;
        add_hit(fingerprint, InScene<RayHit>{each, instance});
        return Visit::next;
    });
    fingerprint.add(status);
}

template <class Shape>
void ask_overlaps(const BakedScene& scene, const Shape& shape, std::uint32_t mask, Answers& answers) {
    answers.calls += 2;
    add_answer(answers.fingerprint, overlaps(scene, shape, mask));
    std::uint32_t left = 100;
    const QueryStatus status = for_each_overlap(scene, shape, [&](InstanceId instance, TriangleId triangle) {
        answers.overlaps += 1;
        answers.fingerprint.add(instance.index, instance.in_tile, triangle.index);
        return --left == 0 ? Visit::stop : Visit::next;
    });
    answers.fingerprint.add(status);
}

template <class Shape>
void ask_sweep(const BakedScene& scene, const Shape& shape, const Vec3& way, std::uint32_t mask, Answers& answers) {
    answers.calls += 2;
    add_hit(answers.fingerprint, sweep(scene, shape, way, mask));
    SceneSweepOptions options;
    options.filter = mask;
    options.culling = FaceCulling::back;
    options.ignore_leaving = true;
    options.skin = 0.125f;
    add_hit(answers.fingerprint, sweep(scene, shape, way, options));
}

inline void ask_others(const BakedScene& scene, SceneQuestions& questions, std::uint32_t number, std::uint32_t mask,
                       Answers& answers) {
    Fingerprint& fingerprint = answers.fingerprint;
    answers.spheres += 1;
    ask_overlaps(scene, questions.sphere(number), mask, answers);
    ask_overlaps(scene, questions.capsule(number), mask, answers);
    ask_overlaps(scene, questions.box(number), mask, answers);
    ask_overlaps(scene, questions.oriented_box(number), mask, answers);
    ask_overlaps(scene, questions.corners(number), mask, answers);
    ask_overlaps(scene, questions.cone(number), mask, answers);
    const Vec3 point = questions.point(number);
    const InScene<ClosestPoint> nearest = closest_point(scene, point, questions.distance(number), mask);
    answers.points += 1;
    answers.points_found += bool(nearest);
    add_place(fingerprint, nearest);
    fingerprint.add(nearest->point, nearest->distance);
    const Sphere sphere = questions.sphere(number);
    const Vec3 way = questions.displacement(number);
    ask_sweep(scene, sphere, way, mask, answers);
    ask_sweep(scene, questions.capsule(number), way, mask, answers);
    ask_sweep(scene, questions.box(number), way, mask, answers);
    const OrientedBox turned = questions.oriented_box(number);
    ask_sweep(scene, turned, way, mask, answers);
    Vec3 vertices[12];
    fill_vertices_around(turned, vertices);
    ask_sweep(scene, ConvexHull{std::span<const Vec3>(vertices).first(1 + number % std::size(vertices))}, way, mask,
              answers);
    answers.calls += 2;
    const auto visit = [&](InstanceId instance) {
        fingerprint.add(instance.index, instance.in_tile);
        return Visit::next;
    };
    fingerprint.add(for_each_candidate(scene, questions.box(number), visit, mask));
}

inline Answers ask_scene(const BakedScene& scene, std::uint32_t questions_of_a_kind) {
    Answers answers;
    answers.fingerprint.add(scene.bounds().min, scene.bounds().max, scene.max_error(), scene.size());
    for (std::uint32_t index = 0; index < scene.instance_count(); ++index) {
        const Instance instance = *instance_at(scene, {index});
        answers.fingerprint.add(instance.mesh, instance.source, is_on_common_lattice(scene, {index}).yes());
        const Result<Blob> mesh = mesh_at(scene, {index});
        if (!mesh) continue;  // a tile
        SceneQuestions questions(*mesh, instance.transform);
        for (std::uint32_t number = index; number < questions_of_a_kind; number += scene.instance_count()) {
            const std::uint32_t mask = number % 4 == 3 ? 1u << number % 3 : 0xFFFFFFFFu;
            ask_rays(scene, questions.ray(number), mask, answers);
            if (number % 4 == 0) ask_others(scene, questions, number / 4, mask, answers);
        }
    }
    return answers;
}

}  // namespace espalier::platform
