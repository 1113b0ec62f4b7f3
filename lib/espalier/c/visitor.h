/* Functions of yours that queries call: filters and visitors. Counterpart of function_ref.hpp.
 *
 * `user` is the pointer that was passed to the query. The functions may run other queries and must not throw. */
#ifndef ESPALIER_C_VISITOR_H
#define ESPALIER_C_VISITOR_H

#include <stdbool.h>

#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns whether to keep a triangle. The query behaves as if the others were not in the blob. A null filter keeps
 * all. */
typedef bool (*espalier_triangle_filter)(espalier_triangle_id triangle, void* user);

/* Returned by a visitor: any value but ESPALIER_VISIT_NEXT stops. */
typedef int espalier_visit;
enum { ESPALIER_VISIT_NEXT = 0, ESPALIER_VISIT_STOP = 1 };

/* Receives a triangle and its corners. A query refuses a null visitor with ESPALIER_QUERY_INVALID_ARGUMENT. */
typedef espalier_visit (*espalier_triangle_visitor)(espalier_triangle_id triangle, const espalier_triangle* corners,
                                                    void* user);

#ifdef __cplusplus
}
#endif

#endif
