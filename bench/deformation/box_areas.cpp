// How tight boxes stay over the tree at rest: those along the axes, and oriented ones. The area of all boxes over that
// of those in a tree that was built for the pose.
#include <cstdio>

#include "box_tree.hpp"
#include "subject.hpp"

namespace espalier::bench {
namespace {

struct Areas {
    double aabb = 0.0, obb = 0.0;
};

Areas areas_of(const BoxTreeShape& shape, const std::vector<Vec3>& positions) {
    std::vector<Aabb> aabbs(shape.nodes.size());
    std::vector<Obb> obbs(shape.nodes.size());
    refit_aabbs(shape, positions, aabbs);
    fit_obbs(shape, positions, obbs);
    return {total_half_area(aabbs), total_half_area(obbs)};
}

void print(const Subject& subject, const char* motion, const char* boxes, double refitted, double built,
           double built_aabb) {
    JsonObject row = subject.row("boxes");
    row.add("motion", std::string(motion));
    row.add("boxes", std::string(boxes));
    row.add("times_built", built > 0.0 ? std::optional(refitted / built) : std::nullopt, 3);
    row.add("times_built_aabb", built_aabb > 0.0 ? std::optional(refitted / built_aabb) : std::nullopt, 3);
    row.print();
}

void measure(const Subject& subject, const BoxTreeShape& at_rest, const char* motion,
             const std::vector<Vec3>& positions) {
    const Areas refitted = areas_of(at_rest, positions);
    const Areas built = areas_of(build_box_tree(subject.rest().triangles, positions), positions);
    print(subject, motion, "aabb", refitted.aabb, built.aabb, built.aabb);
    print(subject, motion, "obb anew", refitted.obb, built.obb, built.aabb);
}

}  // namespace

void measure_boxes(const Subject& subject) {
    const BoxTreeShape at_rest = build_box_tree(subject.rest().triangles, subject.rest().positions);
    measure(subject, at_rest, "rest", subject.rest().positions);
    for (const Motion motion : deforming)
        measure(subject, at_rest, name_of(motion), subject.moving().positions(motion, 1.0));
    measure(subject, at_rest, name_of(Motion::turn), subject.moving().positions(Motion::turn, 1.0));
    std::fflush(stdout);
}

}  // namespace espalier::bench
