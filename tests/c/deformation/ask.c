#include "c/asking.h"

static void tell_refit(struct asking* asking, espalier_refit_result result) {
    tell(asking, result.status);
    tell(asking, result.position);
    tell_float(asking, result.quality);
}

static void tell_mesh(struct asking* asking) {
    const espalier_deformable* mesh = asking->refit->mesh;
    const espalier_box range = espalier_deformable_range(mesh);
    const espalier_box bounds = espalier_blob_bounds(espalier_deformable_blob(mesh));
    tell(asking, espalier_deformable_status(mesh));
    tell(asking, espalier_deformable_position_count(mesh));
    tell(asking, (uint32_t)espalier_deformable_bytes(espalier_deformable_blob(mesh)));
    tell_point(asking, range.min);
    tell_point(asking, range.max);
    tell_point(asking, bounds.min);
    tell_point(asking, bounds.max);
}

void ask_refits(struct asking* asking) {
    const struct asked_refit* refit = asking->refit;
    const size_t fewer = refit->count == 0 ? 0 : asking->question->bits % refit->count;
    unsigned char byte = 0;
    tell_mesh(asking);
    tell_refit(asking, espalier_deformable_refit(refit->mesh, NULL, 0));
    tell_refit(asking, espalier_deformable_refit(refit->mesh, refit->positions, fewer));
    tell_refit(asking, espalier_deformable_refit(refit->mesh, refit->positions, refit->count));
    tell_mesh(asking);
    tell(asking, espalier_deformable_seal(refit->mesh, NULL, 0));
    tell(asking, espalier_deformable_seal(refit->mesh, &byte, 1));
    tell(asking, byte);
}
