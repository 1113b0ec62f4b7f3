// Volumes against the surface.
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

#include "kinds.hpp"

namespace espalier::tools {

namespace {

/// One page from --from on, of at most --limit triangles; without a limit page after page to the end.
template <class Shape>
Answer list_overlaps(const QueryCall& call, const Shape& shape) {
    const Blob& blob = call.blob();
    std::vector<Triangle> places(4096);
    std::size_t left = call.options().limit.value_or(blob.triangle_count());
    OverlapPage page;
    page.next = call.options().from;
    Answer answer(call);
    do {
        page = collect_overlaps(blob, shape, std::span(places).first(std::min(left, places.size())), page.next);
        for (std::uint32_t i = 0; i < page.count; ++i) {
            answer.list.emplace_back(call.options().json).triangle(blob, places[i]);
        }
        left -= page.count;
    } while (page.status == QueryStatus::output_full && left > 0);
    answer.status = page.status;
    return answer.counted_list("triangles", "triangle", &page.next);
}

/// Whether any triangle overlaps, and why that is not known where it is not.
template <class Shape>
Answer any_overlap(const QueryCall& call, const Shape& shape) {
    const QueryStatus said = collect_overlaps(call.blob(), shape, {}).status;
    const bool refused = said == QueryStatus::invalid_argument || said == QueryStatus::out_of_range;
    return Answer(call, refused ? said : QueryStatus::ok)
        .yes_or_no("overlaps", overlaps(call.blob(), shape), "overlaps", "does not overlap");
}

template <class Shape>
Answer overlap(const QueryCall& call, const Shape& shape) {
    if constexpr (std::is_same_v<Shape, Sphere> || std::is_same_v<Shape, Box>) {
        if (call.options().bounds_only) {
            return Answer(call).yes_or_no("outside_bounds", is_outside_bounds(call.blob(), shape),
                                          "outside of the bounds", "not outside of the bounds");
        }
        if (!call.options().accuracy.empty()) {
            QueryCounters counters;
            const float accuracy = length_argument(call.options().accuracy, "--accuracy");
            Answer answer(call);
            answer.yes_or_no("may_overlap", may_overlap(call.blob(), shape, accuracy, &counters), "may overlap",
                             "does not overlap");
            return answer.work(counters);
        }
    }
    return call.options().any ? any_overlap(call, shape) : list_overlaps(call, shape);
}

Answer ask_sphere(QueryCall& call) {
    Sphere sphere;
    sphere.center = call.next_vector();
    sphere.radius = call.next_number();
    return overlap(call, sphere);
}

Answer ask_capsule(QueryCall& call) {
    Capsule capsule;
    capsule.from = call.next_vector();
    capsule.to = call.next_vector();
    capsule.radius = call.next_number();
    return overlap(call, capsule);
}

Answer ask_box(QueryCall& call) {
    Box box;
    box.min = call.next_vector();
    box.max = call.next_vector();
    return overlap(call, box);
}

Answer ask_box_in_steps(QueryCall& call) {
    BoxInSteps box;
    box.min = call.next_steps();
    box.max = call.next_steps();
    return overlap(call, box);
}

Answer ask_oriented_box(QueryCall& call) {
    OrientedBox box;
    box.center = call.next_vector();
    for (Vec3& half_axis : box.half_axes) half_axis = call.next_vector();
    return overlap(call, box);
}

Answer ask_triangle(QueryCall& call) {
    Corners corners;
    corners.a = call.next_vector();
    corners.b = call.next_vector();
    corners.c = call.next_vector();
    return overlap(call, corners);
}

Answer ask_planes(QueryCall& call) {
    std::vector<Plane> planes;
    while (call.has_numbers()) {
        Plane& plane = planes.emplace_back();
        plane.normal = call.next_vector();
        plane.offset = call.next_number();
    }
    return overlap(call, std::span<const Plane>(planes));
}

}  // namespace

QueryKinds overlap_kinds() {
    constexpr const char* family = "Volumes that overlap triangles";
    constexpr unsigned options = option_any | option_limit | option_from;
    constexpr unsigned more_options = options | option_accuracy | option_bounds_only;
    return {
        {family,
         "sphere",
         "Which triangles a sphere touches",
         {point_word("center"), length_word("radius")},
         more_options,
         ask_sphere},
        {family,
         "capsule",
         "Which triangles are within a radius of a segment",
         {point_word("from"), point_word("to"), length_word("radius")},
         options,
         ask_capsule},
        {family,
         "box",
         "Which triangles an axis-aligned box touches",
         {point_word("min"), point_word("max")},
         more_options,
         ask_box},
        {family,
         "box-in-steps",
         "Which triangles a box touches that is given in whole lattice steps",
         {steps_word("min"), steps_word("max")},
         options,
         ask_box_in_steps},
        {family,
         "oriented-box",
         "Which triangles a box of any orientation touches; half axes lead from center to faces",
         {point_word("center"), point_word("half axis"), point_word("half axis"), point_word("half axis")},
         options,
         ask_oriented_box},
        {family,
         "triangle",
         "Which triangles a triangle touches",
         {point_word("a"), point_word("b"), point_word("c")},
         options,
         ask_triangle},
        {family,
         "planes",
         "Which triangles reach into all half-spaces dot(normal, x) <= offset",
         {vector_word("normal"), length_word("offset")},
         options,
         ask_planes,
         true},
    };
}

}  // namespace espalier::tools
