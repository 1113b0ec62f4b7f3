// Lookups by triangle or hit: sources, materials, corners.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "floats.hpp"
#include "held_blob.hpp"
#include "parts.hpp"

#include <cstring>
#include <string>

#include <pybind11/numpy.h>

#include <espalier/bake.hpp>
#include <espalier/batches/lookups.hpp>
#include <espalier/original.hpp>

namespace espalier::python {

namespace {

using Ids = py::array_t<std::uint32_t, py::array::c_style>;

/// Calls fill(ids, results) for ranges of the triangles.
template <class Value, class Fill>
py::array look_up(const Ids& ids, const py::dtype& type, unsigned threads, const Fill& fill) {
    py::array results(type, shape_of(ids));
    const std::uint32_t* first = ids.data();
    auto* out = static_cast<Value*>(results.mutable_data());
    run_ranges(static_cast<std::size_t>(ids.size()), threads, [&](std::size_t begin, std::size_t end) {
        fill(Strided<TriangleId>{first + begin, sizeof(TriangleId)}, std::span(out + begin, end - begin));
    });
    return results;
}

py::array original_triangles(const HeldBlob& self, const Ids& ids, unsigned threads) {
    return look_up<Result<OriginalTriangle>>(
        ids, dtype_of("original_triangle"), threads,
        [&](const auto& some, const auto& results) { static_cast<void>(original_triangle(self.blob, some, results)); });
}

py::array materials(const HeldBlob& self, const Ids& ids, unsigned threads) {
    return look_up<std::uint16_t>(
        ids, py::dtype::of<std::uint16_t>(), threads,
        [&](const auto& some, const auto& results) { static_cast<void>(material(self.blob, some, results)); });
}

py::array corners(const HeldBlob& self, const Ids& ids, unsigned threads) {
    return look_up<Result<Triangle>>(ids, dtype_of("corners"), threads, [&](const auto& some, const auto& results) {
        static_cast<void>(triangle_at(self.blob, some, results));
    });
}

/// Returns the corners of all triangles in ascending order, without duplicate references: (n, 3, 3).
py::array all_triangles(const HeldBlob& self) {
    const auto count = static_cast<py::ssize_t>(self.blob.triangle_count() - self.blob.duplicate_reference_count());
    py::array_t<float> results(std::vector<py::ssize_t>{count, 3, 3});
    auto* out = reinterpret_cast<char*>(results.mutable_data());
    const char* const end = out + static_cast<std::size_t>(count) * sizeof(Triangle);
    {
        const py::gil_scoped_release unlocked;
        static_cast<void>(for_each_triangle(self.blob, [&](TriangleId, const Triangle& triangle) {
            if (out == end) return;
            std::memcpy(out, &triangle, sizeof triangle);
            out += sizeof triangle;
        }));
    }
    return results;
}

/// Looks hits up in the blob, or in a remap table if there is one.
py::array original_hits(const HeldBlob& self, const py::array& hits, const py::object& remap, unsigned threads) {
    if (!hits.dtype().equal(dtype_of("ray_hit")) || (hits.flags() & py::array::c_style) == 0)
        throw py::type_error("hits must be a contiguous array that a ray query returned");
    py::array results(dtype_of("original_hit"), shape_of(hits));
    const auto* first = static_cast<const RayHit*>(hits.data());
    auto* out = static_cast<OriginalHit*>(results.mutable_data());
    std::span<const OriginalTriangle> table;
    py::array kept;
    if (!remap.is_none()) {
        kept = py::array::ensure(remap, py::array::c_style);
        if (!kept || !kept.dtype().equal(dtype_of("remap"))) throw py::type_error("remap must be the table of a bake");
        table = {static_cast<const OriginalTriangle*>(kept.data()), static_cast<std::size_t>(kept.size())};
    }
    run_ranges(static_cast<std::size_t>(hits.size()), threads, [&](std::size_t begin, std::size_t end) {
        if (table.empty()) {
            static_cast<void>(
                original_hit(self.blob, std::span(first + begin, end - begin), std::span(out + begin, end - begin)));
        } else {
            for (std::size_t i = begin; i < end; ++i) out[i] = original_hit(table, first[i]);
        }
    });
    return results;
}

/// Returns the table of a remap file, or the number of the refusal.
py::object table_of(const HeldBlob& self, const py::object& file) {
    const auto held = HeldBytes::of(file);
    py::array table(dtype_of("remap"), std::vector<py::ssize_t>{static_cast<py::ssize_t>(self.blob.triangle_count())});
    const OpenStatus status =
        read_remap(held->bytes(), self.blob,
                   std::span(static_cast<OriginalTriangle*>(table.mutable_data()), self.blob.triangle_count()));
    if (status != OpenStatus::ok) return py::int_(static_cast<int>(status));
    return table;
}

/// Returns the bytes of a remap file, which hold the table of the blob's bake.
py::bytes file_of_table(const HeldBlob& self, const py::array& table) {
    if (!table.dtype().equal(dtype_of("remap")) || (table.flags() & py::array::c_style) == 0)
        throw py::type_error("remap must be the table of a bake");
    BakeResult baked;
    baked.status = BakeStatus::ok;
    const auto bytes = self.bytes();
    baked.bytes.assign(bytes.begin(), bytes.end());
    const auto* first = static_cast<const OriginalTriangle*>(table.data());
    baked.remap.assign(first, first + table.size());
    const std::vector<std::byte> file = remap_file(baked);
    return {reinterpret_cast<const char*>(file.data()), file.size()};
}

}  // namespace

void bind_lookups(py::module_& module) {
    module.def("original_triangles", original_triangles);
    module.def("materials", materials);
    module.def("corners", corners);
    module.def("all_triangles", all_triangles);
    module.def("original_hits", original_hits);
    module.def("read_remap", table_of);
    module.def("remap_file", file_of_table);
}

}  // namespace espalier::python
