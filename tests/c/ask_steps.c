#include "asking.h"

static void tell_steps(struct asking* asking, espalier_steps steps) {
    tell(asking, (uint32_t)steps.x);
    tell(asking, (uint32_t)steps.y);
    tell(asking, (uint32_t)steps.z);
}

static void ask_segment(struct asking* asking, const espalier_segment_in_steps* segment) {
    espalier_hit_in_steps hit = {11, 12, 13};
    bool any = false;
    tell(asking, espalier_first_hit(asking->blob, segment, &hit));
    tell(asking, hit.t);
    tell(asking, hit.side);
    tell(asking, hit.triangle);
    tell(asking, espalier_any_hit(asking->blob, segment, &any));
    tell(asking, any);
}

void ask_steps(struct asking* asking) {
    const struct question* question = asking->question;
    const espalier_lattice lattice = espalier_lattice_of(asking->blob);
    espalier_box world;
    espalier_box_in_steps box = {{1, 2, 3}, {4, 5, 6}};
    espalier_segment_in_steps segment = {{7, 8, 9}, {-1, -2, -3}};
    tell_point(asking, lattice.origin);
    tell(asking, (uint32_t)lattice.step_exponent);
    for (int i = 0; i < 3; ++i) tell(asking, (uint32_t)lattice.extent[i]);
    world.min = question->points[0];
    world.max = question->points[1];
    tell(asking, espalier_steps_around(&lattice, &world, &box));
    tell_steps(asking, box.min);
    tell_steps(asking, box.max);
    tell(asking, espalier_to_steps(&lattice, &question->points[2], &segment.from));
    tell(asking, espalier_to_steps(&lattice, &question->points[3], &segment.to));
    tell_steps(asking, segment.from);
    tell_steps(asking, segment.to);
    tell_point(asking, espalier_to_world(&lattice, &segment.to));
    ask_segment(asking, &segment);
    memcpy(&segment, question->directions, sizeof segment); /* any bits */
    ask_segment(asking, &segment);
}
