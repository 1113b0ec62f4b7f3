/* Queries that count their work. Counterpart of statistics.hpp. */
#ifndef ESPALIER_C_STATISTICS_H
#define ESPALIER_C_STATISTICS_H

#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The work of queries, added up over calls. */
typedef struct ESPALIER_SHARED_ espalier_query_counters {
    uint64_t nodes, leaves, groups, triangles, candidates;
} espalier_query_counters;

/* Returns what espalier_raycast() returns, and adds its work to the counters. */
espalier_ray_hit espalier_raycast_counted(const espalier_blob* blob, const espalier_ray* ray,
                                          espalier_query_counters* counters);

#ifdef __cplusplus
}
#endif

#endif
