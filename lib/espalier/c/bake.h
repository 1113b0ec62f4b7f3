/* Baking: converts triangle meshes to a blob. Counterpart of bake.hpp, which describes each option in detail.
 *
 * This is part of espalier::baker rather than of the runtime: espalier.h does not include it, and a program that only
 * queries links no baker. A C program that links the baker also links the C++ library.
 *
 * Memory. espalier_bake() returns a result, never null. The result and everything it points to is one piece of memory,
 * which espalier_release_bake_result() releases; the caller owns nothing else. It comes from the callbacks in the
 * options, by default from malloc(). While it works, the baker uses the C++ heap.
 *
 * Arguments. Any number, any value of an enumeration and any array of the stated length is safe. Null is valid for
 * arrays without elements and where stated. No exception leaves a function: what C++ would throw becomes a status.
 *
 * Versions. The structures that a caller fills in begin with `size`, which functions named espalier_init_ set together
 * with the defaults. The library accepts the smaller structure of an older caller and refuses a larger one. Structures
 * that the library returns may grow at their end.
 *
 * Threads. Calls keep no state, so any number of threads may bake at once. */
#ifndef ESPALIER_C_BAKE_H
#define ESPALIER_C_BAKE_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/scene.h>
#include <espalier/c/shapes.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- meshes */

/* The type of a coordinate. */
typedef uint8_t espalier_coordinate_type;
enum { ESPALIER_COORDINATE_FLOAT32 = 0, ESPALIER_COORDINATE_FLOAT64 = 1 };

/* The type of a vertex index. */
typedef uint8_t espalier_index_type;
enum { ESPALIER_INDEX_UINT32 = 0, ESPALIER_INDEX_UINT16 = 1 };

/* One input mesh: MeshView of C++. All arrays may lie at any address. A stride is the number of bytes from one element
 * to the next, which is at least the size of an element, or negative for an array that runs backwards. */
typedef struct espalier_mesh_view {
    size_t size;           /* of this structure; the same for all meshes of a call */
    const void* positions; /* three coordinates per vertex, in the source's units */
    size_t position_count;
    ptrdiff_t position_stride;
    const void* triangles; /* three vertex indices per triangle, counter-clockwise as seen from the front */
    size_t triangle_count;
    ptrdiff_t triangle_stride;
    const uint32_t* materials; /* one per triangle, 0..65535; null: material 0 */
    const char* name;          /* for messages; null: none */
    uint32_t file;             /* number of the input file, for original ids and messages */
    uint32_t mesh;             /* number of the mesh in that file */
    espalier_coordinate_type coordinate_type;
    espalier_index_type index_type;
} espalier_mesh_view;

/* Initialises an empty mesh of packed float32 positions and 32-bit indices. `size` is sizeof(espalier_mesh_view). */
void espalier_init_mesh_view(espalier_mesh_view* mesh, size_t size);

/* ---- options */

/* How finely vertices are rounded to the lattice, given by a number whose meaning is: the bits that the largest extent
 * may take, 1..24; the largest error, a length above 0; or the exponent of the step, a power of two, -100..100. */
typedef uint8_t espalier_resolution;
enum { ESPALIER_RESOLUTION_BITS = 0, ESPALIER_RESOLUTION_TOLERANCE = 1, ESPALIER_RESOLUTION_STEP = 2 };

/* How much time the baker spends on a better tree. */
typedef uint8_t espalier_effort;
enum { ESPALIER_EFFORT_FAST = 0, ESPALIER_EFFORT_NORMAL = 1, ESPALIER_EFFORT_BEST = 2 };

/* The algorithm that builds the binary tree. */
typedef uint8_t espalier_builder;
enum {
    ESPALIER_BUILDER_BINNED_SAH = 0,
    ESPALIER_BUILDER_SWEEP_SAH = 1,
    ESPALIER_BUILDER_SPATIAL_SPLITS = 2,
    ESPALIER_BUILDER_AGGLOMERATIVE = 3,
    ESPALIER_BUILDER_LINEAR = 4,
    ESPALIER_BUILDER_INSERTION = 5
};

/* Returns `size` bytes, aligned like those of malloc(), or null if there is no memory. */
typedef void* (*espalier_allocate)(size_t size, void* user);
/* Takes back what espalier_allocate returned, with its size. */
typedef void (*espalier_release)(void* memory, size_t size, void* user);
/* Receives the name of the stage and the completed fraction of the whole, 0..1, on the thread that bakes. Any result
 * but ESPALIER_VISIT_NEXT ends the bake with ESPALIER_BAKE_STOPPED. */
typedef espalier_visit (*espalier_bake_progress)(const char* stage, double done, void* user);

/* The options: BakeOptions of C++. A flag is true unless it is 0. */
typedef struct espalier_bake_options {
    size_t size; /* of this structure */
    double resolution;
    espalier_resolution resolution_kind; /* the meaning of `resolution`; by default 16 bits */
    espalier_profile profile;            /* by default balanced */
    espalier_effort effort;              /* by default normal */
    espalier_builder builder;            /* by default binned_sah; spatial_splits requires profile fast */
    uint8_t original_ids;                /* a flag: stores the source of each triangle in the blob */
    uint8_t drop_bad_triangles;          /* a flag: drops broken triangles instead of refusing the bake */
    uint8_t allow_empty;                 /* a flag: accepts a bake that leaves no triangle instead of refusing it */
    uint8_t strict;                      /* a flag: refuses the bake where there would only be a warning */
    uint8_t with_remap;                  /* a flag: returns the source of each triangle in the result */
    uint8_t oriented_box;                /* a flag, like the next two: stores these bounds of the asset */
    uint8_t sphere;
    uint8_t k_dop;
    uint8_t deformable;     /* a flag: bakes a blob whose vertices can move */
    uint8_t has_range;      /* a flag: `range` is set */
    uint8_t chooses_origin; /* a flag: the baker chooses the origin instead of `origin`, where float32 is too coarse */
    espalier_box range;     /* of a deformable blob: contains all positions of all poses, minus `origin` */
    const void* poses; /* of a deformable blob: poses for which to optimise the tree, packed float32, minus `origin` */
    size_t pose_count; /* each pose has the positions of all meshes one after the other */
    double flat_angle; /* degrees, 0 to less than 90: stores how the surface bends at edges. Negative: does not */
    espalier_vec3d origin; /* subtracted from each position, in double, before it is rounded to the lattice */
    double max_dropped;    /* percentage of the triangles that may be lost before the bake is refused; by default 10 */
    double duplicate_budget;     /* of spatial_splits: the largest share of triangles that may be stored again, 0..1 */
    float byte_price;            /* of a byte per triangle, in node visits by an average ray, 0..1000000 */
    uint32_t max_leaf_triangles; /* 1..62 */
    uint32_t threads;            /* 0: as many as the machine has. The bytes do not depend on it */
    espalier_allocate allocate;  /* null, together with `release`: malloc() and free() */
    espalier_release release;
    void* memory_user;               /* passed to both */
    espalier_bake_progress progress; /* null: none */
    void* progress_user;             /* passed to `progress` */
} espalier_bake_options;

/* Sets the defaults of C++, and all flags to 0. `size` is sizeof(espalier_bake_options). */
void espalier_init_bake_options(espalier_bake_options* options, size_t size);

/* ---- results */

/* The outcome of a bake: ok, or why nothing was baked. */
typedef uint8_t espalier_bake_status;
enum {
    ESPALIER_BAKE_OK = 0,
    ESPALIER_BAKE_INVALID_OPTIONS = 1,
    ESPALIER_BAKE_INVALID_MESH = 2,
    ESPALIER_BAKE_TOO_FINE = 3,
    ESPALIER_BAKE_TOO_LARGE = 4,
    ESPALIER_BAKE_INTERNAL = 5,
    ESPALIER_BAKE_INVALID_ARGUMENT = 16, /* what C++ types rule out: null, a stride, the size of a structure */
    ESPALIER_BAKE_NO_MEMORY = 17,        /* too little memory for the bake, or the callback returned null */
    ESPALIER_BAKE_STOPPED = 18,          /* the progress callback ended the bake */
    ESPALIER_BAKE_NOT_SOUND = 19         /* from espalier_verify and espalier_verify_scene */
};

/* A mesh of the input or, unless it is ESPALIER_NO_TRIANGLE, a triangle of it. Meaningful only if `is_known`. */
typedef struct espalier_source_place {
    uint32_t file, mesh, triangle;
    uint8_t is_known;
} espalier_source_place;

/* The triangles that were dropped for one reason. */
typedef struct espalier_bake_finding {
    uint64_t count;
    const char* first; /* such as "level.obj, mesh 3 (walls), triangle 17"; empty if the count is 0 */
    espalier_source_place place;
} espalier_bake_finding;

/* A property of the input or the blob that the baker accepted but that may be unexpected. */
typedef uint8_t espalier_bake_warning_kind;
enum {
    ESPALIER_BAKE_WARNING_STEP_BELOW_FLOAT_SPACING = 0,
    ESPALIER_BAKE_WARNING_LOST_CLOSED = 1,
    ESPALIER_BAKE_WARNING_RAYS_ROUNDED_COARSELY = 2
};
typedef struct espalier_bake_warning {
    const char* message; /* whole sentences that say what was found and what to do */
    espalier_bake_warning_kind kind;
} espalier_bake_warning;

/* The figures of a bake: BakeReport of C++, with the same names. Lengths are in the blob's units. */
typedef struct espalier_bake_report {
    uint64_t source_triangles, source_vertices;
    espalier_bake_finding not_finite, index_out_of_range, zero_area, collapsed, duplicate;
    uint64_t equal_corners; /* of zero_area, those with two corners in one place, which had no surface to lose */
    espalier_vec3 bounds_min, bounds_max;
    double extent; /* the largest side of the bounds */
    double box_volume, oriented_box_volume, sphere_volume, k_dop_volume;
    double step;
    double max_error;      /* between the baked surface and the positions as given */
    espalier_vec3d origin; /* subtracted from all positions; espalier_blob_source_origin() returns it */
    uint32_t bits;
    uint32_t range_positions; /* of a deformable blob, like the next two: how many positions a refit takes */
    uint64_t moving_bytes;
    espalier_box range;
    uint32_t triangles, duplicate_references, vertices, nodes;
    uint64_t leaves;
    uint32_t depth;
    uint32_t bits_that_keep_closed;
    uint64_t bytes; /* size of the blob */
    double seconds;
    const espalier_bake_warning* warnings;
    size_t warning_count;
    uint8_t is_closed;
} espalier_bake_report;

/* The blob, or the reason why there is none. */
typedef struct espalier_bake_result {
    const void* bytes; /* the blob, aligned to 64 bytes; null unless the status is ok */
    size_t byte_count;
    const espalier_original_triangle* remap; /* the source of each triangle, if with_remap is set */
    size_t remap_count;
    const espalier_bake_report* report; /* never null; all zero unless the status is ok */
    const char* message;                /* never null: what is wrong, where, and what to do; empty if ok */
    espalier_source_place place;        /* the first place with this fault */
    espalier_bake_status status;
} espalier_bake_result;

/* Bakes all meshes into one blob, with the default options if `options` is null. Equal arguments yield equal bytes on
 * every machine, and the same bytes as in C++. */
const espalier_bake_result* espalier_bake(const espalier_mesh_view* meshes, size_t mesh_count,
                                          const espalier_bake_options* options);
/* Releases a result and everything it points to. Null is ignored. */
void espalier_release_bake_result(const espalier_bake_result* result);

/* ---- scenes, and the deep check */

/* The bytes of a blob or a scene, at any alignment. */
typedef struct espalier_bytes {
    const void* bytes;
    size_t byte_count;
} espalier_bytes;

/* The options of a scene: SceneBakeOptions of C++. */
typedef struct espalier_scene_bake_options {
    size_t size; /* of this structure */
    const espalier_vec3d*
        translations;       /* one per instance, replacing that of its transform; null: those of the transforms */
    espalier_vec3d origin;  /* subtracted from each position; the scene stores it: espalier_scene_source_origin() */
    uint8_t chooses_origin; /* a flag: the baker chooses the origin instead of `origin`, where float32 is too coarse */
} espalier_scene_bake_options;

/* Sets the defaults of C++. `size` is sizeof(espalier_scene_bake_options). */
void espalier_init_scene_bake_options(espalier_scene_bake_options* options, size_t size);

/* Joins blobs and instances into a scene, like bake_scene() of scenes/bake.hpp. `mesh` of an instance is an index into
 * `blobs`, and scenes among the blobs become tiles. A transform places the source of a blob, even if the blob has an
 * origin. Null options are the defaults. The result has the bytes of the scene; in its report only `max_error`,
 * `origin`, `bytes` and the warnings are set, and the rest is zero. */
const espalier_bake_result* espalier_bake_scene(const espalier_bytes* blobs, size_t blob_count,
                                                const espalier_instance* instances, size_t instance_count,
                                                const espalier_scene_bake_options* options);

/* A blob for espalier_join_borders() to change, and its translation in the world. */
typedef struct espalier_joined_blob {
    void* bytes;
    size_t byte_count;
    espalier_vec3 translation;
} espalier_joined_blob;

/* Joins edges on the borders of blobs, like join_borders() of bake.hpp: each border edge gets the kind that the surface
 * has where it continues in another blob. Sets `edges`, which may be null, to the number of edges that two blobs share
 * now. A refusal changes no blob. The result has no bytes. */
const espalier_bake_result* espalier_join_borders(const espalier_joined_blob* blobs, size_t blob_count,
                                                  uint64_t* edges);

/* Check whether a blob or a scene is what its header states, like verify() and verify_scene() of C++. The status is ok,
 * or ESPALIER_BAKE_NOT_SOUND with the first thing that is wrong; the result has no bytes. Takes about 60 bytes of
 * memory per triangle. */
const espalier_bake_result* espalier_verify(const void* bytes, size_t byte_count);
const espalier_bake_result* espalier_verify_scene(const void* bytes, size_t byte_count);

/* Returns one English sentence without a full stop. The string is static and never null, even for values that are not
 * listed. */
const char* espalier_describe_bake_status(espalier_bake_status status);

/* Returns the size of a structure of this header in the library, by its name without espalier_, such as "mesh_view",
 * and 0 for other names. */
size_t espalier_size_of_baking(const char* name);

#ifdef __cplusplus
}
#endif

#endif
