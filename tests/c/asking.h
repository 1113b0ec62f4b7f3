/* Questions that are asked from C and from C++ alike: each side tells its answers word by word, and both must tell the
 * same words. This side is C99. */
#ifndef ESPALIER_TESTS_ASKING_H
#define ESPALIER_TESTS_ASKING_H

#include <espalier/espalier.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a round of questions is made of: some of it near the asset, some of it hostile. */
struct question {
    espalier_vec3 points[4];
    espalier_vec3 directions[4];
    float lengths[4];
    float rotation[4];
    uint32_t bits; /* for triangles, counts, enumerations */
};

/* One of each shape, from the numbers of a question. */
struct asked_shapes {
    espalier_segment segment;
    espalier_sphere sphere;
    espalier_capsule capsule;
    espalier_box box;
    espalier_oriented_box oriented_box;
    espalier_cone cone;
    espalier_triangle triangle;
    espalier_convex_hull convex_hull; /* of the question's points */
};

static inline struct asked_shapes shapes_of(const struct question* question) {
    const espalier_vec3* points = question->points;
    const espalier_vec3* directions = question->directions;
    const float* lengths = question->lengths;
    const struct asked_shapes shapes = {{points[0], points[1]},
                                        {points[0], lengths[0]},
                                        {points[1], points[2], lengths[1]},
                                        {points[0], points[3]},
                                        {points[1], {directions[0], directions[1], directions[2]}},
                                        {points[2], directions[0], lengths[2]},
                                        {points[0], points[1], points[2]},
                                        {points, question->bits % 5u}};
    return shapes;
}

/* A deformable mesh and the positions of a refit. */
struct asked_refit {
    espalier_deformable* mesh;
    const espalier_vec3* positions;
    size_t count;
};

struct asking {
    const espalier_blob* blob;
    const espalier_blob* other; /* of pairs */
    const espalier_scene* scene;
    espalier_moving_scene* moving;
    const struct question* question;
    void (*tell)(uint32_t word, void* log);
    void* log;
    uint32_t visits; /* left, of visitors */
    const struct asked_refit* refit;
};

/* Fills an array: rays of three kinds, then the same from other places. */
void fill_rays(const struct question* question, espalier_ray* rays, int count);

void ask_lookups(struct asking* asking);
void ask_rays(struct asking* asking);
void ask_volumes(struct asking* asking);
void ask_points(struct asking* asking);
void ask_batches(struct asking* asking);
void ask_sweeps(struct asking* asking);
void ask_pairs(struct asking* asking);
void ask_transforms(struct asking* asking);
void ask_approximations(struct asking* asking);
void ask_walks(struct asking* asking);
void ask_steps(struct asking* asking);
void ask_scenes(struct asking* asking);
/* The queries alone, which take views of moving scenes too. */
void ask_queries_of_scenes(struct asking* asking);
/* Inserts, moves and removes instances, and may leave the scene without a refit. */
void ask_changes(struct asking* asking);
/* The moving scene itself, and queries of it. */
void ask_moving_scenes(struct asking* asking);
/* Pairs of the moving scene with itself and with the baked scene. */
void ask_scene_pairs(struct asking* asking);
/* A deformable mesh itself, and refits of it: one to the positions, and some that are refused. */
void ask_refits(struct asking* asking);
/* Null functions and arrays of no elements. */
void ask_nothing(struct asking* asking);
void ask_nothing_of_scenes(struct asking* asking);

/* The number of what C does otherwise than espalier.h says, 0 when there is nothing. `bytes` are a blob. */
int misbehaviour_of_open(const void* bytes, size_t size);
/* The same of a scene, which has 2 to 16 meshes. */
int misbehaviour_of_open_scene(const void* bytes, size_t size);
/* The same of moving scenes that place the meshes and tiles of a baked one, at least one of each. */
int misbehaviour_of_moving_scenes(const espalier_scene* baked);

/* A deformable blob at any address, the positions that it was baked with and others, and a blob that does not deform.
 */
struct deformable_blob {
    const void* bytes;
    size_t size;
    const espalier_vec3* rest;
    const espalier_vec3* pose;
    uint32_t count;
    const espalier_blob* rigid;
};
/* The number of what deformable meshes do otherwise than deformation.h states. */
int misbehaviour_of_deformables(const struct deformable_blob* blob);
/* The same of moving scenes that place a deformable mesh, whose pose reaches beyond its rest along x. */
int misbehaviour_of_deformables_in_scenes(const struct deformable_blob* blob);

/* The same of the baker, which bakes a cube and stops. */
int misbehaviour_of_baking(void);

static inline void tell(struct asking* asking, uint32_t word) { asking->tell(word, asking->log); }

static inline void tell_yes_no(struct asking* asking, espalier_yes_no answer) { tell(asking, answer.status); }

static inline void tell_float(struct asking* asking, float number) {
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    tell(asking, word);
}

static inline void tell_point(struct asking* asking, espalier_vec3 point) {
    tell_float(asking, point.x);
    tell_float(asking, point.y);
    tell_float(asking, point.z);
}

static inline void tell_ray_hit(struct asking* asking, const espalier_ray_hit* hit) {
    tell_float(asking, hit->t);
    tell_float(asking, hit->u);
    tell_float(asking, hit->v);
    tell_point(asking, hit->normal);
    tell(asking, hit->triangle);
    tell(asking, hit->status);
    tell(asking, hit->side);
}

static inline void tell_closest_point(struct asking* asking, espalier_closest_point_result nearest) {
    tell_point(asking, nearest.point);
    tell_point(asking, nearest.on_shape);
    tell_point(asking, nearest.face_normal);
    tell_float(asking, nearest.distance);
    tell_float(asking, nearest.u);
    tell_float(asking, nearest.v);
    tell(asking, nearest.triangle);
    tell(asking, nearest.status);
    tell(asking, nearest.feature);
    tell(asking, nearest.side);
    tell(asking, nearest.reserved);
}

static inline void tell_sweep_hit(struct asking* asking, espalier_sweep_hit hit) {
    tell_float(asking, hit.t);
    tell_point(asking, hit.point);
    tell_point(asking, hit.normal);
    tell_point(asking, hit.face_normal);
    tell(asking, hit.triangle);
    tell(asking, hit.status);
    tell(asking, hit.feature);
    tell(asking, hit.starts_overlapping);
}

static inline void tell_transform(struct asking* asking, espalier_transform transform) {
    tell_float(asking, transform.rotation.x);
    tell_float(asking, transform.rotation.y);
    tell_float(asking, transform.rotation.z);
    tell_float(asking, transform.rotation.w);
    tell_point(asking, transform.translation);
    tell_float(asking, transform.scale);
}

static inline void tell_counters(struct asking* asking, const espalier_query_counters* counters) {
    tell(asking, (uint32_t)counters->nodes);
    tell(asking, (uint32_t)counters->leaves);
    tell(asking, (uint32_t)counters->groups);
    tell(asking, (uint32_t)counters->triangles);
    tell(asking, (uint32_t)counters->candidates);
}

static inline void tell_original_triangle(struct asking* asking, espalier_original_triangle_result original) {
    tell(asking, original.status);
    tell(asking, original.value.file);
    tell(asking, original.value.mesh);
    tell(asking, original.value.triangle);
    tell(asking, original.value.first_corner);
}

static inline void tell_id(struct asking* asking, espalier_instance_id instance) {
    tell(asking, instance.index);
    tell(asking, instance.in_tile);
}

static inline void tell_instance_result(struct asking* asking, espalier_instance_result result) {
    tell(asking, result.status);
    tell_transform(asking, result.value.transform);
    tell(asking, result.value.mesh);
    tell(asking, result.value.mask);
    tell(asking, result.value.user);
    tell(asking, result.value.source);
}

static inline void tell_filled(struct asking* asking, espalier_filled filled) {
    tell(asking, (uint32_t)filled.count);
    for (int i = 0; i < 3; ++i) tell(asking, filled.next.place[i]);
    tell(asking, filled.status);
}

/* Every other triangle counts. */
bool counts(espalier_triangle_id triangle, void* asking);
/* Tells the triangle and its corners; stops when no visits are left. */
espalier_visit visit_triangle(espalier_triangle_id triangle, const espalier_triangle* corners, void* asking);

#ifdef __cplusplus
}
#endif

#endif
