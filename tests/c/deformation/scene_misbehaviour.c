#include "c/asking.h"

static unsigned char memory[20000];
static unsigned char block[20000];
static unsigned char copy_of_block[20000];

/* Whether a box holds another. */
static bool holds(espalier_box outer, espalier_box inner) {
    return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
           outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z;
}

/* The largest place along x that an instance of the first mesh accepts. */
static float last_place(espalier_moving_scene* scene, espalier_instance_handle handle) {
    espalier_transform place = espalier_identity();
    float last = 0, refused = 1;
    for (; place.translation.x = refused, espalier_moving_scene_move(scene, handle, &place) == ESPALIER_QUERY_OK;
         refused *= 2)
        last = refused;
    for (int i = 0; i < 40; ++i) {
        place.translation.x = last + (refused - last) / 2;
        if (espalier_moving_scene_move(scene, handle, &place) == ESPALIER_QUERY_OK) last = place.translation.x;
        else refused = place.translation.x;
    }
    place.translation.x = last;
    espalier_moving_scene_move(scene, handle, &place);
    return last;
}

/* A pose that leaves the world is refused, and changes nothing. */
static int misbehaviour_at_the_end(espalier_moving_scene* scene, espalier_deformable* mesh,
                                   const struct deformable_blob* blob, espalier_instance_handle handle) {
    size_t size = 0;
    if (espalier_deformable_refit(mesh, blob->rest, blob->count).status != ESPALIER_QUERY_OK) return 30;
    if (espalier_moving_scene_move_instances_of(scene, 0) != ESPALIER_QUERY_OK) return 31;
    if (last_place(scene, handle) < 1) return 32;
    espalier_moving_scene_refit(scene);
    if (espalier_moving_scene_move_instances_of(scene, 0) != ESPALIER_QUERY_OK) return 33;
    espalier_moving_scene_refit(scene);
    if (espalier_deformable_refit(mesh, blob->pose, blob->count).status != ESPALIER_QUERY_OK) return 34;
    const void* const bytes = espalier_moving_scene_block(scene, &size);
    memcpy(copy_of_block, bytes, size);
    if (espalier_moving_scene_move_instances_of(scene, 0) != ESPALIER_QUERY_OUT_OF_RANGE) return 35;
    if (memcmp(copy_of_block, bytes, size) != 0 || espalier_moving_scene_must_refit(scene)) return 36;
    return 0;
}

int misbehaviour_of_deformables_in_scenes(const struct deformable_blob* blob) {
    const espalier_instance instance = {espalier_identity(), 0, 1, 0, 0};
    const espalier_vec3 far_away = {100, 0, 0};
    unsigned char* const aligned = block + (32u - (uintptr_t)block % 32u) % 32u;
    espalier_blob baked, meshes[1];
    espalier_deformable mesh;
    espalier_moving_scene scene;
    espalier_scene view;
    if (espalier_open(blob->bytes, blob->size, &baked) != ESPALIER_OPEN_OK) return 1;
    if (espalier_create_deformable(&baked, memory, sizeof memory, &mesh) != ESPALIER_QUERY_OK) return 2;
    meshes[0] = *espalier_deformable_blob(&mesh);
    if (!espalier_create_moving_scene(aligned, sizeof block - 32, 8, -16, meshes, 1, NULL, 0, &scene)) return 3;
    if (espalier_moving_scene_move_instances_of(&scene, 0) != ESPALIER_QUERY_OK) return 4; /* there are none */
    if (espalier_moving_scene_must_refit(&scene)) return 5;
    const espalier_instance_handle_result inserted = espalier_moving_scene_insert(&scene, &instance);
    if (inserted.status != ESPALIER_QUERY_OK) return 6;
    const espalier_instance_handle handle = inserted.value;

    if (espalier_deformable_refit(&mesh, blob->pose, blob->count).status != ESPALIER_QUERY_OK) return 7;
    const espalier_box bounds = espalier_blob_bounds(&meshes[0]);
    if (holds(espalier_moving_scene_box_of(&scene, handle).value, bounds)) return 8; /* still the one of the rest */
    if (espalier_moving_scene_move_instances_of(&scene, 1) != ESPALIER_QUERY_INVALID_ARGUMENT) return 9;
    if (espalier_moving_scene_move_instances_of(&scene, UINT32_MAX) != ESPALIER_QUERY_INVALID_ARGUMENT) return 10;
    if (espalier_moving_scene_must_refit(&scene)) return 11;
    if (espalier_moving_scene_move_instances_of(&scene, 0) != ESPALIER_QUERY_OK) return 12;
    if (!holds(espalier_moving_scene_box_of(&scene, handle).value, bounds)) return 13;
    if (espalier_moving_scene_view(&scene, &view) != ESPALIER_QUERY_NOT_REFITTED) return 14;
    espalier_moving_scene_refit(&scene);
    if (espalier_moving_scene_view(&scene, &view) != ESPALIER_QUERY_OK) return 15;
    const espalier_closest_point_result in_scene = espalier_scene_closest_point(&view, far_away, 1000, UINT32_MAX).hit;
    const espalier_closest_point_result in_mesh = espalier_closest_point(&meshes[0], far_away, 1000);
    if (in_scene.status != ESPALIER_QUERY_OK || in_scene.triangle != in_mesh.triangle) return 16;
    if (in_mesh.distance >= 100 - espalier_blob_bounds(&baked).max.x) return 17; /* nearer than at rest */
    return misbehaviour_at_the_end(&scene, &mesh, blob, handle);
}
