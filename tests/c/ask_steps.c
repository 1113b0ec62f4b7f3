#include "asking.h"

static void tell_steps(struct asking* asking, espalier_lattice_point steps) {
    tell(asking, (uint32_t)steps.x);
    tell(asking, (uint32_t)steps.y);
    tell(asking, (uint32_t)steps.z);
}

static void ask_segment(struct asking* asking, const espalier_lattice_segment* segment) {
    const espalier_lattice_hit hit = espalier_raycast_lattice_segment(asking->blob, segment);
    tell(asking, hit.t);
    tell(asking, hit.triangle);
    tell(asking, hit.status);
    tell(asking, hit.side);
    tell(asking, espalier_occluded_lattice_segment(asking->blob, segment).status);
}

void ask_steps(struct asking* asking) {
    const struct question* question = asking->question;
    const espalier_lattice lattice = espalier_blob_lattice(asking->blob);
    const espalier_lattice_point_result from = espalier_to_lattice_point(&lattice, &question->points[2]);
    const espalier_lattice_point_result to = espalier_to_lattice_point(&lattice, &question->points[3]);
    espalier_box world;
    espalier_lattice_box_result box;
    espalier_lattice_segment segment;
    tell_point(asking, lattice.origin);
    tell(asking, (uint32_t)lattice.step_exponent);
    for (int i = 0; i < 3; ++i) tell(asking, (uint32_t)lattice.extent[i]);
    world.min = question->points[0];
    world.max = question->points[1];
    box = espalier_to_lattice_box(&lattice, &world);
    tell(asking, box.status);
    tell_steps(asking, box.value.min);
    tell_steps(asking, box.value.max);
    tell(asking, from.status);
    tell(asking, to.status);
    segment.from = from.value;
    segment.to = to.value;
    tell_steps(asking, segment.from);
    tell_steps(asking, segment.to);
    tell_point(asking, espalier_to_local(&lattice, &segment.to));
    ask_segment(asking, &segment);
    memcpy(&segment, question->directions, sizeof segment); /* any bits */
    ask_segment(asking, &segment);
}
