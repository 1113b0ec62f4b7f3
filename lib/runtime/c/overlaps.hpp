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

/// Defines the functions that test, visit and collect overlaps with a shape; their names end with `name`.
#define ESPALIER_C_OVERLAPS(name, Shape)                                                                             \
    bool espalier_overlaps_##name(const espalier_blob* blob, const Shape* shape) {                                   \
        return overlaps(*twin(blob), *twin(shape));                                                                  \
    }                                                                                                                \
    bool espalier_for_each_overlap_##name(const espalier_blob* blob, const Shape* shape,                             \
                                          espalier_triangle_visitor visit, void* user) {                             \
        return for_each(blob, *twin(shape), visit, user);                                                            \
    }                                                                                                                \
    espalier_overlap_page espalier_collect_overlaps_##name(const espalier_blob* blob, const Shape* shape,            \
                                                           espalier_triangle* page, size_t places, uint32_t first) { \
        return collect(blob, *twin(shape), page, places, first);                                                     \
    }
