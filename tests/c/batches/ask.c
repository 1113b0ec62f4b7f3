#include "c/asking.h"

enum { queries = 4, most = 40 };

static espalier_strided_vec3 points_of(const struct question* question) {
    const espalier_strided_vec3 points = {question->points, sizeof question->points[0]};
    return points;
}

/* The last direction first. */
static espalier_strided_vec3 directions_of(const struct question* question) {
    const espalier_strided_vec3 directions = {&question->directions[3], -(ptrdiff_t)sizeof question->directions[0]};
    return directions;
}

static espalier_strided_float lengths_of(const struct question* question) {
    const espalier_strided_float lengths = {question->lengths, sizeof question->lengths[0]};
    return lengths;
}

static espalier_ray_arrays rays_of(const struct question* question) {
    espalier_ray_arrays rays;
    memset(&rays, 0, sizeof rays);
    rays.origins = points_of(question);
    rays.directions = directions_of(question);
    if (question->bits & 1u) rays.t_max = lengths_of(question);
    if (question->bits & 2u) rays.t_min.first = &question->lengths[3]; /* of a stride of 0: the same for all */
    rays.culling = (espalier_face_culling)(question->bits >> 2 & 3u);
    return rays;
}

static const void* moved(const void* first, ptrdiff_t stride, size_t queries_passed) {
    return first == NULL ? NULL : (const char*)first + stride * (ptrdiff_t)queries_passed;
}

static espalier_ray_arrays rays_from(const espalier_ray_arrays* all, size_t query) {
    espalier_ray_arrays rays = *all;
    rays.origins.first = moved(all->origins.first, all->origins.stride, query);
    rays.directions.first = moved(all->directions.first, all->directions.stride, query);
    rays.t_min.first = moved(all->t_min.first, all->t_min.stride, query);
    rays.t_max.first = moved(all->t_max.first, all->t_max.stride, query);
    return rays;
}

static void ask_arrays_of_rays(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const espalier_ray_arrays rays = rays_of(asking->question);
    espalier_ray_hit hits[queries];
    espalier_yes_no answers[queries];
    espalier_ray_hit rows[queries * 3];
    espalier_filled filled, found[queries];
    memset(hits, 0, sizeof hits);
    memset(answers, 0, sizeof answers);
    memset(found, 0, sizeof found);
    filled = espalier_raycast_arrays(blob, &rays, hits, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_ray_hit(asking, &hits[i]);
    filled = espalier_occluded_arrays(blob, &rays, answers, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_yes_no(asking, answers[i]);
    filled = espalier_closest_hits_arrays(blob, &rays, rows, 3, found, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) {
        tell_filled(asking, found[i]);
        for (size_t k = 0; k < found[i].count; ++k) tell_ray_hit(asking, &rows[3 * i + k]);
    }
}

static void tell_lists(struct asking* asking, espalier_filled_lists filled, const espalier_query_status* statuses,
                       const size_t* offsets) {
    tell(asking, (uint32_t)filled.lists);
    tell(asking, (uint32_t)filled.count);
    tell(asking, (uint32_t)filled.needed);
    tell(asking, filled.status);
    for (size_t i = 0; i < filled.lists; ++i) {
        tell(asking, statuses[i]);
        tell(asking, (uint32_t)offsets[i + 1]);
    }
}

static void ask_lists_of_hits(struct asking* asking, bool of_crossings) {
    const espalier_ray_arrays all = rays_of(asking->question);
    espalier_query_status statuses[queries];
    size_t offsets[queries + 1], first = 0, capacity = asking->question->bits % 7u;
    espalier_ray_hit hits[most];
    for (;;) {
        const espalier_ray_arrays rays = rays_from(&all, first);
        const size_t left = queries - first;
        const espalier_filled_lists filled =
            of_crossings
                ? espalier_collect_crossings_arrays(asking->blob, &rays, statuses, offsets, left, hits, capacity)
                : espalier_collect_hits_arrays(asking->blob, &rays, statuses, offsets, left, hits, capacity);
        tell_lists(asking, filled, statuses, offsets);
        for (size_t i = 0; i < filled.count; ++i) tell_ray_hit(asking, &hits[i]);
        first += filled.lists;
        if (filled.status != ESPALIER_QUERY_OUTPUT_FULL || filled.needed > most) return;
        if (filled.needed > capacity) capacity = filled.needed;
    }
}

static void ask_arrays_of_points(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const espalier_strided_vec3 points = points_of(asking->question);
    const float reach = asking->question->lengths[0];
    espalier_closest_point_result nearest[queries], rows[queries * 2];
    espalier_yes_no answers[queries];
    espalier_filled filled, found[queries];
    memset(nearest, 0, sizeof nearest);
    memset(answers, 0, sizeof answers);
    memset(found, 0, sizeof found);
    filled = espalier_closest_point_arrays(blob, points, nearest, queries, reach);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_closest_point(asking, nearest[i]);
    filled = espalier_signed_distance_arrays(blob, points, nearest, queries, reach);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_closest_point(asking, nearest[i]);
    filled = espalier_contains_arrays(blob, points, answers, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_yes_no(asking, answers[i]);
    filled = espalier_closest_triangles_arrays(blob, points, rows, 2, found, queries, reach);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) {
        tell_filled(asking, found[i]);
        for (size_t k = 0; k < found[i].count; ++k) tell_closest_point(asking, rows[2 * i + k]);
    }
}

static void ask_arrays_of_volumes(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const espalier_sphere_arrays spheres = {points_of(asking->question), lengths_of(asking->question)};
    /* One corner of all boxes is the same. */
    const espalier_box_arrays boxes = {{asking->question->points, 0}, points_of(asking->question)};
    espalier_yes_no answers[queries];
    espalier_query_status statuses[queries];
    size_t offsets[queries + 1];
    espalier_triangle_id triangles[most];
    espalier_filled filled;
    espalier_filled_lists lists;
    filled = espalier_overlaps_sphere_arrays(blob, &spheres, answers, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_yes_no(asking, answers[i]);
    filled = espalier_overlaps_box_arrays(blob, &boxes, answers, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_yes_no(asking, answers[i]);
    lists = espalier_collect_overlaps_sphere_arrays(blob, &spheres, statuses, offsets, queries, triangles, most);
    tell_lists(asking, lists, statuses, offsets);
    for (size_t i = 0; i < lists.count; ++i) tell(asking, triangles[i]);
    lists = espalier_collect_overlaps_box_arrays(blob, &boxes, statuses, offsets, queries, triangles, most);
    tell_lists(asking, lists, statuses, offsets);
    for (size_t i = 0; i < lists.count; ++i) tell(asking, triangles[i]);
}

static void ask_arrays_of_triangles(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    struct {
        char beside;
        espalier_triangle_id triangle;
    } ids[queries];
    const espalier_strided_triangle_id triangles = {&ids[0].triangle, sizeof ids[0]};
    espalier_original_triangle_result originals[queries];
    espalier_triangle_result corners[queries];
    uint16_t materials[queries];
    espalier_filled filled;
    ids[0].triangle = 0;
    ids[1].triangle = asking->question->bits % 200u;
    ids[2].triangle = asking->question->bits;
    ids[3].triangle = ESPALIER_NO_TRIANGLE;
    filled = espalier_original_triangle_of_arrays(blob, triangles, originals, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell_original_triangle(asking, originals[i]);
    filled = espalier_material_arrays(blob, triangles, materials, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) tell(asking, materials[i]);
    filled = espalier_triangle_at_arrays(blob, triangles, corners, queries);
    tell_filled(asking, filled);
    for (size_t i = 0; i < filled.count; ++i) {
        tell(asking, corners[i].status);
        tell_point(asking, corners[i].value.a);
        tell_point(asking, corners[i].value.b);
        tell_point(asking, corners[i].value.c);
    }
}

void ask_batches(struct asking* asking) {
    ask_arrays_of_rays(asking);
    ask_lists_of_hits(asking, false);
    ask_lists_of_hits(asking, true);
    ask_arrays_of_points(asking);
    ask_arrays_of_volumes(asking);
    ask_arrays_of_triangles(asking);
}
