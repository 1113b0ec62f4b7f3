// Volumes against one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "shapes/batches.hpp"

#include <espalier/overlap.hpp>

namespace espalier::python {

namespace {

py::array touching(const HeldBlob& self, const std::string& kind, const py::tuple& given, unsigned threads) {
    return answer_shapes({kind, given, origin_of(self.blob)}, nullptr, py::dtype::of<std::uint8_t>(), threads,
                         [&](const OverlapShape auto& shape, std::size_t) { return overlaps(self.blob, shape); });
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
    return list_for_shapes<TriangleId>(
        {kind, given, origin_of(self.blob)}, nullptr, py::dtype::of<std::uint32_t>(), threads,
        [&](const OverlapShape auto& shape, std::size_t, Growing<TriangleId>& triangles) {
            return append_overlaps(self.blob, shape, triangles);
        });
}

}  // namespace

void bind_overlaps(py::module_& module) {
    module.def("touching", touching);
    module.def("touching_lists", touching_lists);
}

}  // namespace espalier::python
