// espalier.h: walking over what a blob holds.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

NodeVisit node_answer(espalier_node_visit answer) {
    switch (answer) {
        case ESPALIER_NODE_DESCEND:
            return NodeVisit::descend;
        case ESPALIER_NODE_SKIP:
            return NodeVisit::skip;
        default:
            return NodeVisit::end;
    }
}

}  // namespace

extern "C" {

bool espalier_for_each_triangle(const espalier_blob* blob, espalier_corners_visitor visit, void* user) {
    if (visit == nullptr) return false;
    return for_each_triangle(*twin(blob), [=](Triangle triangle, const Corners& corners) {
        return visit_answer(visit(triangle.index, twin(&corners), user));
    });
}

bool espalier_triangle_corners(const espalier_blob* blob, espalier_triangle triangle, espalier_corners* corners) {
    return triangle_corners(*twin(blob), {triangle}, *twin(corners));
}

bool espalier_for_each_node(const espalier_blob* blob, espalier_node_visitor visit, void* user) {
    if (visit == nullptr) return false;
    return for_each_node(*twin(blob), [=](const TreeNode& node) { return node_answer(visit(twin(&node), user)); });
}

}  // extern "C"
