// Rays and segments.
#include <algorithm>
#include <cmath>

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

/// Adds the keys of a hit, as nulls.
void add_hit_keys(Record& record, const QueryCall& call) {
    record.no_triangle(call).add_nulls({"t", "point", "normal", "side", "u", "v"});
    if (call.has_mesh(&Blob::has_original_ids)) record.add_nulls({"original_u", "original_v"});
}

/// Adds a hit, in the instance if the query is of a scene.
void add_hit(Record& record, const QueryCall& call, const Ray& ray, const RayHit& hit,
             InstanceId instance = no_instance) {
    add_hit_keys(record, call);
    record.triangle(call, hit.triangle, "hit ", instance).add("t", hit.t);
    record.add("point", call.in_source(point_at(ray, hit.t)));
    record.add("normal", hit.normal).add("side", hit.side).add("u", hit.u).add("v", hit.v);
    if (const OriginalHit original = original_hit(call.mesh_of(instance), hit)) {
        record.add("original_u", original.u).add("original_v", original.v);
    }
}

/// Lists all hits, or the crossings among them.
Answer all_hits(const QueryCall& call, const Ray& ray) {
    Answer answer(call);
    const auto add = [&](const RayHit& hit) { add_hit(answer.add(), call, ray, hit); };
    const auto add_in_scene = [&](InstanceId id, const RayHit& hit) { add_hit(answer.add(), call, ray, hit, id); };
    if (call.options().crossings) {
        answer.status = for_each_crossing(call.blob(), ray, add);
        return answer.counted_list("crossings", "crossing");
    }
    const BakedScene* scene = call.scene();
    answer.status =
        scene == nullptr ? for_each_hit(call.blob(), ray, add) : for_each_hit(*scene, ray, add_in_scene, call.mask());
    return answer.counted_list("hits", "hit");
}

Answer first_hits(const QueryCall& call, const Ray& ray, std::uint32_t places) {
    std::vector<RayHit> hits(std::min(places, call.blob().triangle_count()));
    const Filled found = closest_hits(call.blob(), ray, hits);
    Answer answer(call, found.status);
    for (const RayHit& hit : found.in(hits)) add_hit(answer.add(), call, ray, hit);
    return answer.counted_list("hits", "hit");
}

/// Begins the answer with the first hit.
template <class Hit>
Answer first_hit(const QueryCall& call, const Hit& hit) {
    Answer answer(call, complete(hit.status));
    answer.record.title("no hit").add_silently("hit", bool(hit));
    return answer;
}

Answer is_occluded(const QueryCall& call, YesNo occluded) {
    return Answer(call, complete(occluded.status())).yes_or_no("occluded", occluded.yes(), "occluded", "not occluded");
}

Answer cast(const QueryCall& call, Ray ray) {
    const QueryArguments& options = call.options();
    const BakedScene* scene = call.scene();
    ray.culling = options.culling;
    if (options.any && scene != nullptr) return is_occluded(call, occluded(*scene, ray, call.mask()));
    if (options.all || options.crossings) return all_hits(call, ray);
    if (options.first) return first_hits(call, ray, *options.first);
    if (options.any) return is_occluded(call, occluded(call.blob(), ray));
    if (!options.accuracy.empty()) {
        QueryCounters counters;
        const Accuracy accuracy = {length_argument(options.accuracy, "--accuracy")};
        const YesNo may_be = occluded(call.blob(), ray, accuracy, &counters);
        Answer answer(call, complete(may_be.status()));
        return answer.yes_or_no("may_be_occluded", may_be.yes(), "may be occluded", "not occluded").work(counters);
    }
    const auto found =
        scene == nullptr ? InScene<RayHit>{raycast(call.blob(), ray), no_instance} : raycast(*scene, ray, call.mask());
    Answer answer = first_hit(call, *found);
    if (*found) add_hit(answer.record, call, ray, *found, found.instance);
    else add_hit_keys(answer.record, call);
    return answer;
}

Answer ray_answer(QueryCall& call) {
    Ray ray;
    ray.origin = call.next<Vec3>();
    ray.direction = call.next<Vec3>();
    ray.t_min = number_argument(call.options().t_min, "--t-min");
    ray.t_max = number_argument(call.options().t_max, "--t-max");
    return cast(call, ray);
}

Answer segment_answer(QueryCall& call) {
    const auto [from, to] = call.next<Segment>();
    return cast(call, Ray::between(from, to));
}

Answer lattice_segment_answer(QueryCall& call) {
    const auto segment = call.next<LatticeSegment>();
    if (call.options().any) return is_occluded(call, occluded(call.blob(), segment));
    const LatticeHit hit = raycast(call.blob(), segment);
    Answer answer = first_hit(call, hit);
    if (!hit) {
        answer.record.no_triangle(call).add_nulls({"t", "t_fixed_point", "side"});
        return answer;
    }
    answer.record.triangle(call.blob(), hit.triangle, "hit ");
    answer.record.add("t", std::ldexp(static_cast<float>(hit.t), -31)).add_count("t_fixed_point", hit.t);
    answer.record.add("side", hit.side);
    return answer;
}

}  // namespace

QueryKinds ray_kinds() {
    constexpr QueryFamily family{"Rays"};
    constexpr unsigned options =
        option_culling | option_any | option_all | option_crossings | option_first | option_accuracy;
    constexpr unsigned scene_options = option_culling | option_any | option_all | option_mask;
    return {
        family("ray", "What a ray hits first; t counts in the direction's length",
               {point_word("origin"), vector_word("direction")}, options | option_t_range, ray_answer, scene_options),
        family("segment", "What the way from one point to another hits first; t runs from 0 to 1",
               {point_word("from"), point_word("to", Range::apart)}, options, segment_answer, scene_options),
        family("lattice-segment", "The same between lattice points, given in whole steps; exact, and t is rounded down",
               {steps_word("from"), steps_word("to", Range::apart)}, option_any, lattice_segment_answer),
    };
}

}  // namespace espalier::tools
