// Shapes that move along a straight line.
#include "kinds.hpp"

namespace espalier::tools {

namespace {

template <class Shape>
Answer sweep_answer(QueryCall& call, const Shape& shape) {
    const Vec3 displacement = call.next_vector();
    Answer answer(call, check_sweep(call.blob(), shape, displacement));
    if (answer.status != QueryStatus::ok) return answer;
    SweepHit hit;
    const bool found = sweep(call.blob(), shape, displacement, hit);
    answer.record.title("no contact").add_silently("hit", found);
    if (!found) return answer;
    answer.record.triangle(call.blob(), hit.triangle, "touches ").add("t", hit.t).add("point", hit.point);
    answer.record.add("normal", hit.normal).add("starts_overlapping", hit.starts_overlapping);
    return answer;
}

Answer ask_sphere(QueryCall& call) {
    Sphere sphere;
    sphere.center = call.next_vector();
    sphere.radius = call.next_number();
    return sweep_answer(call, sphere);
}

Answer ask_capsule(QueryCall& call) {
    Capsule capsule;
    capsule.from = call.next_vector();
    capsule.to = call.next_vector();
    capsule.radius = call.next_number();
    return sweep_answer(call, capsule);
}

Answer ask_box(QueryCall& call) {
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
         ask_sphere},
        {family,
         "sweep-capsule",
         "What a moving capsule touches first",
         {point_word("from"), point_word("to"), length_word("radius"), point_word("displacement")},
         0,
         ask_capsule},
        {family,
         "sweep-box",
         "What a moving axis-aligned box touches first",
         {point_word("min"), point_word("max"), point_word("displacement")},
         0,
         ask_box},
    };
}

}  // namespace espalier::tools
