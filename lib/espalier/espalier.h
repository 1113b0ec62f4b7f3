/* The queries for C99, and for whatever speaks C. Each function is the C++ one of the same name: the numbers, arguments
 * and costs that stand in the headers named below hold to the bit, and are not repeated here. Functions that C++
 * overloads end in their shape (espalier_overlaps_box), those that take a filter in _filtered.
 *
 * Values. Structures are plain and hold what their C++ twins hold, field by field. Enumerations are integers of one
 * byte with all their values listed; what visitors answer is an int. A blob is a value too: put it on the stack, into
 * static storage or into a structure of yours, copy it freely, forget it. Filled with zeros it is the empty blob: no
 * triangles, every query finds nothing. One that was refused is empty, too. It is aligned to 16 bytes, as its type
 * says; malloc of small machines aligns to 8.
 *
 * Arguments. Any bit pattern of numbers and enumerations is safe. Pointers are the caller's word: none may be null but
 * `user`, which is passed on, arrays of no elements, and functions: a null filter lets everything count, a null visitor
 * is refused (false or ESPALIER_QUERY_INVALID_ARGUMENT), nothing is asked. Filters and visitors may ask other queries;
 * they must not throw. Results are written where a function's C++ twin writes them, and may not overlap arguments.
 *
 * No heap, no libc, no state, no C++ library: a C compiler links this. Any number of threads may ask. */
#ifndef ESPALIER_ESPALIER_H
#define ESPALIER_ESPALIER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The library is C++ and reads these structures as its own: says so to optimisers that look through both languages. */
#if defined(__GNUC__)
#define ESPALIER_SHARED_ __attribute__((__may_alias__))
#define ESPALIER_BLOB_ __attribute__((__may_alias__, __aligned__(16)))
#else
#define ESPALIER_SHARED_
#define ESPALIER_BLOB_ __declspec(align(16))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version.hpp --------------------------------------------------------------------------------------------------
 */

#define ESPALIER_VERSION "0.1.0"
#define ESPALIER_VERSION_MAJOR 0
#define ESPALIER_VERSION_MINOR 1
#define ESPALIER_VERSION_PATCH 0

/* ---- status.hpp ---------------------------------------------------------------------------------------------------
 */

/* Why a blob was refused. */
typedef uint8_t espalier_status;
enum {
    ESPALIER_STATUS_OK = 0,
    ESPALIER_STATUS_TOO_SHORT = 1,
    ESPALIER_STATUS_TRAILING_BYTES = 2,
    ESPALIER_STATUS_NOT_A_BLOB = 3,
    ESPALIER_STATUS_UNSUPPORTED_VERSION = 4,
    ESPALIER_STATUS_UNSUPPORTED_PROFILE = 5,
    ESPALIER_STATUS_UNSUPPORTED_FEATURE = 6,
    ESPALIER_STATUS_BAD_HEADER = 7,
    ESPALIER_STATUS_BAD_CHECKSUM = 8,
    ESPALIER_STATUS_BAD_NODE = 9,
    ESPALIER_STATUS_BAD_LEAF = 10,
    ESPALIER_STATUS_BAD_SECTION = 11,
    ESPALIER_STATUS_MISALIGNED = 13,
    ESPALIER_STATUS_NOT_A_REMAP = 15,
    ESPALIER_STATUS_OTHER_BLOB = 16
};

/* What a query says that has more to say than yes or no. */
typedef uint8_t espalier_query_status;
enum {
    ESPALIER_QUERY_OK = 0,
    ESPALIER_QUERY_INVALID_ARGUMENT = 1,
    ESPALIER_QUERY_OUT_OF_RANGE = 2,
    ESPALIER_QUERY_NOT_CLOSED = 3,
    ESPALIER_QUERY_HAS_COPIES = 4,
    ESPALIER_QUERY_WORK_LIMIT = 5,
    ESPALIER_QUERY_OUTPUT_FULL = 6,
    ESPALIER_QUERY_NOT_FOUND = 7,
    ESPALIER_QUERY_NOT_OPEN = 8,
    ESPALIER_QUERY_NO_DATA = 9
};

/* One English sentence without a full stop, static, never null: also for values that are not listed. */
const char* espalier_describe_status(espalier_status status);
const char* espalier_describe_query_status(espalier_query_status status);

/* ---- types.hpp, shapes.hpp ----------------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_vec3 {
    float x, y, z;
} espalier_vec3;

/* A triangle of a blob, named by its storage index. */
typedef uint32_t espalier_triangle;
#define ESPALIER_NO_TRIANGLE UINT32_C(0xFFFFFFFF)

/* The part of a triangle that a point lies on. */
typedef uint8_t espalier_feature;
enum {
    ESPALIER_FEATURE_FACE = 0,
    ESPALIER_FEATURE_EDGE_AB = 1,
    ESPALIER_FEATURE_EDGE_BC = 2,
    ESPALIER_FEATURE_EDGE_CA = 3,
    ESPALIER_FEATURE_VERTEX_A = 4,
    ESPALIER_FEATURE_VERTEX_B = 5,
    ESPALIER_FEATURE_VERTEX_C = 6
};

typedef struct ESPALIER_SHARED_ espalier_corners {
    espalier_vec3 a, b, c;
} espalier_corners;

typedef struct ESPALIER_SHARED_ espalier_segment {
    espalier_vec3 from, to;
} espalier_segment;

typedef struct ESPALIER_SHARED_ espalier_sphere {
    espalier_vec3 center;
    float radius;
} espalier_sphere;

typedef struct ESPALIER_SHARED_ espalier_capsule {
    espalier_vec3 from, to;
    float radius;
} espalier_capsule;

typedef struct ESPALIER_SHARED_ espalier_box {
    espalier_vec3 min, max;
} espalier_box;

typedef struct ESPALIER_SHARED_ espalier_oriented_box {
    espalier_vec3 center;
    espalier_vec3 half_axes[3];
} espalier_oriented_box;

typedef struct ESPALIER_SHARED_ espalier_plane {
    espalier_vec3 normal;
    float offset;
} espalier_plane;

/* What a visitor answers: any value but ESPALIER_KEEP_GOING stops. */
typedef int espalier_visit;
enum { ESPALIER_KEEP_GOING = 0, ESPALIER_STOP = 1 };

/* Whether a triangle counts. `user` is what the query was given, here and in all visitors. */
typedef bool (*espalier_triangle_filter)(espalier_triangle triangle, void* user);
typedef espalier_visit (*espalier_triangle_visitor)(espalier_triangle triangle, void* user);

/* ---- blob.hpp -----------------------------------------------------------------------------------------------------
 */

/* Filled with zeros it is empty. What is in it is no promise. */
typedef struct ESPALIER_BLOB_ espalier_blob {
    unsigned char opaque_[sizeof(void*) == 8 ? 192 : 160];
} espalier_blob;

/* `bytes` may be null when `size` is 0. `blob` need not be initialised. At an address that is no multiple of 16 it is
 * refused with ESPALIER_STATUS_MISALIGNED and not written; no other function may be given such an address. */
espalier_status espalier_open(const void* bytes, size_t size, espalier_blob* blob);
/* For bytes that you linked into your own image: believes all but the header. */
espalier_status espalier_open_trusted_image(const void* bytes, size_t size, espalier_blob* blob);

typedef uint8_t espalier_profile;
enum {
    ESPALIER_PROFILE_FAST = 0,
    ESPALIER_PROFILE_BALANCED = 1,
    ESPALIER_PROFILE_SMALL = 2,
    ESPALIER_PROFILE_TINY = 3
};

uint32_t espalier_blob_triangle_count(const espalier_blob* blob);
uint32_t espalier_blob_copy_count(const espalier_blob* blob);
uint32_t espalier_blob_vertex_count(const espalier_blob* blob);
uint32_t espalier_blob_size_bytes(const espalier_blob* blob);
uint32_t espalier_blob_checksum(const espalier_blob* blob);
unsigned espalier_blob_depth(const espalier_blob* blob);
unsigned espalier_blob_bits(const espalier_blob* blob);
espalier_profile espalier_blob_profile(const espalier_blob* blob);
float espalier_blob_step(const espalier_blob* blob);
float espalier_blob_max_error(const espalier_blob* blob);
espalier_vec3 espalier_blob_bounds_min(const espalier_blob* blob);
espalier_vec3 espalier_blob_bounds_max(const espalier_blob* blob);
bool espalier_blob_closed(const espalier_blob* blob);
bool espalier_blob_has_original_ids(const espalier_blob* blob);
bool espalier_blob_has_materials(const espalier_blob* blob);
bool espalier_blob_has_edge_flags(const espalier_blob* blob);

uint16_t espalier_material(const espalier_blob* blob, espalier_triangle triangle);

/* ---- contact.hpp --------------------------------------------------------------------------------------------------
 */

typedef uint8_t espalier_edge_kind;
enum { ESPALIER_EDGE_FLAT = 0, ESPALIER_EDGE_CONVEX = 1, ESPALIER_EDGE_CONCAVE = 2, ESPALIER_EDGE_OPEN = 3 };

typedef struct ESPALIER_SHARED_ espalier_edge_kinds {
    espalier_edge_kind ab, bc, ca;
} espalier_edge_kinds;

bool espalier_get_edge_kinds(const espalier_blob* blob, espalier_triangle triangle, espalier_edge_kinds* kinds);

typedef struct ESPALIER_SHARED_ espalier_contact {
    espalier_triangle triangle;
    espalier_feature feature;
    espalier_vec3 normal;
} espalier_contact;

bool espalier_is_on_inner_edge(const espalier_blob* blob, const espalier_contact* contact, espalier_vec3* normal);

/* ---- bounds.hpp ---------------------------------------------------------------------------------------------------
 */

#define ESPALIER_K_DOP_COUNT 13

typedef struct ESPALIER_SHARED_ espalier_k_dop {
    float lo[ESPALIER_K_DOP_COUNT];
    float hi[ESPALIER_K_DOP_COUNT];
} espalier_k_dop;

extern const espalier_vec3 espalier_k_dop_directions[ESPALIER_K_DOP_COUNT];

bool espalier_bounding_sphere(const espalier_blob* blob, espalier_sphere* sphere);
bool espalier_oriented_bounds(const espalier_blob* blob, espalier_oriented_box* box);
bool espalier_k_dop_bounds(const espalier_blob* blob, espalier_k_dop* k_dop);
bool espalier_is_outside_bounds_sphere(const espalier_blob* blob, const espalier_sphere* sphere);
bool espalier_is_outside_bounds_box(const espalier_blob* blob, const espalier_box* box);

/* ---- ray.hpp ------------------------------------------------------------------------------------------------------
 */

/* Which sides of triangles a ray sees. */
typedef uint8_t espalier_faces;
enum { ESPALIER_FACES_BOTH = 0, ESPALIER_FACES_FRONT = 1, ESPALIER_FACES_BACK = 2 };

typedef struct ESPALIER_SHARED_ espalier_ray {
    espalier_vec3 origin;
    espalier_vec3 direction;
    float t_min;
    float t_max; /* of a ray without an end INFINITY, not 0 */
    espalier_faces faces;
} espalier_ray;

typedef struct ESPALIER_SHARED_ espalier_ray_hit {
    float t, u, v;
    espalier_vec3 normal;
    espalier_triangle triangle;
} espalier_ray_hit;

/* A ray without an end that sees both sides: what the C++ structure has as its defaults. */
espalier_ray espalier_ray_from(espalier_vec3 origin, espalier_vec3 direction);
/* A segment as a ray, t running from 0 to 1. */
espalier_ray espalier_along(const espalier_segment* segment);

bool espalier_raycast(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hit);
bool espalier_raycast_filtered(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hit,
                               espalier_triangle_filter filter, void* user);
bool espalier_occluded(const espalier_blob* blob, const espalier_ray* ray);
bool espalier_occluded_filtered(const espalier_blob* blob, const espalier_ray* ray, espalier_triangle_filter filter,
                                void* user);

typedef struct ESPALIER_SHARED_ espalier_hit_count {
    size_t count;
    espalier_query_status status;
} espalier_hit_count;

/* `hits` has `places`. */
espalier_hit_count espalier_closest_hits(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hits,
                                         size_t places);
espalier_hit_count espalier_closest_hits_filtered(const espalier_blob* blob, const espalier_ray* ray,
                                                  espalier_ray_hit* hits, size_t places,
                                                  espalier_triangle_filter filter, void* user);

/* Both arrays have `count` elements. */
size_t espalier_raycast_batch(const espalier_blob* blob, const espalier_ray* rays, espalier_ray_hit* hits,
                              size_t count);
size_t espalier_occluded_batch(const espalier_blob* blob, const espalier_ray* rays, uint8_t* answers, size_t count);

typedef espalier_visit (*espalier_hit_visitor)(const espalier_ray_hit* hit, void* user);
bool espalier_for_each_hit(const espalier_blob* blob, const espalier_ray* ray, espalier_hit_visitor visit, void* user);

/* ---- original.hpp -------------------------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_original_triangle {
    uint32_t file, mesh, triangle;
    uint32_t first_corner;
} espalier_original_triangle;

bool espalier_get_original_triangle(const espalier_blob* blob, espalier_triangle triangle,
                                    espalier_original_triangle* original);
espalier_query_status espalier_get_original_triangle_batch(const espalier_blob* blob,
                                                           const espalier_triangle* triangles,
                                                           espalier_original_triangle* originals, size_t count);

/* An answer when status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_original_hit {
    uint32_t file, mesh, triangle;
    float u, v;
    espalier_query_status status;
} espalier_original_hit;

espalier_original_hit espalier_get_original_hit(const espalier_blob* blob, const espalier_ray_hit* hit);
espalier_query_status espalier_get_original_hit_batch(const espalier_blob* blob, const espalier_ray_hit* hits,
                                                      espalier_original_hit* originals, size_t count);
/* `remap` has `triangles` entries. */
espalier_original_hit espalier_get_original_hit_by_remap(const espalier_original_triangle* remap, size_t triangles,
                                                         const espalier_ray_hit* hit);

/* `remap` has `triangles` places: as many as the blob has triangles. */
espalier_status espalier_read_remap(const void* file, size_t size, const espalier_blob* blob,
                                    espalier_original_triangle* remap, size_t triangles);

/* ---- overlap.hpp --------------------------------------------------------------------------------------------------
 */

#define ESPALIER_MAX_PLANES 32

bool espalier_overlaps_sphere(const espalier_blob* blob, const espalier_sphere* sphere);
bool espalier_overlaps_capsule(const espalier_blob* blob, const espalier_capsule* capsule);
bool espalier_overlaps_box(const espalier_blob* blob, const espalier_box* box);
bool espalier_overlaps_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box);
bool espalier_overlaps_triangle(const espalier_blob* blob, const espalier_corners* triangle);
bool espalier_overlaps_planes(const espalier_blob* blob, const espalier_plane* planes, size_t plane_count);

bool espalier_for_each_overlap_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                      espalier_triangle_visitor visit, void* user);
bool espalier_for_each_overlap_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                       espalier_triangle_visitor visit, void* user);
bool espalier_for_each_overlap_box(const espalier_blob* blob, const espalier_box* box, espalier_triangle_visitor visit,
                                   void* user);
bool espalier_for_each_overlap_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box,
                                            espalier_triangle_visitor visit, void* user);
bool espalier_for_each_overlap_triangle(const espalier_blob* blob, const espalier_corners* triangle,
                                        espalier_triangle_visitor visit, void* user);
bool espalier_for_each_overlap_planes(const espalier_blob* blob, const espalier_plane* planes, size_t plane_count,
                                      espalier_triangle_visitor visit, void* user);

typedef struct ESPALIER_SHARED_ espalier_overlap_page {
    espalier_query_status status;
    uint32_t count;
    uint32_t next;
} espalier_overlap_page;

/* The page has `places`; `first` is 0, or what the page before had as `next`. */
espalier_overlap_page espalier_collect_overlaps_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                       espalier_triangle* page, size_t places, uint32_t first);
espalier_overlap_page espalier_collect_overlaps_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                        espalier_triangle* page, size_t places, uint32_t first);
espalier_overlap_page espalier_collect_overlaps_box(const espalier_blob* blob, const espalier_box* box,
                                                    espalier_triangle* page, size_t places, uint32_t first);
espalier_overlap_page espalier_collect_overlaps_oriented_box(const espalier_blob* blob,
                                                             const espalier_oriented_box* box, espalier_triangle* page,
                                                             size_t places, uint32_t first);
espalier_overlap_page espalier_collect_overlaps_triangle(const espalier_blob* blob, const espalier_corners* triangle,
                                                         espalier_triangle* page, size_t places, uint32_t first);
espalier_overlap_page espalier_collect_overlaps_planes(const espalier_blob* blob, const espalier_plane* planes,
                                                       size_t plane_count, espalier_triangle* page, size_t places,
                                                       uint32_t first);

/* ---- nearest.hpp, inside.hpp --------------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_nearest {
    espalier_vec3 point;
    float distance;
    float u, v;
    espalier_triangle triangle;
    espalier_feature feature;
} espalier_nearest;

bool espalier_closest_point(const espalier_blob* blob, espalier_vec3 point, float max_distance,
                            espalier_nearest* nearest);
/* `nearest` has `places`. */
size_t espalier_closest_triangles(const espalier_blob* blob, espalier_vec3 point, float max_distance,
                                  espalier_nearest* nearest, size_t places);

typedef struct ESPALIER_SHARED_ espalier_nearest_pair {
    espalier_vec3 on_shape, on_surface;
    float distance;
    float u, v;
    espalier_triangle triangle;
} espalier_nearest_pair;

espalier_query_status espalier_closest_to_segment(const espalier_blob* blob, const espalier_segment* segment,
                                                  float max_distance, espalier_nearest_pair* pair);
espalier_query_status espalier_closest_to_box(const espalier_blob* blob, const espalier_box* box, float max_distance,
                                              espalier_nearest_pair* pair);

espalier_query_status espalier_contains(const espalier_blob* blob, espalier_vec3 point, bool* inside);
espalier_query_status espalier_signed_distance(const espalier_blob* blob, espalier_vec3 point, float max_distance,
                                               espalier_nearest* nearest);

/* ---- rounding.hpp -------------------------------------------------------------------------------------------------
 */

/* The value counts only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_float_result {
    float value;
    espalier_query_status status;
} espalier_float_result;

espalier_float_result espalier_rounding_error_point(const espalier_blob* blob, espalier_vec3 point);
espalier_float_result espalier_rounding_error_ray(const espalier_blob* blob, const espalier_ray* ray);
espalier_float_result espalier_rounding_error_segment(const espalier_blob* blob, const espalier_segment* segment);
espalier_float_result espalier_rounding_error_sphere(const espalier_blob* blob, const espalier_sphere* sphere);
espalier_float_result espalier_rounding_error_capsule(const espalier_blob* blob, const espalier_capsule* capsule);
espalier_float_result espalier_rounding_error_box(const espalier_blob* blob, const espalier_box* box);
espalier_float_result espalier_rounding_error_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box);
espalier_float_result espalier_rounding_error_triangle(const espalier_blob* blob, const espalier_corners* triangle);

/* ---- sweep.hpp ----------------------------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_sweep_hit {
    float t;
    espalier_vec3 point;
    espalier_vec3 normal;
    espalier_triangle triangle;
    bool starts_overlapping;
} espalier_sweep_hit;

bool espalier_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere, espalier_vec3 displacement,
                           espalier_sweep_hit* hit);
bool espalier_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule, espalier_vec3 displacement,
                            espalier_sweep_hit* hit);
bool espalier_sweep_box(const espalier_blob* blob, const espalier_box* box, espalier_vec3 displacement,
                        espalier_sweep_hit* hit);

bool espalier_sweep_sphere_filtered(const espalier_blob* blob, const espalier_sphere* sphere,
                                    espalier_vec3 displacement, espalier_sweep_hit* hit,
                                    espalier_triangle_filter filter, void* user);
bool espalier_sweep_capsule_filtered(const espalier_blob* blob, const espalier_capsule* capsule,
                                     espalier_vec3 displacement, espalier_sweep_hit* hit,
                                     espalier_triangle_filter filter, void* user);
bool espalier_sweep_box_filtered(const espalier_blob* blob, const espalier_box* box, espalier_vec3 displacement,
                                 espalier_sweep_hit* hit, espalier_triangle_filter filter, void* user);

espalier_query_status espalier_check_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                  espalier_vec3 displacement);
espalier_query_status espalier_check_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                   espalier_vec3 displacement);
espalier_query_status espalier_check_sweep_box(const espalier_blob* blob, const espalier_box* box,
                                               espalier_vec3 displacement);

/* ---- collide.hpp --------------------------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_quaternion {
    float x, y, z, w;
} espalier_quaternion;

typedef struct ESPALIER_SHARED_ espalier_placement {
    espalier_quaternion rotation;
    espalier_vec3 translation;
    float scale;
} espalier_placement;

/* Turns, moves and scales nothing: {{0, 0, 0, 1}, {0, 0, 0}, 1}, the defaults of the C++ structure. */
espalier_placement espalier_unplaced(void);

/* As `work_limit`, the pairs of nodes or leaves that a query may visit: all. */
#define ESPALIER_NO_WORK_LIMIT UINT64_MAX

typedef struct ESPALIER_SHARED_ espalier_triangle_pair {
    espalier_triangle a, b;
} espalier_triangle_pair;

espalier_query_status espalier_collides(const espalier_blob* a, const espalier_blob* b,
                                        const espalier_placement* placement, bool* answer, uint64_t work_limit);
espalier_query_status espalier_first_contact(const espalier_blob* a, const espalier_blob* b,
                                             const espalier_placement* placement, espalier_triangle_pair* contact,
                                             bool* found, uint64_t work_limit);

typedef espalier_visit (*espalier_pair_visitor)(const espalier_triangle_pair* contact, void* user);
espalier_query_status espalier_for_each_contact(const espalier_blob* a, const espalier_blob* b,
                                                const espalier_placement* placement, espalier_pair_visitor visit,
                                                void* user, uint64_t work_limit);
/* `contacts` has `places`, of which `count` were filled. */
espalier_query_status espalier_all_contacts(const espalier_blob* a, const espalier_blob* b,
                                            const espalier_placement* placement, espalier_triangle_pair* contacts,
                                            size_t places, size_t* count, uint64_t work_limit);

typedef struct ESPALIER_SHARED_ espalier_pair_distance {
    float distance;
    espalier_vec3 on_a, on_b;
    espalier_triangle_pair pair;
} espalier_pair_distance;

espalier_query_status espalier_minimum_distance(const espalier_blob* a, const espalier_blob* b,
                                                const espalier_placement* placement, float max_distance,
                                                espalier_pair_distance* nearest, bool* found, uint64_t work_limit);
espalier_query_status espalier_within_distance(const espalier_blob* a, const espalier_blob* b,
                                               const espalier_placement* placement, float distance, bool* answer,
                                               uint64_t work_limit);

/* ---- statistics.hpp, approximate.hpp ------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_query_counters {
    uint64_t nodes, leaves, groups, triangles, candidates;
} espalier_query_counters;

bool espalier_raycast_counted(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hit,
                              espalier_query_counters* counters);

/* `counters` may be null in the next four. */
bool espalier_may_overlap_sphere(const espalier_blob* blob, const espalier_sphere* sphere, float accuracy,
                                 espalier_query_counters* counters);
bool espalier_may_overlap_box(const espalier_blob* blob, const espalier_box* box, float accuracy,
                              espalier_query_counters* counters);
bool espalier_may_be_occluded(const espalier_blob* blob, const espalier_ray* ray, float accuracy,
                              espalier_query_counters* counters);

typedef struct ESPALIER_SHARED_ espalier_distance_bounds {
    float lower, upper;
} espalier_distance_bounds;

bool espalier_get_distance_bounds(const espalier_blob* blob, espalier_vec3 point, float max_distance, float accuracy,
                                  espalier_distance_bounds* bounds, espalier_query_counters* counters);

/* ---- walk.hpp -----------------------------------------------------------------------------------------------------
 */

typedef espalier_visit (*espalier_corners_visitor)(espalier_triangle triangle, const espalier_corners* corners,
                                                   void* user);
bool espalier_for_each_triangle(const espalier_blob* blob, espalier_corners_visitor visit, void* user);
bool espalier_triangle_corners(const espalier_blob* blob, espalier_triangle triangle, espalier_corners* corners);

typedef struct ESPALIER_SHARED_ espalier_tree_child {
    espalier_box box;
    bool is_leaf;
    uint32_t node;
    espalier_triangle first;
    uint32_t count;
} espalier_tree_child;

#define ESPALIER_MAX_CHILDREN 16

typedef struct ESPALIER_SHARED_ espalier_tree_node {
    uint32_t number;
    unsigned depth;
    unsigned child_count;
    espalier_tree_child children[ESPALIER_MAX_CHILDREN];
} espalier_tree_node;

/* What a visitor of nodes answers: any value but the first two ends. */
typedef int espalier_node_visit;
enum { ESPALIER_NODE_DESCEND = 0, ESPALIER_NODE_SKIP = 1, ESPALIER_NODE_END = 2 };

typedef espalier_node_visit (*espalier_node_visitor)(const espalier_tree_node* node, void* user);
bool espalier_for_each_node(const espalier_blob* blob, espalier_node_visitor visit, void* user);

/* ---- lattice.hpp --------------------------------------------------------------------------------------------------
 */

typedef struct ESPALIER_SHARED_ espalier_lattice {
    espalier_vec3 origin;
    int32_t step_exponent;
    int32_t extent[3];
} espalier_lattice;

espalier_lattice espalier_lattice_of(const espalier_blob* blob);

typedef struct ESPALIER_SHARED_ espalier_steps {
    int32_t x, y, z;
} espalier_steps;

typedef struct ESPALIER_SHARED_ espalier_box_in_steps {
    espalier_steps min, max;
} espalier_box_in_steps;

typedef struct ESPALIER_SHARED_ espalier_segment_in_steps {
    espalier_steps from, to;
} espalier_segment_in_steps;

#define ESPALIER_MAX_SEGMENT_STEPS (INT32_C(1) << 29)

espalier_query_status espalier_to_steps(const espalier_lattice* lattice, const espalier_vec3* world,
                                        espalier_steps* steps);
espalier_query_status espalier_steps_around(const espalier_lattice* lattice, const espalier_box* world,
                                            espalier_box_in_steps* box);
espalier_vec3 espalier_to_world(const espalier_lattice* lattice, const espalier_steps* steps);

bool espalier_overlaps_box_in_steps(const espalier_blob* blob, const espalier_box_in_steps* box);
bool espalier_for_each_overlap_box_in_steps(const espalier_blob* blob, const espalier_box_in_steps* box,
                                            espalier_triangle_visitor visit, void* user);
espalier_overlap_page espalier_collect_overlaps_box_in_steps(const espalier_blob* blob,
                                                             const espalier_box_in_steps* box, espalier_triangle* page,
                                                             size_t places, uint32_t first);

typedef struct ESPALIER_SHARED_ espalier_hit_in_steps {
    uint32_t t;
    espalier_faces side;
    espalier_triangle triangle;
} espalier_hit_in_steps;

espalier_query_status espalier_first_hit(const espalier_blob* blob, const espalier_segment_in_steps* segment,
                                         espalier_hit_in_steps* hit);
espalier_query_status espalier_any_hit(const espalier_blob* blob, const espalier_segment_in_steps* segment, bool* hit);

/* ---- rounded_ray.hpp ----------------------------------------------------------------------------------------------
 */

/* Filled with zeros it hits nothing. What is in it is no promise. Any bits are safe: invalid_argument for others. */
typedef struct ESPALIER_SHARED_ espalier_rounded_ray {
    uint32_t opaque_[21];
} espalier_rounded_ray;

/* `region` is untouched unless the status is ok. */
espalier_query_status espalier_lattice_of_blobs(const espalier_blob* blobs, size_t count, espalier_lattice* region);
/* The status is that of the rounded ray, which every query of it returns again. */
espalier_query_status espalier_round_ray(const espalier_lattice* region, const espalier_ray* ray,
                                         espalier_rounded_ray* rounded);
espalier_query_status espalier_raycast_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray,
                                               espalier_ray_hit* hit);
espalier_query_status espalier_occluded_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray, bool* hit);

#ifdef __cplusplus
}
#endif

#endif
