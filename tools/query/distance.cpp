// How far things are from the surface, and on which side of it.
#include <algorithm>

#include "base/choices.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

float max_distance(const QueryCall& call) { return length_argument(call.options().max_distance, "--max-distance"); }

void add_nearest(Record& record, const Blob& blob, const Nearest& nearest) {
    record.triangle(blob, nearest.triangle, "nearest ");
    record.add("distance", nearest.distance).add("point", nearest.point);
    record.add("feature", name_in(feature_choices, nearest.feature)).add("u", nearest.u).add("v", nearest.v);
}

void say_nothing_found(Answer& answer) { answer.record.title("nothing within that distance"); }

Answer ask_nearest(QueryCall& call) {
    const Vec3 point = call.next_vector();
    const float limit = max_distance(call);
    Answer answer(call);
    if (!call.options().accuracy.empty()) {
        const float accuracy = length_argument(call.options().accuracy, "--accuracy");
        DistanceBounds bounds;
        QueryCounters counters;
        const bool found = distance_bounds(call.blob(), point, limit, accuracy, bounds, &counters);
        answer.record.add_silently("found", found);
        if (!found) say_nothing_found(answer);
        if (found) answer.record.title("distance").add("lower", bounds.lower).add("upper", bounds.upper);
        return answer.work(counters);
    }
    if (call.options().first) {
        std::vector<Nearest> places(std::min(*call.options().first, call.blob().triangle_count()));
        const std::size_t count = closest_triangles(call.blob(), point, limit, places);
        for (std::size_t i = 0; i < count; ++i) {
            add_nearest(answer.list.emplace_back(call.options().json), call.blob(), places[i]);
        }
        return answer.counted_list("triangles", "triangle");
    }
    Nearest nearest;
    const bool found = closest_point(call.blob(), point, limit, nearest);
    answer.record.add_silently("found", found);
    if (!found) say_nothing_found(answer);
    if (found) add_nearest(answer.record, call.blob(), nearest);
    return answer;
}

Answer pair_answer(const QueryCall& call, QueryStatus status, const NearestPair& pair) {
    Answer answer(call, status);
    if (status != QueryStatus::ok) return answer;
    const bool found = pair.triangle != no_triangle;
    answer.record.add_silently("found", found);
    if (!found) {
        say_nothing_found(answer);
        return answer;
    }
    answer.record.triangle(call.blob(), pair.triangle, "nearest ").add("distance", pair.distance);
    answer.record.add("on_shape", pair.on_shape).add("on_surface", pair.on_surface);
    answer.record.add("u", pair.u).add("v", pair.v);
    return answer;
}

Answer ask_nearest_segment(QueryCall& call) {
    Segment segment;
    segment.from = call.next_vector();
    segment.to = call.next_vector();
    NearestPair pair;
    const QueryStatus status = closest_to_segment(call.blob(), segment, max_distance(call), pair);
    return pair_answer(call, status, pair);
}

Answer ask_nearest_box(QueryCall& call) {
    Box box;
    box.min = call.next_vector();
    box.max = call.next_vector();
    NearestPair pair;
    const QueryStatus status = closest_to_box(call.blob(), box, max_distance(call), pair);
    return pair_answer(call, status, pair);
}

Answer ask_inside(QueryCall& call) {
    bool inside = false;
    Answer answer(call);
    answer.status = contains(call.blob(), call.next_vector(), inside);
    if (answer.status == QueryStatus::ok) answer.yes_or_no("inside", inside, "inside", "outside");
    return answer;
}

Answer ask_signed_distance(QueryCall& call) {
    Nearest nearest;
    Answer answer(call);
    answer.status = signed_distance(call.blob(), call.next_vector(), max_distance(call), nearest);
    if (answer.status != QueryStatus::ok) return answer;
    const bool found = nearest.triangle != no_triangle;
    answer.record.add_silently("found", found);
    if (found) {
        add_nearest(answer.record, call.blob(), nearest);
    } else {
        say_nothing_found(answer);
        answer.record.add("distance", nearest.distance);
    }
    return answer;
}

}  // namespace

QueryKinds distance_kinds() {
    constexpr const char* family = "Distances";
    return {
        {family,
         "nearest",
         "The point of the surface that is closest to a point",
         {point_word("point")},
         option_max_distance | option_first | option_accuracy,
         ask_nearest},
        {family,
         "nearest-segment",
         "The closest pair of points of a segment and the surface",
         {point_word("from"), point_word("to")},
         option_max_distance,
         ask_nearest_segment},
        {family,
         "nearest-box",
         "The closest pair of points of an axis-aligned box and the surface",
         {point_word("min"), point_word("max")},
         option_max_distance,
         ask_nearest_box},
        {family, "inside", "Whether a point is inside of a closed surface", {point_word("point")}, 0, ask_inside},
        {family,
         "signed-distance",
         "The distance of a point to a closed surface, negative inside",
         {point_word("point")},
         option_max_distance,
         ask_signed_distance},
    };
}

}  // namespace espalier::tools
