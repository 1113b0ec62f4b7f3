#include "c/asking.h"

#include <espalier/c/bake.h>

/* The number of the first thing that is wrong. */
#define EXPECT(condition)                \
    do {                                 \
        ++number;                        \
        if (!(condition)) return number; \
    } while (0)

static const float corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
static const uint16_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

static espalier_visit stop_at_once(const char* stage, double done, void* user) {
    if (stage == NULL || done < 0) return ESPALIER_VISIT_NEXT;
    ++*(int*)user;
    return ESPALIER_VISIT_STOP;
}

static int check_blob(int number, const espalier_bake_result* baked) {
    espalier_blob blob;
    const espalier_vec3 eye = {0.25f, 0.5f, 9}, down = {0, 0, -1}, middle = {0.5f, 0.5f, 0.5f};
    const espalier_ray ray = espalier_default_ray(eye, down);
    EXPECT(espalier_open(baked->bytes, baked->byte_count, &blob) == ESPALIER_OPEN_OK);
    EXPECT(espalier_blob_triangle_count(&blob) == 12);
    EXPECT(espalier_raycast(&blob, &ray).t == 8.0f);
    EXPECT(espalier_yes(espalier_contains(&blob, middle)));
    return 0;
}

static int check_scene(int number, const espalier_bake_result* baked) {
    espalier_bytes blob;
    espalier_instance instance;
    const espalier_bake_result* result;
    blob.bytes = baked->bytes;
    blob.byte_count = baked->byte_count;
    memset(&instance, 0, sizeof instance);
    instance.transform = espalier_identity();
    instance.mask = 1;
    result = espalier_bake_scene(&blob, 1, &instance, 1);
    EXPECT(result->status == ESPALIER_BAKE_OK);
    EXPECT(result->byte_count > blob.byte_count);
    baked = espalier_verify_scene(result->bytes, result->byte_count);
    EXPECT(baked->status == ESPALIER_BAKE_OK);
    espalier_release_bake_result(baked);
    baked = espalier_verify(result->bytes, result->byte_count);
    EXPECT(baked->status == ESPALIER_BAKE_NOT_SOUND && baked->message[0] != '\0');
    espalier_release_bake_result(baked);
    espalier_release_bake_result(result);
    return 0;
}

int misbehaviour_of_baking(void) {
    int number = 0, stops = 0, wrong;
    espalier_mesh_view mesh;
    espalier_bake_options options;
    const espalier_bake_result* baked;
    espalier_init_mesh_view(&mesh, sizeof mesh);
    mesh.positions = corners;
    mesh.position_count = 8;
    mesh.triangles = faces;
    mesh.triangle_count = 12;
    mesh.triangle_stride = sizeof faces[0];
    mesh.index_type = ESPALIER_INDEX_UINT16;
    mesh.name = "cube";
    espalier_init_bake_options(&options, sizeof options);
    options.with_remap = 1;
    baked = espalier_bake(&mesh, 1, &options);
    EXPECT(baked->status == ESPALIER_BAKE_OK);
    EXPECT(baked->message[0] == '\0');
    EXPECT((uintptr_t)baked->bytes % 64 == 0);
    EXPECT(baked->report->is_closed == 1);
    EXPECT(baked->report->triangles == 12);
    EXPECT(baked->remap_count == 12);
    wrong = check_blob(number, baked);
    if (wrong != 0) return wrong;
    wrong = check_scene(50, baked);
    if (wrong != 0) return wrong;
    espalier_release_bake_result(baked);
    espalier_release_bake_result(NULL);
    number = 100;
    options.progress = stop_at_once;
    options.progress_user = &stops;
    baked = espalier_bake(&mesh, 1, &options);
    EXPECT(baked->status == ESPALIER_BAKE_STOPPED);
    EXPECT(stops == 1);
    EXPECT(baked->bytes == NULL && baked->byte_count == 0);
    EXPECT(strstr(baked->message, "progress") != NULL);
    espalier_release_bake_result(baked);
    EXPECT(strlen(espalier_describe_bake_status(ESPALIER_BAKE_STOPPED)) > 10);
    EXPECT(espalier_size_of_baking("bake_options") == sizeof options);
    EXPECT(espalier_size_of("ray_hit") == sizeof(espalier_ray_hit));
    EXPECT(strcmp(espalier_version(), ESPALIER_VERSION) == 0);
    return 0;
}
