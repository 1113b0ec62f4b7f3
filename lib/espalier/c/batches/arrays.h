/* The arrays that batches take and fill, for callers whose numbers already lie in arrays of their own. Counterpart of
 * batches/arrays.hpp.
 *
 * Functions that end in _arrays take strided arrays: one for each argument, such as the origins and the directions of
 * rays. Those that end in _batch take arrays of structures. Both write the results of one call for each query, bit for
 * bit, and all arrays of results have `count` elements, unless stated otherwise.
 *
 * A batch refuses, and then writes nothing: null for arrays that it needs, if `count` is not 0, with
 * ESPALIER_QUERY_INVALID_ARGUMENT; then a blob that is not open. The statuses of single queries are in their
 * results. */
#ifndef ESPALIER_C_BATCHES_ARRAYS_H
#define ESPALIER_C_BATCHES_ARRAYS_H

#include <stddef.h>

#include <espalier/c/attributes.h>
#include <espalier/c/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The arguments of a batch, one for each query: that of query i lies i * stride bytes after the first, at any
 * alignment. A stride of 0 gives all queries the same; a negative one runs backwards. These are three floats each. */
typedef struct ESPALIER_SHARED_ espalier_strided_vec3 {
    const void* first;
    ptrdiff_t stride;
} espalier_strided_vec3;

/* The same of a float each. */
typedef struct ESPALIER_SHARED_ espalier_strided_float {
    const void* first;
    ptrdiff_t stride;
} espalier_strided_float;

/* The same of an espalier_triangle_id each. */
typedef struct ESPALIER_SHARED_ espalier_strided_triangle_id {
    const void* first;
    ptrdiff_t stride;
} espalier_strided_triangle_id;

/* The result of a batch that fills lists. All lists lie in one array, one after the other: that of query i begins at
 * offsets[i] and ends at offsets[i + 1]. `offsets` has count + 1 elements and is never null; the array of elements may
 * be null if `capacity` is 0. Only whole lists are written.
 *
 * After ESPALIER_QUERY_OUTPUT_FULL, call again with the queries from `lists` on, and an array with at least `needed`
 * elements. */
typedef struct ESPALIER_SHARED_ espalier_filled_lists {
    size_t lists;  /* that are complete: those of the first queries */
    size_t count;  /* elements in them */
    size_t needed; /* places that the next list takes; 0 unless the status is ESPALIER_QUERY_OUTPUT_FULL */
    espalier_query_status status;
} espalier_filled_lists;

#ifdef __cplusplus
}
#endif

#endif
