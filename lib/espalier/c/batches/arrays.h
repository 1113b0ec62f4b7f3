/* The arrays that batches take and fill, for callers whose numbers already lie in arrays of their own. Counterpart of
 * batches/arrays.hpp.
 *
 * Functions that end in _arrays take a strided array for each argument, such as the origins and the directions of rays;
 * functions that end in _batch take arrays of structures. Both write, bit for bit, what a call for each query would
 * return. All arrays of results have `count` elements unless stated otherwise.
 *
 * A batch refuses null for an array that it needs, if `count` is not 0 (ESPALIER_QUERY_INVALID_ARGUMENT), and then a
 * blob that is not open; it then writes nothing. The status of each single query is part of its result. */
#ifndef ESPALIER_C_BATCHES_ARRAYS_H
#define ESPALIER_C_BATCHES_ARRAYS_H

#include <stddef.h>

#include <espalier/c/attributes.h>
#include <espalier/c/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One argument of a batch for each query. The argument of query i lies i * stride bytes after the first, at any
 * alignment. A stride of 0 repeats one value for all queries, and a negative stride runs backwards. In this array each
 * argument is three floats. */
typedef struct ESPALIER_SHARED_ espalier_strided_vec3 {
    const void* first;
    ptrdiff_t stride;
} espalier_strided_vec3;

/* The same, where each argument is a float. */
typedef struct ESPALIER_SHARED_ espalier_strided_float {
    const void* first;
    ptrdiff_t stride;
} espalier_strided_float;

/* The same, where each argument is an espalier_triangle_id. */
typedef struct ESPALIER_SHARED_ espalier_strided_triangle_id {
    const void* first;
    ptrdiff_t stride;
} espalier_strided_triangle_id;

/* The outcome of a batch that fills lists. All lists lie one after the other in a single array: the list of query i
 * begins at offsets[i] and ends at offsets[i + 1]. `offsets` has count + 1 elements and is never null; the array of
 * elements may be null if `capacity` is 0. Only complete lists are written.
 *
 * After ESPALIER_QUERY_OUTPUT_FULL, call again with the queries from `lists` on and with room for at least `needed`
 * elements. */
typedef struct ESPALIER_SHARED_ espalier_filled_lists {
    size_t lists;  /* number of complete lists: those of the first queries */
    size_t count;  /* number of elements in these lists */
    size_t needed; /* number of elements in the next list; 0 unless the status is ESPALIER_QUERY_OUTPUT_FULL */
    espalier_query_status status;
} espalier_filled_lists;

#ifdef __cplusplus
}
#endif

#endif
