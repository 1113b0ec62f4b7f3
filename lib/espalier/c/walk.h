/* Walks over the contents of a blob: its triangles and the nodes of its tree. Counterpart of walk.hpp. */
#ifndef ESPALIER_C_WALK_H
#define ESPALIER_C_WALK_H

#include <stdbool.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Visits every triangle once, until the visitor stops. */
espalier_query_status espalier_for_each_triangle(const espalier_blob* blob, espalier_triangle_visitor visit,
                                                 void* user);

typedef struct ESPALIER_SHARED_ espalier_triangle_result {
    espalier_triangle value;
    espalier_query_status status;
} espalier_triangle_result;

/* Returns the corners of one triangle. */
espalier_triangle_result espalier_triangle_at(const espalier_blob* blob, espalier_triangle_id triangle);

/* A child of a node: another node, or a leaf, which is a range of triangles. */
typedef struct ESPALIER_SHARED_ espalier_tree_child {
    espalier_box box;
    bool is_leaf;
    uint32_t node;
    espalier_triangle_id first;
    uint32_t count;
} espalier_tree_child;

#define ESPALIER_MAX_CHILDREN 16

/* A node of the tree. */
typedef struct ESPALIER_SHARED_ espalier_tree_node {
    uint32_t number;
    unsigned depth;
    unsigned child_count;
    espalier_tree_child children[ESPALIER_MAX_CHILDREN];
} espalier_tree_node;

/* Returned by a visitor of nodes: any value but the first two stops. */
typedef int espalier_node_visit;
enum { ESPALIER_NODE_DESCEND = 0, ESPALIER_NODE_SKIP = 1, ESPALIER_NODE_STOP = 2 };

typedef espalier_node_visit (*espalier_node_visitor)(const espalier_tree_node* node, void* user);
/* Visits the nodes of the tree, parents before their children. */
espalier_query_status espalier_for_each_node(const espalier_blob* blob, espalier_node_visitor visit, void* user);

#ifdef __cplusplus
}
#endif

#endif
