// What the functions of espalier.h about overlaps have in common, for any shape.
#pragma once

#include <runtime/c/twins.hpp>

namespace espalier::detail {

template <class Shape>
bool for_each(const espalier_blob* blob, const Shape& shape, espalier_triangle_visitor visit, void* user) {
    if (visit == nullptr) return false;
    return for_each_overlap(*twin(blob), shape,
                            [=](Triangle triangle) { return visit_answer(visit(triangle.index, user)); });
}

template <class Shape>
espalier_overlap_page collect(const espalier_blob* blob, const Shape& shape, espalier_triangle* page, size_t places,
                              uint32_t first) {
    return twin_value(collect_overlaps(*twin(blob), shape, twins(page, places), first));
}

}  // namespace espalier::detail
