// Queries of one blob that take some of its triangles into account.
#include "questions.hpp"
#include "words.hpp"

namespace {

constexpr auto keep = [](espalier::TriangleId triangle) { return triangle.index % 3 != 1; };

void answer_rays(const espalier::Blob& blob, const Questions& questions) {
    Words closest("filtered_raycast");
    Words any("filtered_occluded");
    Words first("filtered_closest_hits");
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        espalier::Ray ray = questions.ray(i);
        ray.culling = espalier::FaceCulling::front;
        add(closest, espalier::raycast(blob, ray, keep));
        any.add(espalier::occluded(blob, ray, keep).status());
        espalier::RayHit hits[3];
        const espalier::Filled filled = espalier::closest_hits(blob, ray, hits, keep);
        first.add(filled.count, filled.status);
        for (std::size_t k = 0; k < filled.count; ++k) add(first, hits[k]);
    }
}

void answer_sweeps(const espalier::Blob& blob, const Questions& questions) {
    Words sweeps[] = {Words("filtered_sweep_sphere"), Words("filtered_sweep_capsule"), Words("filtered_sweep_box"),
                      Words("filtered_sweep_oriented_box"), Words("filtered_sweep_convex_hull")};
    espalier::SweepOptions options;
    options.filter = keep;
    options.skin = 0.01f;
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        const Shapes shapes = questions.shapes(i);
        const espalier::Vec3 displacement = questions.directions[i];
        add(sweeps[0], espalier::sweep(blob, shapes.sphere, displacement, options));
        add(sweeps[1], espalier::sweep(blob, shapes.capsule, displacement, options));
        add(sweeps[2], espalier::sweep(blob, shapes.box, displacement, options));
        add(sweeps[3], espalier::sweep(blob, shapes.oriented_box, displacement, options));
        add(sweeps[4], espalier::sweep(blob, questions.hull(i), displacement, options));
    }
}

}  // namespace

void answer_filtered(const espalier::Blob& blob, const Questions& questions) {
    answer_rays(blob, questions);
    answer_sweeps(blob, questions);
}
