#include "asking.h"

static void tell_hit(struct asking* asking, const espalier_ray_hit* hit) {
    tell_float(asking, hit->t);
    tell_float(asking, hit->u);
    tell_float(asking, hit->v);
    tell_point(asking, hit->normal);
    tell(asking, hit->triangle);
}

static void tell_original(struct asking* asking, espalier_original_hit original) {
    tell(asking, original.file);
    tell(asking, original.mesh);
    tell(asking, original.triangle);
    tell_float(asking, original.u);
    tell_float(asking, original.v);
    tell(asking, original.status);
}

static void ask_originals(struct asking* asking, const espalier_ray_hit* hits) {
    const uint32_t bits = asking->question->bits;
    const espalier_original_triangle remap[2] = {{bits, 1, 2, bits % 3u}, {3, 4, bits, bits % 5u}};
    espalier_original_hit originals[18];
    espalier_original_triangle triangles[18];
    espalier_triangle named[18];
    espalier_ray_hit turned = hits[0];
    for (int i = 0; i < 18; ++i) tell_original(asking, espalier_get_original_hit(asking->blob, &hits[i]));
    tell(asking, espalier_get_original_hit_batch(asking->blob, hits, originals, 18));
    for (int i = 0; i < 18; ++i) tell_original(asking, originals[i]);
    for (uint32_t i = 0; i < 4; ++i) {
        turned.triangle = i == 3 ? ESPALIER_NO_TRIANGLE : i;
        tell_original(asking, espalier_get_original_hit_by_remap(remap, 2, &turned));
    }
    memset(triangles, 0, sizeof triangles);
    for (int i = 0; i < 18; ++i) named[i] = hits[i].triangle;
    for (size_t count = 1; count <= 18; count += 17) {
        tell(asking, espalier_get_original_triangle_batch(asking->blob, named, triangles, count));
        for (size_t i = 0; i < count; ++i) {
            tell(asking, triangles[i].file);
            tell(asking, triangles[i].mesh);
            tell(asking, triangles[i].triangle);
            tell(asking, triangles[i].first_corner);
        }
    }
}

static espalier_visit visit_hit(const espalier_ray_hit* hit, void* user) {
    struct asking* asking = user;
    tell_hit(asking, hit);
    return asking->visits-- == 0 ? 17 : ESPALIER_KEEP_GOING; /* stops, as any value does that is not the other */
}

static void ask_one_ray(struct asking* asking, const espalier_ray* ray) {
    const espalier_blob* blob = asking->blob;
    espalier_ray_hit hit, hits[5];
    espalier_hit_count count;
    espalier_query_counters counters = {1, 2, 3, 4, 5};
    memset(&hit, 0, sizeof hit);
    tell(asking, espalier_raycast(blob, ray, &hit));
    tell_hit(asking, &hit);
    tell(asking, espalier_raycast_filtered(blob, ray, &hit, counts, asking));
    tell_hit(asking, &hit);
    tell(asking, espalier_occluded(blob, ray));
    tell(asking, espalier_occluded_filtered(blob, ray, counts, asking));
    memset(hits, 0, sizeof hits);
    count = espalier_closest_hits(blob, ray, hits, 5);
    tell(asking, (uint32_t)count.count);
    tell(asking, count.status);
    for (size_t i = 0; i < count.count; ++i) tell_hit(asking, &hits[i]);
    count = espalier_closest_hits_filtered(blob, ray, hits, 2, counts, asking);
    tell(asking, (uint32_t)count.count);
    tell(asking, count.status);
    for (size_t i = 0; i < count.count; ++i) tell_hit(asking, &hits[i]);
    asking->visits = asking->question->bits % 9u;
    tell(asking, espalier_for_each_hit(blob, ray, visit_hit, asking));
    tell(asking, espalier_raycast_counted(blob, ray, &hit, &counters));
    tell_hit(asking, &hit);
    tell(asking, (uint32_t)counters.nodes);
    tell(asking, (uint32_t)counters.leaves);
    tell(asking, (uint32_t)counters.groups);
    tell(asking, (uint32_t)counters.triangles);
    tell(asking, (uint32_t)counters.candidates);
}

static void ask_rounded_ray(struct asking* asking, const espalier_lattice* region, const espalier_ray* ray) {
    espalier_rounded_ray rounded;
    espalier_ray_hit hit;
    bool any = true;
    memset(&hit, 0, sizeof hit);
    tell(asking, espalier_round_ray(region, ray, &rounded));
    tell(asking, espalier_raycast_rounded(asking->blob, &rounded, &hit));
    tell_hit(asking, &hit);
    tell(asking, espalier_occluded_rounded(asking->blob, &rounded, &any));
    tell(asking, any);
}

void ask_rays(struct asking* asking) {
    const struct question* question = asking->question;
    espalier_segment segment;
    const espalier_blob blobs[2] = {*asking->blob, *asking->other};
    espalier_lattice region = espalier_lattice_of(asking->blob);
    espalier_ray rays[18];
    espalier_ray_hit hits[18];
    uint8_t answers[18];
    rays[0] = espalier_ray_from(question->points[0], question->directions[0]);
    rays[1] = rays[0];
    rays[1].t_min = question->lengths[0];
    rays[1].t_max = question->lengths[1];
    rays[1].faces = (espalier_faces)(question->bits % 4u); /* one value more than there are */
    segment.from = question->points[0];
    segment.to = question->points[1];
    rays[2] = espalier_along(&segment);
    for (int i = 0; i < 3; ++i) ask_one_ray(asking, &rays[i]);
    for (int i = 3; i < 18; ++i) { /* a group, and strangers */
        rays[i] = rays[i % 3];
        rays[i].origin = question->points[i % 4];
    }
    tell(asking, (uint32_t)espalier_raycast_batch(asking->blob, rays, hits, 18));
    for (int i = 0; i < 18; ++i) tell_hit(asking, &hits[i]);
    ask_originals(asking, hits);
    tell(asking, (uint32_t)espalier_occluded_batch(asking->blob, rays, answers, 18));
    for (int i = 0; i < 18; ++i) tell(asking, answers[i]);
    for (int i = 0; i < 3; ++i) ask_rounded_ray(asking, &region, &rays[i]);
    tell(asking, espalier_lattice_of_blobs(blobs, 2, &region));
    ask_rounded_ray(asking, &region, &rays[0]);
}
