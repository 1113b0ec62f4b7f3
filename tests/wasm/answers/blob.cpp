// Queries of one blob.
#include "questions.hpp"
#include "words.hpp"

#include <espalier/contact.hpp>

namespace {

void answer_rays(const espalier::Blob& blob, const Questions& questions) {
    Words closest("raycast");
    Words any("occluded");
    Words first("closest_hits");
    Words all("all_hits");
    Words crossings("crossings");
    Words originals("original_hits");
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        const espalier::Ray ray = questions.ray(i);
        const espalier::RayHit hit = espalier::raycast(blob, ray);
        add(closest, hit);
        any.add(espalier::occluded(blob, ray).status());
        const espalier::OriginalHit original = espalier::original_hit(blob, hit);
        originals.add(original.file, original.mesh, original.triangle, original.u, original.v, original.status);
        espalier::RayHit hits[3];
        const espalier::Filled filled = espalier::closest_hits(blob, ray, hits);
        first.add(filled.count, filled.status);
        for (std::size_t k = 0; k < filled.count; ++k) add(first, hits[k]);
        all.add(espalier::for_each_hit(blob, ray, [&](const espalier::RayHit& each) { add(all, each); }));
        crossings.add(
            espalier::for_each_crossing(blob, ray, [&](const espalier::RayHit& each) { add(crossings, each); }));
    }
}

void answer_points(const espalier::Blob& blob, const Questions& questions) {
    Words closest("closest_point");
    Words signed_distances("signed_distance");
    Words inside("contains");
    Words several("closest_triangles");
    Words windings("winding_number");
    for (const espalier::Vec3& point : questions.origins) {
        add(closest, espalier::closest_point(blob, point, 2.5f));
        add(signed_distances, espalier::signed_distance(blob, point, 2.5f));
        inside.add(espalier::contains(blob, point).status());
        espalier::ClosestPoint nearest[3];
        const espalier::Filled filled = espalier::closest_triangles(blob, point, nearest, 2.5f);
        several.add(filled.count, filled.status);
        for (std::size_t k = 0; k < filled.count; ++k) add(several, nearest[k]);
        const auto winding = espalier::winding_number(blob, point, 7);
        windings.add(winding.value, winding.status);
    }
}

template <class Shape>
void answer_volume(const espalier::Blob& blob, Words& words, const Shape& shape) {
    words.add(espalier::overlaps(blob, shape).status());
    words.add(espalier::for_each_overlap(
        blob, shape, [&](espalier::TriangleId triangle, const espalier::Triangle&) { words.add(triangle); }));
}

template <class Body>
void answer_contacts(const espalier::Blob& blob, Words& words, const Body& body, float margin) {
    espalier::Contact contacts[5];
    const espalier::Filled filled = espalier::find_contacts(blob, body, margin, contacts);
    words.add(filled.count, filled.status);
    for (std::size_t k = 0; k < filled.count; ++k) add(words, contacts[k]);
}

template <class Shape>
void answer_sweep(const espalier::Blob& blob, Words& words, const Shape& shape, const espalier::Vec3& displacement) {
    espalier::SweepOptions options;
    options.culling = espalier::FaceCulling::back;
    options.ignore_leaving = true;
    options.skin = 0.01f;
    add(words, espalier::sweep(blob, shape, displacement, options));
}

void answer_shapes(const espalier::Blob& blob, const Questions& questions) {
    Words segments("closest_to_segments");
    Words boxes("closest_to_boxes");
    Words touching[] = {Words("sphere"), Words("capsule"),  Words("box"),          Words("oriented_box"),
                        Words("cone"),   Words("triangle"), Words("convex_volume")};
    Words contacts[] = {Words("contacts_sphere"), Words("contacts_capsule"), Words("contacts_oriented_box"),
                        Words("contacts_convex_hull")};
    Words sweeps[] = {Words("sweep_sphere"), Words("sweep_capsule"), Words("sweep_box"), Words("sweep_oriented_box"),
                      Words("sweep_convex_hull")};
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        const auto [sphere, capsule, box, oriented_box, cone, triangle] = questions.shapes(i);
        const espalier::Vec3 displacement = questions.directions[i];
        add(segments, espalier::closest_point(blob, espalier::Segment{capsule.from, capsule.to}, 1.5f));
        add(boxes, espalier::closest_point(blob, box, 1.5f));
        answer_volume(blob, touching[0], sphere);
        answer_volume(blob, touching[1], capsule);
        answer_volume(blob, touching[2], box);
        answer_volume(blob, touching[3], oriented_box);
        answer_volume(blob, touching[4], cone);
        answer_volume(blob, touching[5], triangle);
        answer_volume(blob, touching[6], questions.volume(i));
        answer_contacts(blob, contacts[0], sphere, questions.limits[i]);
        answer_contacts(blob, contacts[1], capsule, questions.limits[i]);
        answer_contacts(blob, contacts[2], oriented_box, questions.limits[i]);
        answer_contacts(blob, contacts[3], questions.hull(i), questions.limits[i]);
        answer_sweep(blob, sweeps[0], sphere, displacement);
        answer_sweep(blob, sweeps[1], capsule, displacement);
        answer_sweep(blob, sweeps[2], box, displacement);
        answer_sweep(blob, sweeps[3], oriented_box, displacement);
        answer_sweep(blob, sweeps[4], questions.hull(i), displacement);
    }
}

}  // namespace

void answer_blob(const espalier::Blob& blob, const Questions& questions) {
    answer_rays(blob, questions);
    answer_points(blob, questions);
    answer_shapes(blob, questions);
}
