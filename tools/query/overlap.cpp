// Volumes against the surface.
#include <algorithm>
#include <span>
#include <type_traits>

#include "kinds.hpp"

namespace espalier::tools {

namespace {

/// One page from --from on, of at most --limit triangles; without a limit page after page to the end.
template <class Shape>
Answer list_overlaps(const QueryCall& call, const Shape& shape) {
    const Blob& blob = call.blob();
    std::vector<TriangleId> places(4096);
    std::size_t left = call.options().limit.value_or(blob.triangle_count());
    Filled page;
    page.next = {{call.options().from}};
    Answer answer(call);
    do {
        page = collect_overlaps(blob, shape, std::span(places).first(std::min(left, places.size())), page.next);
        for (const TriangleId triangle : page.in(places)) answer.add().triangle(blob, triangle);
        left -= page.count;
    } while (page.status == QueryStatus::output_full && left > 0);
    answer.status = page.status;
    return answer.counted_list("triangles", "triangle", &page.next.place[0]);
}

Answer any_overlap(const QueryCall& call, YesNo any) {
    return Answer(call, refusal(any.status())).yes_or_no("overlaps", any.yes(), "overlaps", "does not overlap");
}

template <SceneShape Shape>
Answer overlap_in_scene(const QueryCall& call, const BakedScene& scene, const Shape& shape) {
    if (call.options().any) return any_overlap(call, overlaps(scene, shape, call.mask()));
    Answer answer(call);
    const auto visit = [&](InstanceId instance, TriangleId triangle) {
        if (answer.is_full(call)) return Visit::stop;
        answer.add().triangle(scene, instance, triangle);
        return Visit::next;
    };
    answer.status = for_each_overlap(scene, shape, visit, call.mask());
    return answer.counted_list("triangles", "triangle");
}

template <class Shape>
Answer overlap(const QueryCall& call, const Shape& shape) {
    if constexpr (SceneShape<Shape>) {
        if (const BakedScene* scene = call.scene()) return overlap_in_scene(call, *scene, shape);
    }
    if constexpr (std::is_same_v<Shape, Sphere> || std::is_same_v<Shape, Box>) {
        if (!call.options().accuracy.empty()) {
            QueryCounters counters;
            const float accuracy = length_argument(call.options().accuracy, "--accuracy");
            const YesNo any = overlaps(call.blob(), shape, Accuracy{accuracy}, &counters);
            Answer answer(call, refusal(any.status()));
            answer.yes_or_no("may_overlap", any.yes(), "may overlap", "does not overlap");
            return answer.work(counters);
        }
    }
    return call.options().any ? any_overlap(call, overlaps(call.blob(), shape)) : list_overlaps(call, shape);
}

template <class Shape>
Answer overlap_answer(QueryCall& call) {
    return overlap(call, call.next<Shape>());
}

Answer convex_volume_answer(QueryCall& call) {
    const auto planes = call.rest<Plane>();
    return overlap(call, ConvexVolume{planes});
}

}  // namespace

QueryKinds overlap_kinds() {
    constexpr QueryFamily family{"Volumes that overlap triangles"};
    constexpr unsigned options = option_any | option_limit | option_from;
    constexpr unsigned more_options = options | option_accuracy;
    constexpr unsigned scene_options = option_any | option_limit | option_mask;
    return {
        family("sphere", "Which triangles a sphere touches", {point_word("center"), length_word("radius", Range::size)},
               more_options, overlap_answer<Sphere>, scene_options),
        family("capsule", "Which triangles are within a radius of a segment",
               {point_word("from"), point_word("to"), length_word("radius", Range::size)}, options,
               overlap_answer<Capsule>, scene_options),
        family("box", "Which triangles an axis-aligned box touches",
               {point_word("min", Range::number), point_word("max", Range::number)}, more_options, overlap_answer<Box>,
               scene_options),
        family("lattice-box", "Which triangles a box touches that is given in whole lattice steps",
               {steps_word("min"), steps_word("max")}, options, overlap_answer<LatticeBox>),
        family("oriented-box", "Which triangles a box of any orientation touches; half axes lead from center to faces",
               {point_word("center"), way_word("half axis"), way_word("half axis"), way_word("half axis")}, options,
               overlap_answer<OrientedBox>, scene_options),
        family("cone", "Which triangles a cone touches; the axis leads from the apex to the middle of the base",
               {point_word("apex"), way_word("axis", Range::direction), length_word("radius", Range::finite_size)},
               options, overlap_answer<Cone>, scene_options),
        family("triangle", "Which triangles a triangle touches", {point_word("a"), point_word("b"), point_word("c")},
               options, overlap_answer<Triangle>, scene_options),
        family("convex-volume", "Which triangles reach into all half-spaces dot(normal, x) <= offset",
               {vector_word("normal"), offset_word("offset", Range::number)}, options, convex_volume_answer, {},
               {Repeats::Which::all, max_planes}),
    };
}

}  // namespace espalier::tools
