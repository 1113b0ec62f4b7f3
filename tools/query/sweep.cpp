// Shapes that move along a straight line.
#include <type_traits>

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
    answer.record.add("starts_overlapping", hit.starts_overlapping);
    return answer;
}

template <class Shape>
Answer sweep_answer(QueryCall& call, const Shape& shape) {
    const Vec3 displacement = call.next_vector();
    if constexpr (!std::is_same_v<Shape, Box>) {
        if (const BakedScene* scene = call.scene()) {
            const InScene<SweepHit> found = sweep(*scene, shape, displacement, call.mask());
            return hit_answer(call, *found, found.instance);
        }
    }
    return hit_answer(call, sweep(call.blob(), shape, displacement));
}

Answer sphere_answer(QueryCall& call) {
    Sphere sphere;
    sphere.center = call.next_vector();
    sphere.radius = call.next_number();
    return sweep_answer(call, sphere);
}

Answer capsule_answer(QueryCall& call) {
    Capsule capsule;
    capsule.from = call.next_vector();
    capsule.to = call.next_vector();
    capsule.radius = call.next_number();
    return sweep_answer(call, capsule);
}

Answer box_answer(QueryCall& call) {
    Box box;
    box.min = call.next_vector();
    box.max = call.next_vector();
    return sweep_answer(call, box);
}

}  // namespace

QueryKinds sweep_kinds() {
    constexpr const char* family = "Sweeps; t is the part of the displacement until contact";
    return {
        {family,
         "sweep-sphere",
         "What a moving sphere touches first",
         {point_word("center"), length_word("radius"), point_word("displacement")},
         0,
         sphere_answer,
         false,
         option_mask},
        {family,
         "sweep-capsule",
         "What a moving capsule touches first",
         {point_word("from"), point_word("to"), length_word("radius"), point_word("displacement")},
         0,
         capsule_answer,
         false,
         option_mask},
        {family,
         "sweep-box",
         "What a moving axis-aligned box touches first",
         {point_word("min"), point_word("max"), point_word("displacement")},
         0,
         box_answer},
    };
}

}  // namespace espalier::tools
