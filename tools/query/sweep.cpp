// Shapes that move along a straight line.
#include <vector>

#include "base/choices.hpp"
#include "kinds.hpp"

namespace espalier::tools {

namespace {

/// Answers with a hit, in the instance if the query is of a scene.
Answer hit_answer(const QueryCall& call, const SweepHit& hit, InstanceId instance = no_instance) {
    Answer answer(call);
    if (is_refused(hit.status)) {
        answer.status = hit.status;
        return answer;
    }
    answer.record.title("no contact").add_silently("hit", bool(hit));
    if (!hit) return answer;
    if (const BakedScene* scene = call.scene()) answer.record.triangle(*scene, instance, hit.triangle, "touches ");
    else answer.record.triangle(call.blob(), hit.triangle, "touches ");
    answer.record.add("t", hit.t).add("point", hit.point);
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
    const Vec3 displacement = call.next<Vec3>();
    std::vector<Vec3> vertices;
    while (call.has_numbers()) vertices.push_back(call.next<Vec3>());
    return sweep_answer(call, ConvexHull{vertices}, displacement);
}

}  // namespace

QueryKinds sweep_kinds() {
    constexpr QueryFamily family{"Sweeps; t is the part of the displacement until contact"};
    constexpr unsigned options = option_culling | option_sweep, in_scene = options | option_mask;
    return {
        family("sweep-sphere", "What a moving sphere touches first",
               {point_word("center"), length_word("radius", Range::finite_size), point_word("displacement")}, options,
               shape_sweep_answer<Sphere>, in_scene),
        family("sweep-capsule", "What a moving capsule touches first",
               {point_word("from"), point_word("to"), length_word("radius", Range::finite_size),
                point_word("displacement")},
               options, shape_sweep_answer<Capsule>, in_scene),
        family("sweep-box", "What a moving axis-aligned box touches first",
               {point_word("min"), point_word("max"), point_word("displacement")}, options, shape_sweep_answer<Box>,
               in_scene),
        family("sweep-oriented-box",
               "What a moving box of any orientation touches first; half axes lead from center to faces",
               {point_word("center"), point_word("half axis"), point_word("half axis"), point_word("half axis"),
                point_word("displacement")},
               options, shape_sweep_answer<OrientedBox>, in_scene),
        family("sweep-hull", "What a moving convex hull touches first: its displacement, then each vertex",
               {point_word("displacement"), point_word("vertex")}, options, hull_answer, in_scene,
               {Repeats::Which::last, max_hull_vertices}),
    };
}

}  // namespace espalier::tools
