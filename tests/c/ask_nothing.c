#include "asking.h"

/* A null filter lets everything count, a null visitor is refused, and arrays of no elements may be null. */
void ask_nothing(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const espalier_ray ray = espalier_ray_from(question->points[0], question->directions[0]);
    const espalier_placement placement = espalier_unplaced();
    espalier_sphere sphere;
    espalier_capsule capsule;
    espalier_box box;
    espalier_oriented_box oriented;
    espalier_corners triangle;
    const espalier_box_in_steps steps = {{0, 0, 0}, {9, 9, 9}};
    espalier_hit_count hits;
    espalier_overlap_page page;
    espalier_ray_hit hit;
    espalier_sweep_hit swept;
    size_t count = 1;
    memset(&hit, 0, sizeof hit);
    memset(&swept, 0, sizeof swept);
    sphere.center = question->points[0];
    sphere.radius = question->lengths[0];
    capsule.from = question->points[0];
    capsule.to = question->points[1];
    capsule.radius = question->lengths[0];
    box.min = question->points[0];
    box.max = question->points[1];
    oriented.center = question->points[0];
    for (int i = 0; i < 3; ++i) oriented.half_axes[i] = question->directions[i];
    triangle.a = question->points[0];
    triangle.b = question->points[1];
    triangle.c = question->points[2];

    tell(asking, espalier_raycast_filtered(blob, &ray, &hit, NULL, NULL));
    tell_float(asking, hit.t);
    tell(asking, espalier_occluded_filtered(blob, &ray, NULL, NULL));
    hits = espalier_closest_hits_filtered(blob, &ray, &hit, 1, NULL, NULL);
    tell(asking, (uint32_t)hits.count);
    tell(asking, hits.status);
    tell(asking, espalier_sweep_sphere_filtered(blob, &sphere, ray.direction, &swept, NULL, NULL));
    tell_float(asking, swept.t);
    tell(asking, espalier_sweep_capsule_filtered(blob, &capsule, ray.direction, &swept, NULL, NULL));
    tell_float(asking, swept.t);
    tell(asking, espalier_sweep_box_filtered(blob, &box, ray.direction, &swept, NULL, NULL));
    tell_float(asking, swept.t);

    tell(asking, espalier_for_each_hit(blob, &ray, NULL, asking));
    tell(asking, espalier_for_each_overlap_sphere(blob, &sphere, NULL, asking));
    tell(asking, espalier_for_each_overlap_capsule(blob, &capsule, NULL, asking));
    tell(asking, espalier_for_each_overlap_box(blob, &box, NULL, asking));
    tell(asking, espalier_for_each_overlap_oriented_box(blob, &oriented, NULL, asking));
    tell(asking, espalier_for_each_overlap_triangle(blob, &triangle, NULL, asking));
    tell(asking, espalier_for_each_overlap_planes(blob, NULL, 0, NULL, asking));
    tell(asking, espalier_for_each_overlap_box_in_steps(blob, &steps, NULL, asking));
    tell(asking, espalier_for_each_triangle(blob, NULL, asking));
    tell(asking, espalier_for_each_node(blob, NULL, asking));
    tell(asking, espalier_for_each_contact(blob, asking->other, &placement, NULL, asking, 100));

    tell(asking, (uint32_t)espalier_raycast_batch(blob, NULL, NULL, 0));
    tell(asking, (uint32_t)espalier_occluded_batch(blob, NULL, NULL, 0));
    tell(asking, espalier_get_original_hit_batch(blob, NULL, NULL, 0));
    tell(asking, espalier_get_original_triangle_batch(blob, NULL, NULL, 0));
    tell(asking, espalier_get_original_hit_by_remap(NULL, 0, &hit).status);
    tell(asking, espalier_read_remap(NULL, 0, blob, NULL, 0));
    hits = espalier_closest_hits(blob, &ray, NULL, 0);
    tell(asking, (uint32_t)hits.count);
    tell(asking, hits.status);
    tell(asking, (uint32_t)espalier_closest_triangles(blob, question->points[0], question->lengths[0], NULL, 0));
    tell(asking, espalier_overlaps_planes(blob, NULL, 0));
    page = espalier_collect_overlaps_sphere(blob, &sphere, NULL, 0, 0);
    tell(asking, page.status);
    tell(asking, page.next);
    page = espalier_collect_overlaps_planes(blob, NULL, 0, NULL, 0, 0);
    tell(asking, page.status);
    tell(asking, page.next);
    tell(asking, espalier_all_contacts(blob, asking->other, &placement, NULL, 0, &count, 100));
    tell(asking, (uint32_t)count);
}

static bool is_empty(const espalier_blob* blob) {
    return espalier_blob_size_bytes(blob) == 0 && espalier_blob_triangle_count(blob) == 0;
}

/* At each address of a 16-byte block, as other languages may hand them over. Refused ones are not written. */
static int misbehaviour_when_misaligned(const void* bytes, size_t size) {
    static espalier_blob room[2];
    for (uintptr_t offset = 0; offset < 16; ++offset) {
        const uintptr_t address = (uintptr_t)room + offset;
        espalier_blob* blob = (espalier_blob*)address;
        const espalier_status expected = offset == 0 ? ESPALIER_STATUS_OK : ESPALIER_STATUS_MISALIGNED;
        for (int trusted = 0; trusted < 2; ++trusted) {
            memset(room, 0xA5, sizeof room);
            if ((trusted ? espalier_open_trusted_image : espalier_open)(bytes, size, blob) != expected) return 12;
            for (size_t i = 0; expected != ESPALIER_STATUS_OK && i < sizeof room; ++i)
                if (((const unsigned char*)room)[i] != 0xA5) return 13;
        }
    }
    return 0;
}

int misbehaviour_of_open(const void* bytes, size_t size) {
    static espalier_blob zero; /* as static storage is */
    espalier_blob blob, copy;
    if (!is_empty(&zero)) return 1;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_open(bytes, size, &blob) != ESPALIER_STATUS_OK) return 2;
    copy = blob;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_blob_size_bytes(&copy) != size) return 3;
    if (espalier_open_trusted_image(bytes, size, &blob) != ESPALIER_STATUS_OK) return 4;
    if (espalier_blob_size_bytes(&blob) != size) return 5;
    if (espalier_open(bytes, size - 1, &copy) != ESPALIER_STATUS_TOO_SHORT || !is_empty(&copy)) return 6;
    if (espalier_open_trusted_image(bytes, size - 1, &blob) != ESPALIER_STATUS_TOO_SHORT || !is_empty(&blob)) return 7;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_open(NULL, 0, &blob) != ESPALIER_STATUS_TOO_SHORT || !is_empty(&blob)) return 8;
    memset(&blob, 0xA5, sizeof blob);
    if (espalier_open_trusted_image(NULL, 0, &blob) != ESPALIER_STATUS_TOO_SHORT || !is_empty(&blob)) return 9;
    if (strlen(espalier_describe_status(ESPALIER_STATUS_TOO_SHORT)) == 0) return 10;
    if (strlen(espalier_describe_query_status(ESPALIER_QUERY_WORK_LIMIT)) == 0) return 11;
    return misbehaviour_when_misaligned(bytes, size);
}
