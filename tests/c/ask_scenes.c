#include "asking.h"

/* Every other triangle counts, by another rule in each instance. */
static bool keeps(espalier_instance_id instance, espalier_triangle_id triangle, void* bits) {
    return (instance.index / 2u + instance.in_tile + triangle + *(const uint32_t*)bits) % 2u == 0;
}

static espalier_visit visit_one(struct asking* asking) {
    if (asking->visits == 0) return 17; /* stops, as any value does that is not the other */
    --asking->visits;
    return ESPALIER_VISIT_NEXT;
}

static espalier_visit visit_hit(espalier_instance_id instance, const espalier_ray_hit* hit, void* user) {
    tell_id(user, instance);
    tell_ray_hit(user, hit);
    return visit_one(user);
}

static espalier_visit visit_instance(espalier_instance_id instance, void* user) {
    tell_id(user, instance);
    return visit_one(user);
}

static espalier_visit visit_kept(espalier_instance_id instance, espalier_triangle_id triangle, void* user) {
    tell_id(user, instance);
    tell(user, triangle);
    return visit_one(user);
}

static void tell_instance(struct asking* asking, espalier_instance_id instance) {
    tell_instance_result(asking, espalier_scene_instance_at(asking->scene, instance));
    tell(asking, espalier_scene_is_on_common_lattice(asking->scene, instance).status);
    const espalier_mesh_result mesh = espalier_scene_mesh_at(asking->scene, instance);
    tell(asking, mesh.status);
    tell(asking, espalier_blob_checksum(&mesh.value));
}

static void tell_scene(struct asking* asking) {
    const espalier_scene* scene = asking->scene;
    const espalier_box bounds = espalier_scene_bounds(scene);
    size_t count = 99;
    const espalier_blob* meshes = espalier_scene_meshes(scene, &count);
    tell(asking, espalier_scene_status(scene));
    tell(asking, espalier_scene_instance_count(scene));
    tell(asking, espalier_scene_size(scene));
    tell_float(asking, espalier_scene_max_error(scene));
    tell_point(asking, bounds.min);
    tell_point(asking, bounds.max);
    tell(asking, (uint32_t)count);
    for (size_t i = 0; i < count; ++i) tell(asking, espalier_blob_checksum(&meshes[i]));
    const espalier_scene* tiles = espalier_scene_tiles(scene, &count);
    tell(asking, (uint32_t)count);
    for (size_t i = 0; i < count; ++i) tell(asking, espalier_scene_size(&tiles[i]));
    const espalier_lattice_result common = espalier_scene_common_lattice(scene);
    tell(asking, common.status);
    tell_point(asking, common.value.origin);
    const espalier_instance_id ids[] = {
        {asking->question->bits % (espalier_scene_instance_count(scene) + 1u), ESPALIER_NO_INSTANCE},
        {asking->question->bits % (espalier_scene_instance_count(scene) + 1u), asking->question->bits % 4u},
        {asking->question->bits, ESPALIER_NO_INSTANCE},
        {ESPALIER_NO_INSTANCE, ESPALIER_NO_INSTANCE}};
    for (size_t i = 0; i < sizeof ids / sizeof *ids; ++i) tell_instance(asking, ids[i]);
}

static void tell_hit(struct asking* asking, espalier_scene_ray_hit found) {
    tell_ray_hit(asking, &found.hit);
    tell_id(asking, found.instance);
}

static void tell_nearest(struct asking* asking, espalier_scene_closest_point_result found) {
    tell_closest_point(asking, found.hit);
    tell_id(asking, found.instance);
}

static void tell_contact(struct asking* asking, espalier_scene_sweep_hit found) {
    tell_sweep_hit(asking, found.hit);
    tell_id(asking, found.instance);
}

/* The common lattice; in a scene without one, that of its first mesh. */
static espalier_lattice region_of(const espalier_scene* scene) {
    const espalier_lattice_result common = espalier_scene_common_lattice(scene);
    size_t count = 0;
    const espalier_blob* meshes = espalier_scene_meshes(scene, &count);
    return common.status == ESPALIER_QUERY_OK || count == 0 ? common.value : espalier_blob_lattice(&meshes[0]);
}

static void ask_rays_of(struct asking* asking, uint32_t mask, espalier_scene_filter filter, uint32_t* bits) {
    const struct question* question = asking->question;
    const espalier_scene* scene = asking->scene;
    espalier_ray rays[6];
    espalier_scene_ray_hit hits[6];
    fill_rays(question, rays, 6);
    for (int i = 0; i < 6; ++i) {
        tell_hit(asking, espalier_scene_raycast(scene, &rays[i], mask, filter, bits));
        tell_yes_no(asking, espalier_scene_occluded(scene, &rays[i], mask, filter, bits));
        asking->visits = question->bits % 9u;
        tell(asking, espalier_scene_for_each_hit(scene, &rays[i], visit_hit, asking, mask, filter, bits));
        const espalier_lattice region = region_of(scene);
        const espalier_rounded_ray rounded = espalier_round_ray(&region, &rays[i]);
        tell_hit(asking, espalier_scene_raycast_rounded(scene, &rays[i], &rounded, mask, filter, bits));
        tell_yes_no(asking, espalier_scene_occluded_rounded(scene, &rays[i], &rounded, mask, filter, bits));
        asking->visits = question->bits % 9u;
        tell(asking,
             espalier_scene_for_each_hit_rounded(scene, &rays[i], &rounded, visit_hit, asking, mask, filter, bits));
    }
    memset(hits, 0, sizeof hits);
    tell_filled(asking, espalier_scene_raycast_batch(scene, rays, hits, 6, mask, filter, bits));
    for (int i = 0; i < 6; ++i) tell_hit(asking, hits[i]);
}

/* Two ways of asking about one shape. */
#define ASK(shape, at)                                                                                            \
    do {                                                                                                          \
        tell_yes_no(asking, espalier_scene_overlaps_##shape(asking->scene, at, mask, filter, bits));              \
        asking->visits = asking->question->bits % 9u;                                                             \
        tell(asking,                                                                                              \
             espalier_scene_for_each_overlap_##shape(asking->scene, at, visit_kept, asking, mask, filter, bits)); \
    } while (0)

/* Two ways of sweeping a shape. */
#define SWEEP(shape, at)                                                                                           \
    do {                                                                                                           \
        tell_contact(asking, espalier_scene_sweep_##shape(asking->scene, at, way, mask, filter, bits));            \
        tell_contact(asking, espalier_scene_sweep_##shape##_with_options(asking->scene, at, way, mask, &options)); \
    } while (0)

static void ask_sweeps_of(struct asking* asking, uint32_t mask, espalier_scene_filter filter, uint32_t* bits) {
    const struct question* question = asking->question;
    const struct asked_shapes shapes = shapes_of(question);
    const espalier_vec3 way = question->directions[1];
    espalier_scene_sweep_options options = {0};
    options.filter = filter;
    options.user = bits;
    options.skin = question->lengths[1];
    options.culling = (espalier_face_culling)(question->bits & 3);
    options.ignore_leaving = (question->bits & 8) != 0;
    SWEEP(sphere, &shapes.sphere);
    SWEEP(capsule, &shapes.capsule);
    SWEEP(box, &shapes.box);
    SWEEP(oriented_box, &shapes.oriented_box);
    SWEEP(convex_hull, &shapes.convex_hull);
}

static void ask_shapes_of(struct asking* asking, uint32_t mask, espalier_scene_filter filter, uint32_t* bits) {
    const struct question* question = asking->question;
    const struct asked_shapes shapes = shapes_of(question);
    ASK(sphere, &shapes.sphere);
    ASK(capsule, &shapes.capsule);
    ASK(box, &shapes.box);
    ASK(oriented_box, &shapes.oriented_box);
    ASK(cone, &shapes.cone);
    ASK(triangle, &shapes.triangle);
    ask_sweeps_of(asking, mask, filter, bits);
    tell_nearest(asking, espalier_scene_closest_point(asking->scene, question->points[3], question->lengths[3], mask));
    asking->visits = question->bits % 5u;
    tell(asking, espalier_scene_for_each_candidate(asking->scene, &shapes.box, visit_instance, asking, mask));
}

void ask_scenes(struct asking* asking) {
    tell_scene(asking);
    ask_queries_of_scenes(asking);
}

void ask_queries_of_scenes(struct asking* asking) {
    uint32_t bits = asking->question->bits;
    ask_rays_of(asking, UINT32_MAX, NULL, NULL);
    ask_rays_of(asking, bits % 16u, NULL, NULL);
    ask_rays_of(asking, bits >> 4, keeps, &bits);
    ask_shapes_of(asking, UINT32_MAX, NULL, NULL);
    ask_shapes_of(asking, bits % 16u, NULL, NULL);
    ask_shapes_of(asking, bits >> 4, keeps, &bits);
}

void ask_nothing_of_scenes(struct asking* asking) {
    const espalier_scene* scene = asking->scene;
    const struct asked_shapes shapes = shapes_of(asking->question);
    const espalier_ray ray = espalier_default_ray(asking->question->points[0], asking->question->directions[0]);
    const uint32_t all = UINT32_MAX;
    const espalier_rounded_ray rounded = {0};
    tell(asking, espalier_scene_for_each_hit(scene, &ray, NULL, asking, all, NULL, NULL));
    tell(asking, espalier_scene_for_each_hit_rounded(scene, &ray, &rounded, NULL, asking, all, NULL, NULL));
    tell(asking, espalier_scene_for_each_candidate(scene, &shapes.box, NULL, asking, all));
    tell(asking, espalier_scene_for_each_overlap_sphere(scene, &shapes.sphere, NULL, asking, all, NULL, NULL));
    tell(asking, espalier_scene_for_each_overlap_capsule(scene, &shapes.capsule, NULL, asking, all, NULL, NULL));
    tell(asking, espalier_scene_for_each_overlap_box(scene, &shapes.box, NULL, asking, all, NULL, NULL));
    tell(asking,
         espalier_scene_for_each_overlap_oriented_box(scene, &shapes.oriented_box, NULL, asking, all, NULL, NULL));
    tell(asking, espalier_scene_for_each_overlap_cone(scene, &shapes.cone, NULL, asking, all, NULL, NULL));
    tell(asking, espalier_scene_for_each_overlap_triangle(scene, &shapes.triangle, NULL, asking, all, NULL, NULL));
    tell_filled(asking, espalier_scene_raycast_batch(scene, NULL, NULL, 0, all, NULL, NULL));
}

#define CAPACITY 16

static espalier_blob meshes[CAPACITY];
static espalier_scene tiles[CAPACITY];

static bool is_empty(const espalier_scene* scene) {
    size_t count = 99, tile_count = 99;
    return espalier_scene_meshes(scene, &count) == NULL && count == 0 && espalier_scene_size(scene) == 0 &&
           espalier_scene_tiles(scene, &tile_count) == NULL && tile_count == 0 &&
           espalier_scene_instance_count(scene) == 0;
}

/* Whether of all meshes exactly the first ones are open and the others empty. */
static bool are_open(size_t open) {
    for (size_t i = 0; i < CAPACITY; ++i) {
        const espalier_open_status expected = i < open ? ESPALIER_OPEN_OK : ESPALIER_OPEN_NOT_OPENED;
        if (espalier_blob_status(&meshes[i]) != expected) return false;
    }
    return true;
}

/* Opens into memory that was something else before. */
static espalier_open_status open_anew(const void* bytes, size_t size, size_t capacity, espalier_scene* scene) {
    memset(meshes, 0, sizeof meshes);
    memset(meshes, 0xA5, capacity * sizeof(espalier_blob));
    memset(scene, 0xA5, sizeof *scene);
    return espalier_open_scene(bytes, size, meshes, capacity, tiles, CAPACITY, scene);
}

static bool is_untouched(const void* memory, size_t size) {
    for (size_t i = 0; i < size; ++i)
        if (((const unsigned char*)memory)[i] != 0xA5) return false;
    return true;
}

/* At each address of a 16-byte block, for either of the two places. What is refused writes neither. */
static int misbehaviour_when_misaligned(const void* bytes, size_t size) {
    static espalier_scene room_of_scene[2];
    static espalier_blob room_of_meshes[CAPACITY + 1];
    for (uintptr_t offset = 0; offset < 32; ++offset) {
        espalier_scene* scene = (espalier_scene*)((uintptr_t)room_of_scene + offset % 16u * (offset / 16u));
        espalier_blob* array = (espalier_blob*)((uintptr_t)room_of_meshes + offset % 16u * (1u - offset / 16u));
        const bool is_aligned = offset % 16u == 0;
        memset(room_of_scene, 0xA5, sizeof room_of_scene);
        memset(room_of_meshes, 0xA5, sizeof room_of_meshes);
        if (espalier_open_scene(bytes, size, array, CAPACITY, tiles, CAPACITY, scene) !=
            (is_aligned ? ESPALIER_OPEN_OK : ESPALIER_OPEN_MISALIGNED))
            return 20;
        if (is_aligned) continue;
        if (!is_untouched(room_of_scene, sizeof room_of_scene)) return 21;
        if (!is_untouched(room_of_meshes, sizeof room_of_meshes)) return 22;
    }
    return 0;
}

int misbehaviour_of_open_scene(const void* bytes, size_t size) {
    static espalier_scene zero; /* as static storage is */
    const uint32_t count = espalier_scene_mesh_count(bytes, size);
    espalier_scene scene, copy;
    size_t counted = 0;
    if (!is_empty(&zero) || espalier_scene_status(&zero) != ESPALIER_OPEN_NOT_OPENED) return 1;
    if (count < 2 || count > CAPACITY) return 2;
    if (espalier_scene_mesh_count(bytes, size - 1) != 0 || espalier_scene_mesh_count(NULL, 0) != 0) return 3;
    if (open_anew(bytes, size, count, &scene) != ESPALIER_OPEN_OK || !are_open(count)) return 4;
    copy = scene;
    memset(&scene, 0xA5, sizeof scene);
    if (espalier_scene_status(&copy) != ESPALIER_OPEN_OK || espalier_scene_size(&copy) != size) return 5;
    if (espalier_scene_meshes(&copy, &counted) != meshes || counted == 0 || counted > count) return 6;
    if (open_anew(bytes, size, CAPACITY, &scene) != ESPALIER_OPEN_OK || !are_open(count)) return 7;
    for (size_t capacity = 0; capacity < count; ++capacity) {
        if (open_anew(bytes, size, capacity, &scene) != ESPALIER_OPEN_TOO_FEW_MESHES) return 8;
        if (!is_empty(&scene) || espalier_scene_status(&scene) != ESPALIER_OPEN_TOO_FEW_MESHES) return 9;
        if (!are_open(capacity < counted ? 0 : counted)) return 10; /* those that are not in tiles */
    }
    if (espalier_open_scene(bytes, size, NULL, 0, NULL, 0, &scene) != ESPALIER_OPEN_TOO_FEW_MESHES) return 11;
    if (open_anew(bytes, size - 1, CAPACITY, &scene) != ESPALIER_OPEN_TOO_SHORT || !is_empty(&scene)) return 12;
    if (!are_open(0)) return 13;
    for (size_t i = 0, stated = espalier_scene_tile_count(bytes, size); i < stated; ++i)
        if (espalier_open_scene(bytes, size, meshes, CAPACITY, tiles, i, &scene) != ESPALIER_OPEN_TOO_FEW_MESHES)
            return 15;
    memset(&scene, 0xA5, sizeof scene);
    if (espalier_open_scene(NULL, 0, NULL, 0, NULL, 0, &scene) != ESPALIER_OPEN_TOO_SHORT || !is_empty(&scene))
        return 14;
    return misbehaviour_when_misaligned(bytes, size);
}
