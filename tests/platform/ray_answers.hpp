// Asks a blob about rays: one at a time, filtered, listed, the first few, and in batches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "answer_counts.hpp"
#include "questions.hpp"

namespace espalier::platform {

/// A result that holds nothing, as it entered when golden.txt was recorded.
inline constexpr RayHit untouched_hit = [] {
    RayHit hit;
    hit.t = 0.0f;
    hit.triangle = {0};
    return hit;
}();

inline void add_hit(Fingerprint& fingerprint, const Blob& blob, const RayHit& hit) {
    fingerprint.add(hit.t, hit.u, hit.v, hit.normal);
    add_triangle(fingerprint, blob, hit.triangle);
    const OriginalHit original = original_hit(blob, hit);
    fingerprint.add(original.triangle, original.u, original.v);
    fingerprint.add(lookup_word(original.status));
}

inline constexpr auto ask_closest_hits = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const RayHit hit = raycast(blob, questions.ray(number));
    ++answers.rays;
    ++answers.calls;
    answers.rays_hit += hit ? 1u : 0u;
    answers.fingerprint.add(bool(hit));
    add_hit(answers.fingerprint, blob, hit ? hit : untouched_hit);
});

inline constexpr auto ask_filtered_hits = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const auto odd = [](TriangleId triangle) { return (triangle.index & 1u) != 0; };
    const Ray ray = questions.ray(number);
    const RayHit hit = raycast(blob, ray, odd);
    ++answers.rays;
    answers.calls += 3;
    answers.fingerprint.add(bool(hit));
    add_hit(answers.fingerprint, blob, hit ? hit : untouched_hit);
    answers.fingerprint.add(occluded(blob, ray).yes());
    answers.fingerprint.add(occluded(blob, ray, odd).yes());
});

inline constexpr auto ask_all_hits = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    std::uint32_t left = 6;  // so that stopping early is asked for too
    const QueryStatus status = for_each_hit(blob, questions.ray(number), [&](const RayHit& hit) {
        ++answers.hits;
        add_hit(answers.fingerprint, blob, hit);
        return --left == 0 ? Visit::stop : Visit::next;
    });
    ++answers.rays;
    ++answers.calls;
    answers.fingerprint.add(status != QueryStatus::stopped);
});

inline constexpr auto ask_first_hits = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Ray ray = questions.ray(number);
    RayHit hits[3];
    const Filled found = closest_hits(blob, ray, std::span<RayHit>(hits).first(number % 4));
    ++answers.rays;
    answers.calls += 3;
    answers.fingerprint.add(static_cast<std::uint32_t>(found.count));
    const bool was_answered = !is_refused(found.status);
    answers.fingerprint.add(was_answered ? found.status : QueryStatus::ok);
    for (std::size_t i = 0; i < found.count; ++i) add_hit(answers.fingerprint, blob, hits[i]);
    const Ray segment = Ray::between(ray.origin, ray.direction);
    const RayHit hit = raycast(blob, segment);
    answers.fingerprint.add(bool(hit));
    add_hit(answers.fingerprint, blob, hit ? hit : untouched_hit);
    answers.fingerprint.add(occluded(blob, segment).yes());
});

/// Rounded for a region that is larger than the blob, by a power of two on each axis.
inline constexpr auto ask_rounded_rays = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Result<Lattice> found = lattice_of(std::span<const Blob>(&blob, 1));
    Lattice region = *found;
    const std::uint32_t room = (1u << 24) - 1u;
    const std::uint32_t margin = 1u << (number % 24);
    for (std::int32_t& extent : region.extent) {
        const std::uint32_t larger = static_cast<std::uint32_t>(extent) + margin;
        extent = static_cast<std::int32_t>(larger < room ? larger : room);
    }
    const RoundedRay rounded = round_ray(region, questions.ray(number));
    const RayHit hit = raycast(blob, rounded);
    const YesNo any = occluded(blob, rounded);
    ++answers.rays;
    answers.calls += 3;
    answers.fingerprint.add(found.status, rounded.status(), hit.status);
    add_hit(answers.fingerprint, blob, is_refused(hit.status) ? untouched_hit : hit);
    answers.fingerprint.add(any.status(), any.yes());
});

/// Batches of 0 to 24 rays: of one kind of direction, as a camera has them, and of every kind at once.
inline constexpr auto ask_batches = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    constexpr std::uint32_t capacity = 24;
    Ray rays[capacity];
    RayHit hits[capacity];
    YesNo yes[capacity];
    const std::uint32_t size = number * 5 % (capacity + 1);
    const Ray first = questions.ray(number);
    for (std::uint32_t i = 0; i < size; ++i) {
        rays[i] = number % 3 == 0 ? questions.ray(i) : first;
        const float turn = static_cast<float>(i) * 0x1p-7f;
        if (number % 3 == 1) rays[i].direction.x += turn * first.direction.y;
        if (number % 3 == 2) rays[i].origin.z += turn * first.direction.z;
    }
    const auto asked = std::span<const Ray>(rays).first(size);
    const Filled closest = raycast(blob, asked, std::span<RayHit>(hits).first(size));
    std::uint32_t found = 0;
    for (const RayHit& hit : closest.in(hits)) found += hit ? 1u : 0u;
    answers.fingerprint.add(found);
    for (std::uint32_t i = 0; i < size; ++i) add_hit(answers.fingerprint, blob, hits[i]);
    const Filled any = occluded(blob, asked, std::span<YesNo>(yes).first(size));
    found = 0;
    for (const YesNo answer : any.in(yes)) found += answer.yes() ? 1u : 0u;
    answers.fingerprint.add(found);
    for (std::uint32_t i = 0; i < size; ++i) answers.fingerprint.add(std::uint32_t{yes[i].yes()});
    answers.rays += 2 * size;
    answers.calls += 2;
});

}  // namespace espalier::platform
