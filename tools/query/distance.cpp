// How far things are from the surface, and on which side of it.
#include <algorithm>

#include "base/choices.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

float max_distance(const QueryCall& call) { return length_argument(call.options().max_distance, "--max-distance"); }

/// Adds the keys of a closest point, as nulls.
void add_nearest_keys(Record& record, const QueryCall& call, bool has_shape) {
    record.no_triangle(call).add_nulls({"distance", "point"});
    if (has_shape) record.add_nulls({"on_shape"});
    record.add_nulls({"feature", "u", "v", "face_normal", "side"});
}

/// Adds a closest point, in the instance if the query is of a scene; of a segment or a box its own point too.
void add_nearest(Record& record, const QueryCall& call, const ClosestPoint& nearest, bool has_shape = false,
                 InstanceId instance = no_instance) {
    add_nearest_keys(record, call, has_shape);
    record.triangle(call, nearest.triangle, "nearest ", instance);
    record.add("distance", nearest.distance).add("point", call.in_source(nearest.point));
    if (has_shape) record.add("on_shape", call.in_source(nearest.on_shape));
    record.add("feature", name_in(feature_choices, nearest.feature)).add("u", nearest.u).add("v", nearest.v);
    record.add("face_normal", nearest.face_normal).add("side", nearest.side);
}

Answer nearest_answer(const QueryCall& call, const ClosestPoint& nearest, bool has_shape = false,
                      InstanceId instance = no_instance) {
    Answer answer(call, refusal(nearest.status));
    answer.record.title("nothing within that distance").add_silently("found", bool(nearest));
    if (nearest) add_nearest(answer.record, call, nearest, has_shape, instance);
    else add_nearest_keys(answer.record, call, has_shape);
    return answer;
}

Answer distance_bounds_answer(const QueryCall& call, Vec3 point, float limit) {
    const float accuracy = length_argument(call.options().accuracy, "--accuracy");
    QueryCounters counters;
    const Result<DistanceBounds> bounds = distance_bounds(call.blob(), point, limit, Accuracy{accuracy}, &counters);
    Answer answer(call, refusal(bounds.status));
    answer.record.title("nothing within that distance").add_silently("found", bool(bounds));
    if (bounds) answer.record.title("distance").add("lower", bounds->lower).add("upper", bounds->upper);
    else answer.record.add_nulls({"lower", "upper"});
    return answer.work(counters);
}

Answer closest_point_answer(QueryCall& call) {
    const Vec3 point = call.next<Vec3>();
    const float limit = max_distance(call);
    if (const BakedScene* scene = call.scene()) {
        const InScene<ClosestPoint> nearest = closest_point(*scene, point, limit, call.mask());
        return nearest_answer(call, *nearest, false, nearest.instance);
    }
    if (!call.options().accuracy.empty()) return distance_bounds_answer(call, point, limit);
    if (!call.options().first) return nearest_answer(call, closest_point(call.blob(), point, limit));
    std::vector<ClosestPoint> places(std::min(*call.options().first, call.blob().triangle_count()));
    const Filled filled = closest_triangles(call.blob(), point, places, limit);
    Answer answer(call, filled.status);
    for (const ClosestPoint& each : filled.in(places)) add_nearest(answer.add(), call, each);
    return answer.counted_list("triangles", "triangle");
}

/// Of a segment or a box.
template <class Shape>
Answer closest_point_shape_answer(QueryCall& call) {
    const auto shape = call.next<Shape>();
    return nearest_answer(call, closest_point(call.blob(), shape, max_distance(call)), true);
}

Answer contains_answer(QueryCall& call) {
    const YesNo inside = contains(call.blob(), call.next<Vec3>());
    return Answer(call, refusal(inside.status())).yes_or_no("inside", inside.yes(), "inside", "outside");
}

Answer winding_number_answer(QueryCall& call) {
    const auto point = call.next<Vec3>();
    const auto directions = call.next<std::uint32_t>();
    const Result<float> winding = winding_number(call.blob(), point, directions);
    Answer answer(call, winding.status);
    answer.record.add("winding", *winding);
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
               {point_word("from"), point_word("to")}, option_max_distance, closest_point_shape_answer<Segment>),
        family("closest-point-box", "The closest pair of points of an axis-aligned box and the surface",
               {point_word("min"), point_word("max")}, option_max_distance, closest_point_shape_answer<Box>),
        family("contains", "Whether a point is inside of a closed surface", {point_word("point")}, 0, contains_answer),
        family(
            "winding-number",
            "About how often a surface, open or not, winds around a point: inside above 0.5; 64 directions are usual",
            {point_word("point"), index_word("directions", "how many rays count; 64 are usual", Range::directions)}, 0,
            winding_number_answer),
        family("signed-distance", "The distance of a point to a closed surface, negative inside", {point_word("point")},
               option_max_distance, signed_distance_answer),
    };
}

}  // namespace espalier::tools
