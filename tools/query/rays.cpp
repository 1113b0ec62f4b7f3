// Rays and segments.
#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

Vec3 point_at(const Ray& ray, float t) {
    const auto along = [t](float origin, float direction) {
        return static_cast<float>(static_cast<double>(origin) +
                                  static_cast<double>(t) * static_cast<double>(direction));
    };
    return {along(ray.origin.x, ray.direction.x), along(ray.origin.y, ray.direction.y),
            along(ray.origin.z, ray.direction.z)};
}

void add_hit(Record& record, const Blob& blob, const Ray& ray, const RayHit& hit) {
    record.triangle(blob, hit.triangle, "hit ");
    record.add("t", hit.t).add("point", point_at(ray, hit.t)).add("normal", hit.normal);
    record.add("u", hit.u).add("v", hit.v);
    if (const OriginalHit original = original_hit(blob, hit)) {
        record.add("original_u", original.u).add("original_v", original.v);
    }
}

Answer all_hits(const QueryCall& call, const Ray& ray) {
    Answer answer(call);
    if (call.blob().copy_count() != 0) answer.status = QueryStatus::has_copies;
    for_each_hit(call.blob(), ray, [&](const RayHit& hit) {
        add_hit(answer.list.emplace_back(call.options().json), call.blob(), ray, hit);
        return keep_going;
    });
    return answer.counted_list("hits", "hit");
}

Answer first_hits(const QueryCall& call, const Ray& ray, std::uint32_t places) {
    std::vector<RayHit> hits(std::min(places, call.blob().triangle_count()));
    const HitCount found = closest_hits(call.blob(), ray, hits);
    Answer answer(call, found.status);
    for (std::size_t i = 0; i < found.count; ++i) {
        add_hit(answer.list.emplace_back(call.options().json), call.blob(), ray, hits[i]);
    }
    return answer.counted_list("hits", "hit");
}

Answer cast(const QueryCall& call, Ray ray) {
    const QueryArguments& options = call.options();
    ray.faces = options.faces;
    if (options.all) return all_hits(call, ray);
    if (options.first) return first_hits(call, ray, *options.first);
    Answer answer(call);
    if (options.any) return answer.yes_or_no("occluded", occluded(call.blob(), ray), "occluded", "not occluded");
    if (!options.accuracy.empty()) {
        QueryCounters counters;
        const float accuracy = length_argument(options.accuracy, "--accuracy");
        answer.yes_or_no("may_be_occluded", may_be_occluded(call.blob(), ray, accuracy, &counters), "may be occluded",
                         "not occluded");
        return answer.work(counters);
    }
    RayHit hit;
    const bool found = raycast(call.blob(), ray, hit);
    answer.record.title("no hit").add_silently("hit", found);
    if (found) add_hit(answer.record, call.blob(), ray, hit);
    return answer;
}

Answer ask_ray(QueryCall& call) {
    Ray ray;
    ray.origin = call.next_vector();
    ray.direction = call.next_vector();
    ray.t_min = number_argument(call.options().t_min, "--t-min");
    ray.t_max = number_argument(call.options().t_max, "--t-max");
    return cast(call, ray);
}

Answer ask_segment(QueryCall& call) {
    Segment segment;
    segment.from = call.next_vector();
    segment.to = call.next_vector();
    return cast(call, along(segment));
}

Answer ask_segment_in_steps(QueryCall& call) {
    SegmentInSteps segment;
    segment.from = call.next_steps();
    segment.to = call.next_steps();
    if (call.options().any) {
        bool any = false;
        const QueryStatus status = any_hit(call.blob(), segment, any);
        return Answer(call, status).yes_or_no("occluded", any, "occluded", "not occluded");
    }
    HitInSteps hit;
    Answer answer(call, first_hit(call.blob(), segment, hit));
    const bool found = hit.triangle != no_triangle;
    answer.record.title("no hit").add_silently("hit", found);
    if (!found) return answer;
    answer.record.triangle(call.blob(), hit.triangle, "hit ");
    answer.record.add("t", std::ldexp(static_cast<float>(hit.t), -31)).add_count("t_fixed_point", hit.t);
    answer.record.add("side", std::string(hit.side == Faces::front ? "front" : "back"));
    return answer;
}

}  // namespace

QueryKinds ray_kinds() {
    constexpr unsigned options = option_faces | option_any | option_all | option_first | option_accuracy;
    return {
        {"Rays",
         "ray",
         "What a ray hits first; t counts in the direction's length",
         {point_word("origin"), vector_word("direction")},
         options | option_t_range,
         ask_ray},
        {"Rays",
         "segment",
         "What the way from one point to another hits first; t runs from 0 to 1",
         {point_word("from"), point_word("to")},
         options,
         ask_segment},
        {"Rays",
         "segment-in-steps",
         "The same between lattice points, given in whole steps; exact, and t is rounded down",
         {steps_word("from"), steps_word("to")},
         option_any,
         ask_segment_in_steps},
    };
}

}  // namespace espalier::tools
