/* Baking: turns triangle meshes into one blob. Counterpart of bake.hpp, which has the details of each option.
 *
 * It is a part of espalier::baker and not of the runtime: espalier.h does not include it, and a program that only
 * queries links no baker. A program in C that links it also links the C++ library.
 *
 * Memory. espalier_bake() returns a result, never null. The result and all that it points to are one piece of memory,
 * which espalier_release_bake_result() releases: nothing else is owned. It comes from the callbacks of the options, by
 * default from malloc(). While it works, the baker uses the heap of C++.
 *
 * Arguments. Any number, any value of an enumeration and any array of the stated length is safe. Null is valid for
 * arrays without elements and where stated. No exception leaves a function: what C++ would throw is a status.
 *
 * Versions. The structures that a caller fills in begin with `size`. Functions named espalier_init_ set it and the
 * defaults. The library takes a smaller structure of an older caller, and refuses a larger one. What the library
 * returns may grow at its end.
 *
 * Threads. No call keeps state; any number of threads may bake at once. */
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

/* The type of an index of a vertex. */
typedef uint8_t espalier_index_type;
enum { ESPALIER_INDEX_UINT32 = 0, ESPALIER_INDEX_UINT16 = 1 };

/* One input mesh: MeshView of C++. All arrays may lie at any address. A stride is the number of bytes from one element
 * to the next: at least an element, or negative for an array that runs backwards. */
typedef struct espalier_mesh_view {
    size_t size;           /* of this structure; all meshes of a call have the same */
    const void* positions; /* three coordinates for each vertex, in the source's units */
    size_t position_count;
    ptrdiff_t position_stride;
    const void* triangles; /* three indices of vertices for each, counter-clockwise when seen from the front */
    size_t triangle_count;
    ptrdiff_t triangle_stride;
    const uint32_t* materials; /* one for each triangle, 0..65535; null: material 0 */
    const char* name;          /* for messages; null: none */
    uint32_t file;             /* the number of the input file, for original ids and messages */
    uint32_t mesh;             /* the number of the mesh in that file */
    espalier_coordinate_type coordinate_type;
    espalier_index_type index_type;
} espalier_mesh_view;

/* Makes an empty mesh of packed float32 and 32-bit indices. `size` is sizeof(espalier_mesh_view). */
void espalier_init_mesh_view(espalier_mesh_view* mesh, size_t size);

/* ---- options */

/* The fineness of the lattice on which vertices are rounded, by the meaning of a number: the bits of the largest
 * extent, 1..24; the largest error, a length above 0; or the exponent of the step, a power of two, -100..100. */
typedef uint8_t espalier_resolution;
enum { ESPALIER_RESOLUTION_BITS = 0, ESPALIER_RESOLUTION_TOLERANCE = 1, ESPALIER_RESOLUTION_STEP = 2 };

/* The time that the baker spends on a better tree. */
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

/* Returns `size` bytes, aligned as those of malloc(), or null if there are none. */
typedef void* (*espalier_allocate)(size_t size, void* user);
/* Takes back what espalier_allocate returned, with its size. */
typedef void (*espalier_release)(void* memory, size_t size, void* user);
/* Receives the name of the stage and how much of the whole is done, 0..1. Any result but ESPALIER_VISIT_NEXT ends the
 * bake with ESPALIER_BAKE_STOPPED. Called from the thread that bakes. */
typedef espalier_visit (*espalier_bake_progress)(const char* stage, double done, void* user);

/* The options: BakeOptions of C++. A flag is true unless it is 0. */
typedef struct espalier_bake_options {
    size_t size; /* of this structure */
    double resolution;
    espalier_resolution resolution_kind; /* the meaning of `resolution`: by default 16 bits */
    espalier_profile profile;            /* by default balanced */
    espalier_effort effort;              /* by default normal */
    espalier_builder builder;            /* by default binned_sah; spatial_splits needs the profile fast */
    uint8_t original_ids;                /* a flag: stores the source of each triangle in the blob */
    uint8_t drop_bad_triangles;          /* a flag: drops broken triangles, which else refuse the bake */
    uint8_t allow_empty;                 /* a flag: accepts that no triangle is left, which else refuses the bake */
    uint8_t strict;                      /* a flag: refuses the bake for what else is a warning */
    uint8_t with_remap;                  /* a flag: the result has the source of each triangle */
    uint8_t oriented_box;                /* a flag, as the next two: stores these bounds of the asset */
    uint8_t sphere;
    uint8_t k_dop;
    uint8_t deformable;      /* a flag: bakes a blob whose vertices can move */
    uint8_t has_range;       /* a flag: `range` counts */
    uint8_t chooses_origin;  /* a flag: the baker chooses the origin, not `origin`, where float32 is too coarse */
    espalier_box range;      /* of a deformable blob: the box in which all positions of all poses lie, less `origin` */
    const void* poses;       /* of a deformable blob: poses that its tree suits, packed float32, less `origin` */
    size_t pose_count;       /* a pose has the positions of all meshes in a row */
    double flat_angle;       /* degrees, 0 to less than 90: stores how the surface bends at edges. Negative: does not */
    espalier_vec3d origin;   /* is subtracted from each position, in double, before it is rounded to the lattice */
    double max_dropped;      /* percent of the triangles that may be lost, else the bake is refused; by default 10 */
    double duplicate_budget; /* of spatial_splits: the largest share of triangles that is stored again, 0..1 */
    float byte_price;        /* of one byte per triangle, in visits of a node by an average ray, 0..1000000 */
    uint32_t max_leaf_triangles; /* 1..62 */
    uint32_t threads;            /* 0: as many as the machine has. The bytes do not depend on it */
    espalier_allocate allocate;  /* null, as `release` then: malloc() and free() */
    espalier_release release;
    void* memory_user;               /* is passed to both */
    espalier_bake_progress progress; /* null: none */
    void* progress_user;             /* is passed to it */
} espalier_bake_options;

/* Sets the defaults of C++; of flags 0. `size` is sizeof(espalier_bake_options). */
void espalier_init_bake_options(espalier_bake_options* options, size_t size);

/* ---- results */

/* The result of a bake: ok, or why nothing was baked. */
typedef uint8_t espalier_bake_status;
enum {
    ESPALIER_BAKE_OK = 0,
    ESPALIER_BAKE_INVALID_OPTIONS = 1,
    ESPALIER_BAKE_INVALID_MESH = 2,
    ESPALIER_BAKE_TOO_FINE = 3,
    ESPALIER_BAKE_TOO_LARGE = 4,
    ESPALIER_BAKE_INTERNAL = 5,
    ESPALIER_BAKE_INVALID_ARGUMENT = 16, /* what C++ types exclude: null, a stride, the size of a structure */
    ESPALIER_BAKE_NO_MEMORY = 17,        /* memory is too small for the bake, or the callback returned null */
    ESPALIER_BAKE_STOPPED = 18,          /* the progress callback ended it */
    ESPALIER_BAKE_NOT_SOUND = 19         /* of espalier_verify and espalier_verify_scene */
};

/* A mesh of the input, or a triangle of it; ESPALIER_NO_TRIANGLE if it is about the mesh. Counts only if `is_known`. */
typedef struct espalier_source_place {
    uint32_t file, mesh, triangle;
    uint8_t is_known;
} espalier_source_place;

/* The triangles that were dropped for one reason. */
typedef struct espalier_bake_finding {
    uint64_t count;
    const char* first; /* "level.obj, mesh 3 (walls), triangle 17"; empty if the count is 0 */
    espalier_source_place place;
} espalier_bake_finding;

/* A property of the input or the blob that the baker accepted, but that its caller may not expect. */
typedef uint8_t espalier_bake_warning_kind;
enum {
    ESPALIER_BAKE_WARNING_STEP_BELOW_FLOAT_SPACING = 0,
    ESPALIER_BAKE_WARNING_LOST_CLOSED = 1,
    ESPALIER_BAKE_WARNING_RAYS_ROUNDED_COARSELY = 2
};
typedef struct espalier_bake_warning {
    const char* message; /* whole sentences: what was found, and what to do */
    espalier_bake_warning_kind kind;
} espalier_bake_warning;

/* The figures of a bake: BakeReport of C++, with the same names. Lengths are in the blob's units. */
typedef struct espalier_bake_report {
    uint64_t source_triangles, source_vertices;
    espalier_bake_finding not_finite, index_out_of_range, zero_area, collapsed, duplicate;
    uint64_t equal_corners; /* of zero_area: with two corners in one place, and no surface to lose */
    espalier_vec3 bounds_min, bounds_max;
    double extent; /* the largest side of the bounds */
    double box_volume, oriented_box_volume, sphere_volume, k_dop_volume;
    double step;
    double max_error;      /* between the baked surface and the positions as they were given */
    espalier_vec3d origin; /* that was subtracted from all positions: espalier_blob_source_origin() returns it */
    uint32_t bits;
    uint32_t range_positions; /* of a deformable blob, as the next two: the positions that a refit takes */
    uint64_t moving_bytes;
    espalier_box range;
    uint32_t triangles, duplicate_references, vertices, nodes;
    uint64_t leaves;
    uint32_t depth;
    uint32_t bits_that_keep_closed;
    uint64_t bytes; /* of the blob */
    double seconds;
    const espalier_bake_warning* warnings;
    size_t warning_count;
    uint8_t is_closed;
} espalier_bake_report;

/* The blob, or the reason why there is none. */
typedef struct espalier_bake_result {
    const void* bytes; /* the blob, aligned to 64 bytes; null unless the status is ok */
    size_t byte_count;
    const espalier_original_triangle* remap; /* the source of each triangle, if the options have with_remap */
    size_t remap_count;
    const espalier_bake_report* report; /* never null; all zero unless the status is ok */
    const char* message;                /* never null: what is wrong, where, and what to do; empty if ok */
    espalier_source_place place;        /* the first place with this fault */
    espalier_bake_status status;
} espalier_bake_result;

/* Bakes all meshes into one blob; of null options by the defaults. Equal arguments give equal bytes on every machine,
 * and those that C++ bakes. */
const espalier_bake_result* espalier_bake(const espalier_mesh_view* meshes, size_t mesh_count,
                                          const espalier_bake_options* options);
/* Releases a result and all that it points to. Null does nothing. */
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
        translations;       /* of each instance, in place of that of its transform; null: of the transforms */
    espalier_vec3d origin;  /* is subtracted from each place; the scene keeps it: espalier_scene_source_origin() */
    uint8_t chooses_origin; /* a flag: the baker chooses the origin, not `origin`, where float32 is too coarse */
} espalier_scene_bake_options;

/* Sets the defaults of C++. `size` is sizeof(espalier_scene_bake_options). */
void espalier_init_scene_bake_options(espalier_scene_bake_options* options, size_t size);

/* Joins blobs and instances in one scene, as bake_scene() of scenes/bake.hpp: `mesh` of an instance is an index into
 * `blobs`, and scenes among the blobs become tiles. A transform places the source of a blob, also if that has an
 * origin. Null options are the defaults. The result has the bytes of the scene; of its report only `max_error`,
 * `origin`, `bytes` and the warnings count, the rest is zero. */
const espalier_bake_result* espalier_bake_scene(const espalier_bytes* blobs, size_t blob_count,
                                                const espalier_instance* instances, size_t instance_count,
                                                const espalier_scene_bake_options* options);

/* A blob that espalier_join_borders() changes, and how far it is moved in the world. */
typedef struct espalier_joined_blob {
    void* bytes;
    size_t byte_count;
    espalier_vec3 translation;
} espalier_joined_blob;

/* Gives the edges on the borders of blobs the kind that the surface has where it goes on in another one, as
 * join_borders() of bake.hpp. Sets `edges`, which may be null, to the number of edges that two blobs share now. What is
 * refused changes no blob. The result has no bytes. */
const espalier_bake_result* espalier_join_borders(const espalier_joined_blob* blobs, size_t blob_count,
                                                  uint64_t* edges);

/* Tests whether a blob or a scene is what its header states, as verify() and verify_scene() of C++. The status is
 * ok or ESPALIER_BAKE_NOT_SOUND with the first thing that is wrong; the result has no bytes. Memory: about 60 bytes per
 * triangle. */
const espalier_bake_result* espalier_verify(const void* bytes, size_t byte_count);
const espalier_bake_result* espalier_verify_scene(const void* bytes, size_t byte_count);

/* Returns one English sentence without a full stop: static, never null, also for values that are not listed. */
const char* espalier_describe_bake_status(espalier_bake_status status);

/* Returns the size of a structure of this header in the library, by its name without espalier_, such as "mesh_view"; 0
 * for other names. */
size_t espalier_size_of_baking(const char* name);

#ifdef __cplusplus
}
#endif

#endif
