// Volumes against one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "parts.hpp"
#include "shapes.hpp"

#include <type_traits>

#include <espalier/overlap.hpp>

namespace espalier::python {

namespace {

void check_volume(const std::string& kind) {
    if (kind == "Segment" || kind == "ConvexHull") refuse_shape(kind);
}

py::array touching(const HeldBlob& self, const std::string& kind, const py::tuple& given, unsigned threads) {
    check_volume(kind);
    ShapeFields fields;
    return with_shape(kind, given, fields, [&](const auto& at) -> py::array {
        const Batch batch = spread(fields);
        py::array results = batch.results(py::dtype::of<std::uint8_t>());
        answer_each(static_cast<YesNo*>(results.mutable_data()), batch.count(), threads, [&](std::size_t i) {
            return at(i, [&](const auto& shape) {
                if constexpr (OverlapShape<std::decay_t<decltype(shape)>>) return overlaps(self.blob, shape);
                else return YesNo{};
            });
        });
        return results;
    });
}

/// Appends all triangles that touch a shape, in pages.
template <class Shape>
QueryStatus append_overlaps(const Blob& blob, const Shape& shape, Growing<TriangleId>& triangles) {
    Cursor from;
    for (std::size_t wanted = 64;; wanted *= 2) {
        const Filled filled = collect_overlaps(blob, shape, triangles.places(wanted), from);
        triangles.add(filled.count);
        if (filled.status != QueryStatus::output_full) return filled.status;
        from = filled.next;
    }
}

/// Returns (offsets, triangles, statuses).
py::tuple touching_lists(const HeldBlob& self, const std::string& kind, const py::tuple& given, unsigned threads) {
    check_volume(kind);
    ShapeFields fields;
    return with_shape(kind, given, fields, [&](const auto& at) -> py::tuple {
        const Batch batch = spread(fields);
        return make_lists<TriangleId>(batch, py::dtype::of<std::uint32_t>(), threads,
                                      [&](std::size_t i, Growing<TriangleId>& triangles) {
                                          return at(i, [&](const auto& shape) {
                                              if constexpr (OverlapShape<std::decay_t<decltype(shape)>>)
                                                  return append_overlaps(self.blob, shape, triangles);
                                              else return QueryStatus::invalid_argument;
                                          });
                                      });
    });
}

}  // namespace

void bind_overlaps(py::module_& module) {
    module.def("touching", touching);
    module.def("touching_lists", touching_lists);
}

}  // namespace espalier::python
