#include <math.h>

#include "c/asking.h"

#define CAPACITY 20
#define STEP_EXPONENT (-16)

static unsigned char memory[20000];
static unsigned char copy_of_memory[20000];

/* The first address that 32 divides. */
static unsigned char* aligned(unsigned char* place) { return place + (32u - (uintptr_t)place % 32u) % 32u; }

static bool is_filled_with(const void* place, size_t size, unsigned char value) {
    for (size_t i = 0; i < size; ++i)
        if (((const unsigned char*)place)[i] != value) return false;
    return true;
}

/* Whether a scene is not open and refuses everything. */
static int misbehaviour_of_empty(espalier_moving_scene* scene) {
    const espalier_instance instance = {{{0, 0, 0, 1}, {0, 0, 0}, 1}, 0, 1, 0, 0};
    const espalier_instance_handle handle = {0, 1};
    const espalier_instance_pair begin = {0, 0};
    espalier_scene view;
    size_t size = 99, meshes = 99, tiles = 99;
    if (espalier_moving_scene_is_open(scene) || espalier_moving_scene_must_refit(scene)) return 1;
    if (espalier_moving_scene_capacity(scene) != 0 || espalier_moving_scene_slot_end(scene) != 0) return 2;
    if (espalier_moving_scene_block(scene, &size) != NULL || size != 0) return 3;
    if (espalier_moving_scene_meshes(scene, &meshes) != NULL || meshes != 0) return 4;
    if (espalier_moving_scene_tiles(scene, &tiles) != NULL || tiles != 0) return 5;
    if (espalier_moving_scene_insert(scene, &instance).status != ESPALIER_QUERY_NOT_OPEN) return 6;
    if (espalier_moving_scene_remove(scene, handle) != ESPALIER_QUERY_NOT_OPEN) return 7;
    if (espalier_moving_scene_refit(scene) != 0) return 8;
    if (espalier_moving_scene_move_instances_of(scene, 0) != ESPALIER_QUERY_NOT_OPEN) return 12;
    espalier_moving_scene_repack(scene);
    espalier_moving_scene_end_step(scene);
    memset(&view, 0xA5, sizeof view);
    if (espalier_moving_scene_view(scene, &view) != ESPALIER_QUERY_NOT_OPEN) return 9;
    if (espalier_scene_status(&view) != ESPALIER_OPEN_NOT_OPENED || espalier_scene_instance_count(&view) != 0)
        return 11;
    if (espalier_collect_candidate_pairs(scene, NULL, 0, NULL, begin).status != ESPALIER_QUERY_NOT_OPEN) return 10;
    return 0;
}

/* Each number and address that a creation refuses, into a view that was something else before. */
static int misbehaviour_of_create(const espalier_blob* meshes, size_t mesh_count) {
    const uint64_t least = espalier_least_moving_scene_bytes(CAPACITY);
    const uint32_t most = UINT32_C(1) << 24;
    unsigned char* block = aligned(memory);
    espalier_moving_scene room[2], scene;
    if (espalier_moving_scene_bytes(0) != 0 || espalier_least_moving_scene_bytes(most + 1u) != 0) return 20;
    if (least == 0 || least > espalier_moving_scene_bytes(CAPACITY) || least > sizeof memory - 32) return 21;
    for (int refused = 0; refused < 6; ++refused) {
        unsigned char* const at = block + (refused == 0 ? 16 : 0);
        const size_t size = refused == 1 ? (size_t)least - 1 : (size_t)least;
        const uint32_t capacity = refused == 2 ? 0 : refused == 3 ? most + 1u : CAPACITY;
        const int exponent = refused == 4 ? -101 : refused == 5 ? 81 : STEP_EXPONENT;
        memset(&scene, 0xA5, sizeof scene);
        if (espalier_create_moving_scene(at, size, capacity, exponent, meshes, mesh_count, NULL, 0, &scene))
            return 30 + refused;
        if (misbehaviour_of_empty(&scene) != 0) return 40 + refused;
    }
    if (espalier_create_moving_scene(NULL, 0, CAPACITY, 0, NULL, 0, NULL, 0, &scene)) return 22;
    if (espalier_open_moving_scene(NULL, 0, NULL, 0, NULL, 0, &scene)) return 23;
    for (uintptr_t offset = 1; offset < sizeof(void*); ++offset) {
        espalier_moving_scene* misaligned = (espalier_moving_scene*)((uintptr_t)room + offset);
        memset(room, 0xA5, sizeof room);
        if (espalier_create_moving_scene(block, (size_t)least, CAPACITY, 0, meshes, mesh_count, NULL, 0, misaligned) ||
            espalier_open_moving_scene(block, (size_t)least, meshes, mesh_count, NULL, 0, misaligned))
            return 24;
        if (!is_filled_with(room, sizeof room, 0xA5)) return 25;
    }
    if (!espalier_create_moving_scene(block, (size_t)least, CAPACITY, 80, NULL, 0, NULL, 0, &scene)) return 26;
    if (!espalier_create_moving_scene(block, (size_t)least, CAPACITY, -100, NULL, 0, NULL, 0, &scene)) return 27;
    return 0;
}

/* A view in the place of a baked scene, of each function that is no query. */
static int misbehaviour_of_view(espalier_moving_scene* scene, const espalier_scene* baked, espalier_box around) {
    static espalier_scene room[2];
    unsigned char* block = aligned(copy_of_memory);
    const espalier_instance_id ids[] = {{0, ESPALIER_NO_INSTANCE}, {0, 0}, {1, 0}, {99, 99}};
    const espalier_baked_pair begin = {0, {0, 0}}, from = {1, {2, 3}};
    espalier_moving_scene other;
    espalier_baked_pair pair;
    espalier_scene view;
    size_t count = 0;
    if (espalier_moving_scene_view(scene, &view) != ESPALIER_QUERY_OK) return 50;
    for (size_t i = 0; i < sizeof ids / sizeof *ids; ++i) {
        if (espalier_scene_instance_at(&view, ids[i]).status != ESPALIER_QUERY_INVALID_ARGUMENT) return 51;
        if (espalier_scene_mesh_at(&view, ids[i]).status != ESPALIER_QUERY_INVALID_ARGUMENT) return 52;
        if (espalier_scene_is_on_common_lattice(&view, ids[i]).status != ESPALIER_QUERY_INVALID_ARGUMENT) return 53;
    }
    if (espalier_scene_common_lattice(&view).status != ESPALIER_QUERY_NOT_FOUND) return 54;
    if (espalier_scene_size(&view) != 0 || !isinf(espalier_scene_max_error(&view))) return 55;
    if (espalier_scene_instance_count(&view) != espalier_moving_scene_instance_count(scene)) return 56;
    if (espalier_scene_meshes(&view, &count) != espalier_moving_scene_meshes(scene, &count)) return 57;
    if (espalier_scene_tiles(&view, &count) != espalier_moving_scene_tiles(scene, &count)) return 58;
    const espalier_box bounds = espalier_scene_bounds(&view);
    if (bounds.min.x > around.min.x || bounds.min.y > around.min.y || bounds.min.z > around.min.z) return 59;
    if (bounds.max.x < around.max.x || bounds.max.y < around.max.y || bounds.max.z < around.max.z) return 60;

    espalier_filled_baked_pairs page = espalier_collect_candidate_pairs_with_baked(scene, &view, &pair, 1, NULL, from);
    if (page.status != ESPALIER_QUERY_INVALID_ARGUMENT || page.count != 0) return 61;
    if (page.next.moving != 1 || page.next.baked.index != 2 || page.next.baked.in_tile != 3) return 62;
    page = espalier_collect_colliding_pairs_with_baked(scene, &view, &pair, 1, 99, NULL, begin);
    if (page.status != ESPALIER_QUERY_INVALID_ARGUMENT) return 63;
    page = espalier_collect_colliding_pairs_with_baked(scene, baked, NULL, 0, 99, NULL, begin);
    if (page.status == ESPALIER_QUERY_INVALID_ARGUMENT || page.count != 0) return 64;

    const espalier_scene tiles[] = {*baked, view};
    if (!espalier_create_moving_scene(block, 10000, CAPACITY, 0, NULL, 0, tiles, 1, &other)) return 65;
    if (espalier_create_moving_scene(block, 10000, CAPACITY, 0, NULL, 0, tiles, 2, &other)) return 66;
    if (misbehaviour_of_empty(&other) != 0) return 67;
    if (espalier_open_moving_scene(block, 10000, NULL, 0, tiles, 2, &other)) return 68;

    for (uintptr_t offset = 1; offset < 16; ++offset) {
        memset(room, 0xA5, sizeof room);
        if (espalier_moving_scene_view(scene, (espalier_scene*)((uintptr_t)room + offset)) !=
            ESPALIER_QUERY_INVALID_ARGUMENT)
            return 69;
        if (!is_filled_with(room, sizeof room, 0xA5)) return 70;
    }
    return 0;
}

/* A view of a scene that waits for a refit is refused like the scene. */
static int misbehaviour_of_batch(espalier_moving_scene* scene, espalier_instance_handle instance) {
    const espalier_movement movement = {instance, {{0, 0, 0, 1}, {1, 2, 3}, 1}};
    const espalier_vec3 origin = {0, 0, 0};
    const espalier_baked_pair begin = {0, {0, 0}};
    const espalier_instance_pair first = {0, 0};
    unsigned char* block = aligned(copy_of_memory);
    espalier_moving_scene other;
    espalier_scene view;
    if (espalier_moving_scene_move_batch(scene, NULL, 0).status != ESPALIER_QUERY_OK) return 80;
    if (espalier_moving_scene_must_refit(scene)) return 81;
    if (espalier_moving_scene_move_batch(scene, &movement, 1).count != 1) return 82;
    if (espalier_moving_scene_view(scene, &view) != ESPALIER_QUERY_NOT_REFITTED) return 83;
    if (espalier_scene_closest_point(&view, origin, 9, UINT32_MAX).hit.status != ESPALIER_QUERY_NOT_REFITTED) return 84;
    if (espalier_scene_status(&view) != ESPALIER_OPEN_NOT_OPENED || espalier_scene_instance_count(&view) != 0)
        return 85;
    if (espalier_collect_candidate_pairs(scene, NULL, 0, NULL, first).status != ESPALIER_QUERY_NOT_REFITTED) return 86;
    if (espalier_create_moving_scene(block, 10000, CAPACITY, 0, NULL, 0, &view, 1, &other)) return 87;
    espalier_moving_scene_refit(scene);
    if (espalier_collect_candidate_pairs_with_baked(scene, &view, NULL, 0, NULL, begin).status !=
        ESPALIER_QUERY_INVALID_ARGUMENT)
        return 88;
    return espalier_moving_scene_view(scene, &view) == ESPALIER_QUERY_OK ? 0 : 89;
}

/* A copy of a block goes on like the block. */
static int misbehaviour_of_snapshot(espalier_moving_scene* scene, espalier_instance_handle instance) {
    const espalier_transform place = {{0, 0, 0, 1}, {3, 2, 1}, 1};
    unsigned char* copy = aligned(copy_of_memory);
    espalier_moving_scene continued;
    size_t size = 0, mesh_count = 0, tile_count = 0, other_size = 0;
    const void* block = espalier_moving_scene_block(scene, &size);
    const espalier_blob* meshes = espalier_moving_scene_meshes(scene, &mesh_count);
    const espalier_scene* tiles = espalier_moving_scene_tiles(scene, &tile_count);
    if (size == 0 || size > sizeof copy_of_memory - 32) return 90;
    memcpy(copy, block, size);
    if (!espalier_open_moving_scene(copy, size, meshes, mesh_count, tiles, tile_count, &continued)) return 91;
    if (espalier_moving_scene_move(&continued, instance, &place) != ESPALIER_QUERY_OK) return 92;
    if (memcmp(copy, block, size) == 0) return 93;
    if (espalier_moving_scene_move(scene, instance, &place) != ESPALIER_QUERY_OK) return 94;
    if (espalier_moving_scene_block(&continued, &other_size) != copy || other_size != size) return 95;
    if (memcmp(copy, block, size) != 0) return 96;
    if (espalier_open_moving_scene(copy, size - 1, meshes, mesh_count, tiles, tile_count, &continued)) return 97;
    if (misbehaviour_of_empty(&continued) != 0) return 98;
    copy[0] ^= 1u;
    if (espalier_open_moving_scene(copy, size, meshes, mesh_count, tiles, tile_count, &continued)) return 99;
    return 0;
}

int misbehaviour_of_moving_scenes(const espalier_scene* baked) {
    static espalier_moving_scene zero; /* as static storage is */
    espalier_instance instance = {{{0, 0, 0, 1}, {0, 0, 0}, 1}, 0, 1, 0, 0};
    espalier_moving_scene scene;
    size_t mesh_count = 0, tile_count = 0;
    const espalier_blob* meshes = espalier_scene_meshes(baked, &mesh_count);
    const espalier_scene* tiles = espalier_scene_tiles(baked, &tile_count);
    int wrong = misbehaviour_of_empty(&zero);
    if (wrong == 0) wrong = misbehaviour_of_create(meshes, mesh_count);
    if (wrong != 0) return wrong;
    if (mesh_count == 0 || tile_count == 0) return 100;
    memset(&scene, 0xA5, sizeof scene);
    if (!espalier_create_moving_scene(aligned(memory), sizeof memory - 32, CAPACITY, STEP_EXPONENT, meshes, mesh_count,
                                      tiles, tile_count, &scene))
        return 101;
    espalier_instance_handle_result handle = espalier_moving_scene_insert(&scene, &instance);
    if (handle.status != ESPALIER_QUERY_OK) return 102;
    espalier_box around = espalier_moving_scene_box_of(&scene, handle.value).value;
    instance.mesh = (uint32_t)mesh_count; /* the first tile */
    instance.transform.translation.x = 40;
    handle = espalier_moving_scene_insert(&scene, &instance);
    if (handle.status != ESPALIER_QUERY_OK) return 103;
    const espalier_box tile = espalier_moving_scene_box_of(&scene, handle.value).value;
    around.min.y = fminf(around.min.y, tile.min.y);
    around.min.z = fminf(around.min.z, tile.min.z);
    around.max.x = tile.max.x;
    around.max.y = fmaxf(around.max.y, tile.max.y);
    around.max.z = fmaxf(around.max.z, tile.max.z);
    wrong = misbehaviour_of_view(&scene, tiles, around);
    if (wrong == 0) wrong = misbehaviour_of_batch(&scene, handle.value);
    if (wrong == 0) wrong = misbehaviour_of_snapshot(&scene, handle.value);
    return wrong;
}
