// espalier/c/walk.h: walks over the contents of a blob.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

espalier_query_status espalier_for_each_triangle(const espalier_blob* blob, espalier_triangle_visitor visit,
                                                 void* user) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(for_each_triangle(cpp(blob), visitor(visit, user)));
}

espalier_triangle_result espalier_triangle_at(const espalier_blob* blob, espalier_triangle_id triangle) {
    return c(triangle_at(cpp(blob), cpp(triangle)));
}

espalier_query_status espalier_for_each_node(const espalier_blob* blob, espalier_node_visitor visit, void* user) {
    if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;
    return c(for_each_node(cpp(blob), visitor<espalier::NodeVisit>(visit, user)));
}
