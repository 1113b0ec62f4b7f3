#include "asking.h"

#include <math.h>

/* A null filter lets everything count, a null visitor is refused, and arrays of no elements may be null. */
void ask_nothing(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const espalier_ray ray = espalier_default_ray(question->points[0], question->directions[0]);
    const struct asked_shapes shapes = shapes_of(question);
    const espalier_lattice_box steps = {{0, 0, 0}, {9, 9, 9}};
    espalier_filled hits;
    espalier_filled page;
    const espalier_cursor begin = {{0, 0, 0}};
    const espalier_convex_volume volume = {NULL, 0};
    const espalier_convex_hull hull = {NULL, 0};
    espalier_ray_hit hit;
    espalier_placed_blob placed, other;
    espalier_filled filled;

    hit = espalier_raycast_filtered(blob, &ray, NULL, NULL);
    tell(asking, hit.status);
    tell_float(asking, hit.t);
    tell(asking, espalier_occluded_filtered(blob, &ray, NULL, NULL).status);
    hits = espalier_closest_hits_filtered(blob, &ray, &hit, 1, NULL, NULL);
    tell_filled(asking, hits);
    tell_float(asking, espalier_sweep_sphere_filtered(blob, &shapes.sphere, ray.direction, NULL, NULL).t);
    tell_float(asking, espalier_sweep_capsule_filtered(blob, &shapes.capsule, ray.direction, NULL, NULL).t);
    tell_float(asking, espalier_sweep_box_filtered(blob, &shapes.box, ray.direction, NULL, NULL).t);
    tell_float(asking, espalier_sweep_oriented_box_filtered(blob, &shapes.oriented_box, ray.direction, NULL, NULL).t);
    tell_float(asking, espalier_sweep_convex_hull_filtered(blob, &shapes.convex_hull, ray.direction, NULL, NULL).t);
    tell(asking, espalier_sweep_convex_hull(blob, &hull, ray.direction).status);

    tell(asking, espalier_for_each_hit(blob, &ray, NULL, asking));
    tell(asking, espalier_for_each_crossing(blob, &ray, NULL, asking));
    tell(asking, espalier_for_each_overlap_sphere(blob, &shapes.sphere, NULL, asking));
    tell(asking, espalier_for_each_overlap_capsule(blob, &shapes.capsule, NULL, asking));
    tell(asking, espalier_for_each_overlap_box(blob, &shapes.box, NULL, asking));
    tell(asking, espalier_for_each_overlap_oriented_box(blob, &shapes.oriented_box, NULL, asking));
    tell(asking, espalier_for_each_overlap_cone(blob, &shapes.cone, NULL, asking));
    tell(asking, espalier_for_each_overlap_triangle(blob, &shapes.triangle, NULL, asking));
    tell(asking, espalier_for_each_overlap_convex_volume(blob, &volume, NULL, asking));
    tell(asking, espalier_for_each_overlap_lattice_box(blob, &steps, NULL, asking));
    tell(asking, espalier_for_each_triangle(blob, NULL, asking));
    tell(asking, espalier_for_each_node(blob, NULL, asking));
    placed.blob = blob;
    other.blob = asking->other;
    placed.transform = other.transform = espalier_identity();
    tell(asking, espalier_for_each_contact(&placed, &other, NULL, asking, 100));
    tell(asking, espalier_for_each_touch(&placed, &other, NULL, asking, 100));

    tell_filled(asking, espalier_raycast_batch(blob, NULL, NULL, 0));
    tell_filled(asking, espalier_occluded_batch(blob, NULL, NULL, 0));
    tell_filled(asking, espalier_original_hit_of_batch(blob, NULL, NULL, 0));
    tell_filled(asking, espalier_original_triangle_of_batch(blob, NULL, NULL, 0));
    tell(asking, espalier_original_hit_by_remap(NULL, 0, &hit).status);
    tell(asking, espalier_read_remap(NULL, 0, blob, NULL, 0));
    hits = espalier_closest_hits(blob, &ray, NULL, 0);
    tell_filled(asking, hits);
    tell(asking, espalier_closest_triangles(blob, question->points[0], NULL, 0, INFINITY).status);
    tell_yes_no(asking, espalier_overlaps_convex_volume(blob, &volume));
    page = espalier_collect_overlaps_sphere(blob, &shapes.sphere, NULL, 0, begin);
    tell(asking, page.status);
    tell(asking, page.next.place[0]);
    page = espalier_collect_overlaps_convex_volume(blob, &volume, NULL, 0, begin);
    tell(asking, page.status);
    tell(asking, page.next.place[0]);
    memset(&filled, 0, sizeof filled);
    filled = espalier_collect_contacts(&placed, &other, NULL, 0, 100, filled.next);
    tell(asking, (uint32_t)filled.count);
    tell(asking, filled.status);
}

/* The number of statuses that a yes-or-no result takes for something else than it is, of any 256. */
static int misbehaviour_of_yes_no(void) {
    int wrong = 0;
    for (int status = 0; status < 256; ++status) {
        const espalier_yes_no answer = {(espalier_query_status)status};
        wrong += espalier_yes(answer) != (status == ESPALIER_QUERY_OK);
        wrong += espalier_no(answer) != (status == ESPALIER_QUERY_NOT_FOUND);
        wrong += espalier_is_refused(answer.status) != (status >= 16);
    }
    return wrong;
}

static bool is_empty(const espalier_blob* blob) {
    return espalier_blob_size(blob) == 0 && espalier_blob_triangle_count(blob) == 0;
}

/* At each address of a 16-byte block, as other languages may hand them over. Refused ones are not written. */
static int misbehaviour_when_misaligned(const void* bytes, size_t size) {
    static espalier_blob room[2];
    for (uintptr_t offset = 0; offset < 16; ++offset) {
        const uintptr_t address = (uintptr_t)room + offset;
        espalier_blob* blob = (espalier_blob*)address;
        const espalier_open_status expected = offset == 0 ? ESPALIER_OPEN_OK : ESPALIER_OPEN_MISALIGNED;
        for (int unchecked = 0; unchecked < 2; ++unchecked) {
            memset(room, 0xA5, sizeof room);
            if ((unchecked ? espalier_open_unchecked : espalier_open)(bytes, size, blob) != expected) return 12;
            for (size_t i = 0; expected != ESPALIER_OPEN_OK && i < sizeof room; ++i)
                if (((const unsigned char*)room)[i] != 0xA5) return 13;
        }
    }
    return 0;
}

int misbehaviour_of_open(const void* bytes, size_t size) {
    static espalier_blob zero; /* as static storage is */
    espalier_blob blob, copy;
    if (!is_empty(&zero) || espalier_blob_status(&zero) != ESPALIER_OPEN_NOT_OPENED) return 1;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_open(bytes, size, &blob) != ESPALIER_OPEN_OK) return 2;
    copy = blob;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_blob_size(&copy) != size) return 3;
    if (espalier_open_unchecked(bytes, size, &blob) != ESPALIER_OPEN_OK) return 4;
    if (espalier_blob_size(&blob) != size) return 5;
    if (espalier_open(bytes, size - 1, &copy) != ESPALIER_OPEN_TOO_SHORT || !is_empty(&copy)) return 6;
    if (espalier_blob_status(&copy) != ESPALIER_OPEN_TOO_SHORT) return 14;
    if (espalier_open_unchecked(bytes, size - 1, &blob) != ESPALIER_OPEN_TOO_SHORT || !is_empty(&blob)) return 7;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_open(NULL, 0, &blob) != ESPALIER_OPEN_TOO_SHORT || !is_empty(&blob)) return 8;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_open_unchecked(NULL, 0, &blob) != ESPALIER_OPEN_TOO_SHORT || !is_empty(&blob)) return 9;
    if (strlen(espalier_describe_open_status(ESPALIER_OPEN_TOO_SHORT)) == 0) return 10;
    if (strlen(espalier_describe_query_status(ESPALIER_QUERY_WORK_LIMIT)) == 0) return 11;
    if (misbehaviour_of_yes_no() != 0) return 15;
    return misbehaviour_when_misaligned(bytes, size);
}
