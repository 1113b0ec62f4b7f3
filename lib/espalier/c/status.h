/* The outcome of opening a blob and of running a query: found or not, yes or no, how much was written, or why the call
 * was refused. Counterpart of status.hpp. */
#ifndef ESPALIER_C_STATUS_H
#define ESPALIER_C_STATUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The outcome of opening a blob or a scene. */
typedef uint8_t espalier_open_status;
enum {
    ESPALIER_OPEN_OK = 0,
    ESPALIER_OPEN_TOO_SHORT = 1,
    ESPALIER_OPEN_TRAILING_BYTES = 2,
    ESPALIER_OPEN_NOT_A_BLOB = 3,
    ESPALIER_OPEN_UNSUPPORTED_VERSION = 4,
    ESPALIER_OPEN_UNSUPPORTED_PROFILE = 5,
    ESPALIER_OPEN_UNSUPPORTED_FEATURE = 6,
    ESPALIER_OPEN_BAD_HEADER = 7,
    ESPALIER_OPEN_BAD_CHECKSUM = 8,
    ESPALIER_OPEN_BAD_NODE = 9,
    ESPALIER_OPEN_BAD_LEAF = 10,
    ESPALIER_OPEN_BAD_SECTION = 11,
    ESPALIER_OPEN_NOT_OPENED = 12,
    ESPALIER_OPEN_MISALIGNED = 13,
    ESPALIER_OPEN_NOT_A_REMAP = 15,
    ESPALIER_OPEN_OTHER_BLOB = 16,
    ESPALIER_OPEN_NOT_A_SCENE = 17,
    ESPALIER_OPEN_BAD_INSTANCE = 18,
    ESPALIER_OPEN_TOO_FEW_MESHES = 19
};

/* The outcome of a query. Values below 16 mean that the query was answered, at least in part; from 16 on it was refused
 * and computed nothing. There are two exceptions, which process elements one by one and stop at the first that they
 * refuse: espalier_moving_scene_move_batch() and the functions that collect colliding pairs. Their `count` tells how
 * many elements were completed.
 *
 * Structures such as espalier_ray_hit have OK for a hit and NOT_FOUND for a miss. In all other fields a miss and a
 * refusal look alike (infinite t or distance, ESPALIER_NO_TRIANGLE), so test the status to tell them apart. */
typedef uint8_t espalier_query_status;
enum {
    ESPALIER_QUERY_OK = 0,
    ESPALIER_QUERY_NOT_FOUND = 1,
    ESPALIER_QUERY_STOPPED = 2,
    ESPALIER_QUERY_OUTPUT_FULL = 3,
    ESPALIER_QUERY_WORK_LIMIT = 4,
    ESPALIER_QUERY_NOT_OPEN = 16,
    ESPALIER_QUERY_INVALID_ARGUMENT = 17,
    ESPALIER_QUERY_OUT_OF_RANGE = 18,
    ESPALIER_QUERY_NOT_CLOSED = 19,
    ESPALIER_QUERY_NO_DATA = 20,
    ESPALIER_QUERY_NO_ROOM = 21,
    ESPALIER_QUERY_STALE_HANDLE = 22,
    ESPALIER_QUERY_NOT_REFITTED = 23
};

/* A yes, a no, or neither: refused, or undecided because the work limit was reached (ESPALIER_QUERY_WORK_LIMIT, which
 * is not a refusal). Where mistaking "neither" is dangerous, test espalier_no(answer) rather than
 * !espalier_yes(answer). It is a structure so that `if (answer)`, which would take a refusal for a no, does not
 * compile. */
typedef struct ESPALIER_SHARED_ espalier_yes_no {
    espalier_query_status status;
} espalier_yes_no;
/* Returns whether the answer is yes. */
static inline bool espalier_yes(espalier_yes_no answer) { return answer.status == ESPALIER_QUERY_OK; }
/* Returns whether the answer is no. A refusal and an undecided answer are neither yes nor no. */
static inline bool espalier_no(espalier_yes_no answer) { return answer.status == ESPALIER_QUERY_NOT_FOUND; }
/* Returns whether a query was refused. It then computed nothing; a batch or a page completed `count` elements. Takes
 * the status of a query; compare an espalier_open_status with ESPALIER_OPEN_OK instead. */
static inline bool espalier_is_refused(espalier_query_status status) { return status >= 16; }

/* An opaque position in a list of results, from which a query resumes. Filled with zeros, it is the beginning of the
 * list. */
typedef struct ESPALIER_SHARED_ espalier_cursor {
    uint32_t place[3];
} espalier_cursor;

/* The outcome of a query that writes to an array: how many elements it wrote, and where to resume after
 * ESPALIER_QUERY_OUTPUT_FULL or ESPALIER_QUERY_WORK_LIMIT, when elements are missing. */
typedef struct ESPALIER_SHARED_ espalier_filled {
    size_t count;
    espalier_cursor next;
    espalier_query_status status;
} espalier_filled;

/* The value is meaningful only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_float_result {
    float value;
    espalier_query_status status;
} espalier_float_result;

/* Return one English sentence without a full stop. The string is static and never null, even for values that are not
 * listed. */
const char* espalier_describe_open_status(espalier_open_status status);
const char* espalier_describe_query_status(espalier_query_status status);

#ifdef __cplusplus
}
#endif

#endif
