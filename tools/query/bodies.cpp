// Bodies that touch the surface, and shapes that move along a straight line.
#include <cmath>
#include <vector>

#include "base/choices.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

/// Lists all contacts, or the few that support the body best.
template <class Shape>
Answer contacts_answer(QueryCall& call, const Shape& shape, float margin) {
    std::vector<Contact> contacts(64);
    Filled found = find_contacts(call.blob(), shape, margin, contacts);
    while (found.status == QueryStatus::output_full) {
        contacts.resize(2 * contacts.size());
        found = find_contacts(call.blob(), shape, margin, contacts);
    }
    Answer answer(call, found.status);
    if (is_refused(found.status)) return answer;
    contacts.resize(call.options().few ? reduce_contacts(found.in(contacts)) : found.count);
    for (const Contact& contact : contacts) {
        Record& record = answer.add().triangle(call.blob(), contact.triangle, "contact ");
        record.add("distance", contact.distance).add("point", call.in_source(contact.point));
        record.add("normal", contact.normal);
        record.add("feature", name_in(feature_choices, contact.feature)).add("side", contact.side);
    }
    return answer.counted_list("touches", "touch");
}

template <class Shape>
Answer shape_contacts_answer(QueryCall& call) {
    const auto shape = call.next<Shape>();
    return contacts_answer(call, shape, call.next<float>());
}

Answer contacts_hull_answer(QueryCall& call) {
    const auto vertices = call.rest<Vec3>();
    const float margin = length_argument(call.options().max_distance, "--max-distance");
    return contacts_answer(call, ConvexHull{vertices}, std::isinf(margin) ? 0.0f : margin);
}

/// Answers with a hit, in the instance if the query is of a scene.
Answer hit_answer(const QueryCall& call, const SweepHit& hit, InstanceId instance = no_instance) {
    Answer answer(call, refusal(hit.status));
    answer.record.title("no contact").add_silently("hit", bool(hit));
    if (!hit) {
        answer.record.no_triangle(call);
        answer.record.add_nulls({"t", "point", "normal", "face_normal", "feature", "starts_overlapping"});
        return answer;
    }
    answer.record.triangle(call, hit.triangle, "touches ", instance).add("t", hit.t);
    answer.record.add("point", call.in_source(hit.point));
    answer.record.add("normal", hit.normal).add("face_normal", hit.face_normal);
    answer.record.add("feature", name_in(feature_choices, hit.feature));
    answer.record.add("starts_overlapping", hit.starts_overlapping);
    return answer;
}

/// Returns the options of the command line as those of a blob or of a scene.
template <class Options>
Options sweep_options(const QueryCall& call) {
    Options options;
    options.culling = call.options().culling;
    options.ignore_leaving = call.options().ignore_leaving;
    options.skin = length_argument(call.options().skin, "--skin");
    return options;
}

template <class Shape>
Answer sweep_answer(QueryCall& call, const Shape& shape, const Vec3& displacement) {
    if (const BakedScene* scene = call.scene()) {
        auto options = sweep_options<SceneSweepOptions>(call);
        options.filter = call.mask();
        const InScene<SweepHit> found = sweep(*scene, shape, displacement, options);
        return hit_answer(call, *found, found.instance);
    }
    return hit_answer(call, sweep(call.blob(), shape, displacement, sweep_options<SweepOptions>(call)));
}

template <class Shape>
Answer shape_sweep_answer(QueryCall& call) {
    const auto shape = call.next<Shape>();
    return sweep_answer(call, shape, call.next<Vec3>());
}

Answer hull_answer(QueryCall& call) {
    const auto displacement = call.next<Vec3>();
    const auto vertices = call.rest<Vec3>();
    return sweep_answer(call, ConvexHull{vertices}, displacement);
}

}  // namespace

QueryKinds contact_kinds() {
    constexpr QueryFamily family{"Contacts: places, directions and depths, within a margin"};
    return {
        family("contacts-sphere", "Where a sphere touches the surface or is near it",
               {point_word("center"), length_word("radius", Range::finite_size),
                length_word("margin", Range::finite_size)},
               option_few, shape_contacts_answer<Sphere>),
        family("contacts-capsule", "Where a capsule touches the surface or is near it",
               {point_word("from"), point_word("to"), length_word("radius", Range::finite_size),
                length_word("margin", Range::finite_size)},
               option_few, shape_contacts_answer<Capsule>),
        family("contacts-oriented-box", "Where a box of any orientation touches the surface or is near it",
               {point_word("center"), way_word("half_axis_a"), way_word("half_axis_b"), way_word("half_axis_c"),
                length_word("margin", Range::finite_size)},
               option_few, shape_contacts_answer<OrientedBox>),
        family(
            "contacts-hull",
            "Where a convex hull of vertices touches the surface, or is within --max-distance of it (0 if not given)",
            {point_word("vertex")}, option_few | option_max_distance, contacts_hull_answer, {},
            {Repeats::Which::all, max_hull_vertices}),
    };
}

QueryKinds sweep_kinds() {
    constexpr QueryFamily family{"Sweeps; t is the part of the displacement until contact"};
    constexpr unsigned options = option_culling | option_sweep, in_scene = options | option_mask;
    return {
        family("sweep-sphere", "What a moving sphere touches first",
               {point_word("center"), length_word("radius", Range::finite_size), way_word("displacement")}, options,
               shape_sweep_answer<Sphere>, in_scene),
        family(
            "sweep-capsule", "What a moving capsule touches first",
            {point_word("from"), point_word("to"), length_word("radius", Range::finite_size), way_word("displacement")},
            options, shape_sweep_answer<Capsule>, in_scene),
        family("sweep-box", "What a moving axis-aligned box touches first",
               {point_word("min"), point_word("max"), way_word("displacement")}, options, shape_sweep_answer<Box>,
               in_scene),
        family("sweep-oriented-box",
               "What a moving box of any orientation touches first; half axes lead from center to faces",
               {point_word("center"), way_word("half axis"), way_word("half axis"), way_word("half axis"),
                way_word("displacement")},
               options, shape_sweep_answer<OrientedBox>, in_scene),
        family("sweep-hull", "What a moving convex hull touches first: its displacement, then each vertex",
               {way_word("displacement"), point_word("vertex")}, options, hull_answer, in_scene,
               {Repeats::Which::last, max_hull_vertices}),
    };
}

}  // namespace espalier::tools
