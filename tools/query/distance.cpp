// How far things are from the surface, and on which side of it.
#include <algorithm>

#include "base/choices.hpp"
#include "base/numbers.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

float max_distance(const QueryCall& call) { return length_argument(call.options().max_distance, "--max-distance"); }

/// Adds the values of a closest point; of a segment or a box its own point too.
void add_closest_values(Record& record, const ClosestPoint& nearest, bool has_shape) {
    record.add("distance", nearest.distance).add("point", nearest.point);
    if (has_shape) record.add("on_shape", nearest.on_shape);
    record.add("feature", name_in(feature_choices, nearest.feature)).add("u", nearest.u).add("v", nearest.v);
    record.add("face_normal", nearest.face_normal)
        .add("side", std::string(nearest.side == Side::front ? "front" : "back"));
}

void add_nearest(Record& record, const Blob& blob, const ClosestPoint& nearest, bool has_shape = false) {
    add_closest_values(record.triangle(blob, nearest.triangle, "nearest "), nearest, has_shape);
}

Answer nearest_in_scene(const QueryCall& call, const BakedScene& scene, Vec3 point) {
    const InScene<ClosestPoint> nearest = closest_point(scene, point, max_distance(call), call.mask());
    Answer answer(call);
    if (is_refused(nearest->status)) {
        answer.status = nearest->status;
        return answer;
    }
    answer.record.title("nothing within that distance").add_silently("found", bool(nearest));
    if (nearest)
        add_closest_values(answer.record.triangle(scene, nearest.instance, nearest->triangle, "nearest "), *nearest,
                           false);
    return answer;
}

Answer nearest_answer(const QueryCall& call, const ClosestPoint& nearest, bool has_shape = false) {
    Answer answer(call);
    if (is_refused(nearest.status)) {
        answer.status = nearest.status;
        return answer;
    }
    answer.record.add_silently("found", bool(nearest));
    if (nearest) add_nearest(answer.record, call.blob(), nearest, has_shape);
    else answer.record.title("nothing within that distance");
    return answer;
}

Answer distance_bounds_answer(const QueryCall& call, Vec3 point, float limit) {
    const float accuracy = length_argument(call.options().accuracy, "--accuracy");
    Answer answer(call);
    QueryCounters counters;
    const Result<DistanceBounds> bounds = distance_bounds(call.blob(), point, limit, Accuracy{accuracy}, &counters);
    if (is_refused(bounds.status)) {
        answer.status = bounds.status;
        return answer;
    }
    answer.record.add_silently("found", bool(bounds));
    if (bounds) answer.record.title("distance").add("lower", bounds->lower).add("upper", bounds->upper);
    else answer.record.title("nothing within that distance");
    return answer.work(counters);
}

Answer closest_point_answer(QueryCall& call) {
    const Vec3 point = call.next<Vec3>();
    if (const BakedScene* scene = call.scene()) return nearest_in_scene(call, *scene, point);
    const float limit = max_distance(call);
    if (!call.options().accuracy.empty()) return distance_bounds_answer(call, point, limit);
    if (!call.options().first) return nearest_answer(call, closest_point(call.blob(), point, limit));
    Answer answer(call);
    std::vector<ClosestPoint> places(std::min(*call.options().first, call.blob().triangle_count()));
    const Filled filled = closest_triangles(call.blob(), point, places, limit);
    answer.status = filled.status;
    if (is_refused(filled.status)) return answer;
    for (const ClosestPoint& each : filled.in(places))
        add_nearest(answer.list.emplace_back(call.options().json), call.blob(), each);
    return answer.counted_list("triangles", "triangle");
}

Answer closest_point_segment_answer(QueryCall& call) {
    Segment segment;
    segment.from = call.next<Vec3>();
    segment.to = call.next<Vec3>();
    return nearest_answer(call, closest_point(call.blob(), segment, max_distance(call)), true);
}

Answer closest_point_box_answer(QueryCall& call) {
    const auto box = call.next<Box>();
    return nearest_answer(call, closest_point(call.blob(), box, max_distance(call)), true);
}

Answer contains_answer(QueryCall& call) {
    Answer answer(call);
    const YesNo inside = contains(call.blob(), call.next<Vec3>());
    if (is_refused(inside.status())) answer.status = inside.status();
    else answer.yes_or_no("inside", inside.yes(), "inside", "outside");
    return answer;
}

Answer winding_number_answer(QueryCall& call) {
    const Vec3 point = call.next<Vec3>();
    const std::uint32_t directions = call.next_index();
    if (directions < 2 || directions > max_winding_directions)
        throw CommandError(ExitCode::usage,
                           text("directions is ", directions, "; it must be from 2 to ", max_winding_directions));
    Answer answer(call);
    const Result<float> winding = winding_number(call.blob(), point, directions);
    if (winding.status != QueryStatus::ok) answer.status = winding.status;
    else answer.record.add("winding", *winding);
    return answer;
}

Answer signed_distance_answer(QueryCall& call) {
    const ClosestPoint nearest = signed_distance(call.blob(), call.next<Vec3>(), max_distance(call));
    Answer answer = nearest_answer(call, nearest);
    if (nearest.status == QueryStatus::not_found) answer.record.add("distance", nearest.distance);
    return answer;
}

}  // namespace

QueryKinds distance_kinds() {
    constexpr QueryFamily family{"Distances"};
    return {
        family("closest-point", "The point of the surface that is closest to a point", {point_word("point")},
               option_max_distance | option_first | option_accuracy, closest_point_answer,
               option_max_distance | option_mask),
        family("closest-point-segment", "The closest pair of points of a segment and the surface",
               {point_word("from"), point_word("to")}, option_max_distance, closest_point_segment_answer),
        family("closest-point-box", "The closest pair of points of an axis-aligned box and the surface",
               {point_word("min"), point_word("max")}, option_max_distance, closest_point_box_answer),
        family("contains", "Whether a point is inside of a closed surface", {point_word("point")}, 0, contains_answer),
        family(
            "winding-number",
            "About how often a surface, open or not, winds around a point: inside above 0.5; 64 directions are usual",
            {point_word("point"), index_word("directions")}, 0, winding_number_answer),
        family("signed-distance", "The distance of a point to a closed surface, negative inside", {point_word("point")},
               option_max_distance, signed_distance_answer),
    };
}

}  // namespace espalier::tools
