#include "asking.h"

static espalier_node_visit visit_node(const espalier_tree_node* node, void* user) {
    struct asking* asking = user;
    tell(asking, node->number);
    tell(asking, node->depth);
    tell(asking, node->child_count);
    for (unsigned i = 0; i < node->child_count; ++i) {
        const espalier_tree_child* child = &node->children[i];
        tell_point(asking, child->box.min);
        tell_point(asking, child->box.max);
        tell(asking, child->is_leaf);
        tell(asking, child->node);
        tell(asking, child->first);
        tell(asking, child->count);
    }
    if (asking->visits-- == 0) return 99; /* stops, as any value does that is not one of the others */
    return node->number % 3u == 2u ? ESPALIER_NODE_SKIP : ESPALIER_NODE_DESCEND;
}

void ask_walks(struct asking* asking) {
    asking->visits = asking->question->bits % 200u;
    tell(asking, espalier_for_each_triangle(asking->blob, visit_triangle, asking));
    asking->visits = asking->question->bits % 30u;
    tell(asking, espalier_for_each_node(asking->blob, visit_node, asking));
}
