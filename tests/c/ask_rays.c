#include "asking.h"

static void tell_result(struct asking* asking, espalier_ray_hit hit) { tell_ray_hit(asking, &hit); }

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
    espalier_original_triangle_result triangles[18];
    espalier_triangle_id named[18];
    espalier_ray_hit turned = hits[0];
    for (int i = 0; i < 18; ++i) tell_original(asking, espalier_original_hit_of(asking->blob, &hits[i]));
    tell_filled(asking, espalier_original_hit_of_batch(asking->blob, hits, originals, 18));
    for (int i = 0; i < 18; ++i) tell_original(asking, originals[i]);
    for (uint32_t i = 0; i < 4; ++i) {
        turned.triangle = i == 3 ? ESPALIER_NO_TRIANGLE : i;
        tell_original(asking, espalier_original_hit_by_remap(remap, 2, &turned));
    }
    memset(triangles, 0, sizeof triangles);
    for (int i = 0; i < 18; ++i) named[i] = hits[i].triangle;
    for (size_t count = 1; count <= 18; count += 17) {
        tell_filled(asking, espalier_original_triangle_of_batch(asking->blob, named, triangles, count));
        for (size_t i = 0; i < count; ++i) tell_original_triangle(asking, triangles[i]);
    }
}

static espalier_visit visit_hit(const espalier_ray_hit* hit, void* user) {
    struct asking* asking = user;
    tell_ray_hit(asking, hit);
    return asking->visits-- == 0 ? 17 : ESPALIER_VISIT_NEXT; /* stops, as any value does that is not the other */
}

static void ask_one_ray(struct asking* asking, const espalier_ray* ray) {
    const espalier_blob* blob = asking->blob;
    espalier_ray_hit hits[5];
    espalier_filled count;
    espalier_query_counters counters = {1, 2, 3, 4, 5};
    tell_result(asking, espalier_raycast(blob, ray));
    tell_result(asking, espalier_raycast_filtered(blob, ray, counts, asking));
    tell(asking, espalier_occluded(blob, ray).status);
    tell(asking, espalier_occluded_filtered(blob, ray, counts, asking).status);
    memset(hits, 0, sizeof hits);
    count = espalier_closest_hits(blob, ray, hits, 5);
    tell_filled(asking, count);
    for (size_t i = 0; i < count.count; ++i) tell_ray_hit(asking, &hits[i]);
    count = espalier_closest_hits_filtered(blob, ray, hits, 2, counts, asking);
    tell_filled(asking, count);
    for (size_t i = 0; i < count.count; ++i) tell_ray_hit(asking, &hits[i]);
    asking->visits = asking->question->bits % 9u;
    tell(asking, espalier_for_each_hit(blob, ray, visit_hit, asking));
    asking->visits = asking->question->bits % 7u;
    tell(asking, espalier_for_each_crossing(blob, ray, visit_hit, asking));
    tell_result(asking, espalier_raycast_counted(blob, ray, &counters));
    tell_counters(asking, &counters);
}

static void ask_rounded_ray(struct asking* asking, const espalier_lattice* region, const espalier_ray* ray) {
    const espalier_rounded_ray rounded = espalier_round_ray(region, ray);
    tell(asking, espalier_rounded_ray_status(&rounded));
    tell_result(asking, espalier_raycast_rounded(asking->blob, &rounded));
    tell(asking, espalier_occluded_rounded(asking->blob, &rounded).status);
    tell_result(asking, espalier_raycast_rounded_filtered(asking->blob, &rounded, counts, asking));
    tell(asking, espalier_occluded_rounded_filtered(asking->blob, &rounded, counts, asking).status);
    asking->visits = asking->question->bits % 9u;
    tell(asking, espalier_for_each_hit_rounded(asking->blob, &rounded, visit_hit, asking));
    asking->visits = asking->question->bits % 7u;
    tell(asking, espalier_for_each_crossing_rounded(asking->blob, &rounded, visit_hit, asking));
    for (int whole = 0; whole < 2; ++whole) {
        const espalier_transform transform = {
            {0, 0, 0, 1}, {whole ? 64.0f : asking->question->lengths[0], 0, whole ? -128.0f : 0.0f}, 1};
        const espalier_rounded_ray local = espalier_to_local_rounded_ray(&transform, &rounded);
        tell(asking, espalier_rounded_ray_status(&local));
        tell_result(asking, espalier_raycast_rounded(asking->blob, &local));
    }
}

void fill_rays(const struct question* question, espalier_ray* rays, int count) {
    rays[0] = espalier_default_ray(question->points[0], question->directions[0]);
    rays[1] = rays[0];
    rays[1].t_min = question->lengths[0];
    rays[1].t_max = question->lengths[1];
    rays[1].culling = (espalier_face_culling)(question->bits % 4u); /* one value more than there are */
    rays[2] = espalier_ray_between(question->points[0], question->points[1]);
    for (int i = 3; i < count; ++i) {
        rays[i] = rays[i % 3];
        rays[i].origin = question->points[i % 4];
    }
}

void ask_rays(struct asking* asking) {
    const struct question* question = asking->question;
    const espalier_blob blobs[2] = {*asking->blob, *asking->other};
    const espalier_lattice region = espalier_blob_lattice(asking->blob);
    const espalier_lattice_result both = espalier_lattice_of_blobs(blobs, 2);
    espalier_ray rays[18];
    espalier_ray_hit hits[18];
    espalier_yes_no answers[18];
    fill_rays(question, rays, 18); /* a group, and strangers */
    for (int i = 0; i < 3; ++i) ask_one_ray(asking, &rays[i]);
    memset(hits, 0, sizeof hits);
    tell_filled(asking, espalier_raycast_batch(asking->blob, rays, hits, 18));
    for (int i = 0; i < 18; ++i) tell_ray_hit(asking, &hits[i]);
    ask_originals(asking, hits);
    memset(answers, 0, sizeof answers);
    tell_filled(asking, espalier_occluded_batch(asking->blob, rays, answers, 18));
    for (int i = 0; i < 18; ++i) tell(asking, answers[i].status);
    for (int i = 0; i < 3; ++i) ask_rounded_ray(asking, &region, &rays[i]);
    tell(asking, both.status);
    ask_rounded_ray(asking, &both.value, &rays[0]);
}
