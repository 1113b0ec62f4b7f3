// Queries of one blob.
#include <utility>

#include "questions.hpp"
#include "words.hpp"

namespace espalier::answers {

namespace {

constexpr auto keep = [](TriangleId triangle) { return triangle.index % 3 != 1; };

void answer_rays(const Blob& blob, const Questions& questions, std::size_t i) {
    RayHit hits[3];
    constexpr std::pair<const char*, FaceCulling> sides[] = {
        {"_none", FaceCulling::none}, {"_back", FaceCulling::back}, {"_front", FaceCulling::front}};
    for (const auto& [name, culling] : sides) {
        const std::string side = name;
        const Ray ray = questions.ray(i, culling);
        const RayHit hit = raycast(blob, ray);
        words["raycast" + side].add(hit);
        words["occluded" + side].add(occluded(blob, ray).status());
        words["original_hits" + side].add(original_hit(blob, hit));
        add_filled("closest_hits" + side, closest_hits(blob, ray, hits), hits);
        Words &all = words["all_hits" + side], &crossings = words["crossings" + side];
        all.add(for_each_hit(blob, ray, [&](const RayHit& each) { all.add(each); }));
        crossings.add(for_each_crossing(blob, ray, [&](const RayHit& each) { crossings.add(each); }));
    }
    const Ray filtered = questions.ray(i, FaceCulling::front);
    words["filtered_raycast"].add(raycast(blob, filtered, keep));
    words["filtered_occluded"].add(occluded(blob, filtered, keep).status());
    add_filled("filtered_closest_hits", closest_hits(blob, filtered, hits, keep), hits);
}

void answer_points(const Blob& blob, const Questions& questions, std::size_t i) {
    const Vec3 point = questions.origins[i];
    words["closest_point"].add(closest_point(blob, point, 2.5f));
    words["signed_distance"].add(signed_distance(blob, point, 2.5f));
    words["contains"].add(contains(blob, point).status());
    ClosestPoint nearest[3];
    add_filled("closest_triangles", closest_triangles(blob, point, nearest, 2.5f), nearest);
    words["winding_number"].add(winding_number(blob, point, 7));
    words["closest_to_segments"].add(closest_point(blob, Segment{point, questions.directions[i]}, 1.5f));
    words["closest_to_boxes"].add(closest_point(blob, questions.box(i), 1.5f));
}

void answer_shapes(const Blob& blob, const Questions& questions, std::size_t i) {
    const auto answer_volume = [&](const char* name, const auto& volume) {
        Words& touching = words[name];
        touching.add(overlaps(blob, volume).status());
        touching.add(
            for_each_overlap(blob, volume, [&](TriangleId triangle, const Triangle&) { touching.add(triangle); }));
    };
    questions.for_each_volume(i, answer_volume);
    answer_volume("convex_volume", questions.volume(i));
    const auto answer_contacts = [&](const char* name, const auto& body) {
        Contact contacts[5];
        add_filled(name, find_contacts(blob, body, questions.limits[i], contacts), contacts);
    };
    answer_contacts("contacts_sphere", questions.sphere(i));
    answer_contacts("contacts_capsule", questions.capsule(i));
    answer_contacts("contacts_oriented_box", questions.oriented_box(i));
    answer_contacts("contacts_convex_hull", questions.hull(i));
    ContactPlane planes[5];
    add_filled("planes", collect_planes(blob, questions.capsule(i), questions.limits[i], planes), planes);
    questions.for_each_body(i, [&](const std::string& name, const auto& body) {
        SweepOptions options = {.culling = FaceCulling::back, .ignore_leaving = true, .skin = 0.01f};
        words[name].add(sweep(blob, body, questions.directions[i], options));
        options = {.filter = keep, .skin = 0.01f};
        words["filtered_" + name].add(sweep(blob, body, questions.directions[i], options));
    });
}

}  // namespace

void answer_blob(const Blob& blob, const Questions& questions) {
    for (std::size_t i = 0; i < questions.count(); ++i) {
        answer_rays(blob, questions, i);
        answer_points(blob, questions, i);
        answer_shapes(blob, questions, i);
    }
}

}  // namespace espalier::answers
