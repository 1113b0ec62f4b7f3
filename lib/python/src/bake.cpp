// Baking: arrays of NumPy as they lie, by the functions of C, which take any strides and float64.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"

#include <array>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <espalier/c/bake.h>
#include <espalier/original.hpp>

namespace espalier::python {

namespace {

/// Converts where the elements of an array do not lie in one piece or have another type than one of two.
template <class First, class Second>
py::array as_either(const py::object& given, const char* name, bool& is_second) {
    py::array array = py::array::ensure(given);
    if (!array) throw py::type_error(std::string(name) + " is no array of numbers");
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw py::value_error(std::string(name) + " must have the shape (n, 3)");
    is_second = array.dtype().equal(py::dtype::of<Second>());
    const bool is_first = array.dtype().equal(py::dtype::of<First>());
    const auto width = is_second ? sizeof(Second) : sizeof(First);
    const bool packed = array.strides(1) == static_cast<py::ssize_t>(width);
    // The functions of C take rows that do not overlap.
    const py::ssize_t row = array.strides(0) < 0 ? -array.strides(0) : array.strides(0);
    const bool apart = array.shape(0) <= 1 || row >= static_cast<py::ssize_t>(3 * width);
    if (is_second && !(packed && apart)) return py::array_t<Second, py::array::c_style>(array);
    if (is_second || (is_first && packed && apart)) return array;
    return py::array_t<First, py::array::c_style | py::array::forcecast>(array);
}

/// Returns the bytes from row to row: of an array of few rows any that the functions of C take.
std::ptrdiff_t stride_of(const py::array& rows, std::size_t width) {
    return rows.shape(0) > 1 ? rows.strides(0) : static_cast<std::ptrdiff_t>(3 * width);
}

/// The arrays of one mesh while they are read.
struct MeshArrays {
    py::array positions;
    py::array triangles;
    py::array_t<std::uint32_t> materials;
    std::string name;
    espalier_mesh_view view;

    explicit MeshArrays(const py::tuple& mesh) {
        bool is_float64 = false;
        bool is_uint16 = false;
        positions = as_either<float, double>(mesh[0], "positions", is_float64);
        triangles = as_either<std::uint32_t, std::uint16_t>(mesh[1], "triangles", is_uint16);
        name = mesh[3].cast<std::string>();
        espalier_init_mesh_view(&view, sizeof view);
        view.positions = positions.data();
        view.position_count = static_cast<std::size_t>(positions.shape(0));
        view.position_stride = stride_of(positions, is_float64 ? sizeof(double) : sizeof(float));
        view.coordinate_type = is_float64 ? ESPALIER_COORDINATE_FLOAT64 : ESPALIER_COORDINATE_FLOAT32;
        view.triangles = triangles.data();
        view.triangle_count = static_cast<std::size_t>(triangles.shape(0));
        view.triangle_stride = stride_of(triangles, is_uint16 ? sizeof(std::uint16_t) : sizeof(std::uint32_t));
        view.index_type = is_uint16 ? ESPALIER_INDEX_UINT16 : ESPALIER_INDEX_UINT32;
        if (!mesh[2].is_none()) {
            materials = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>(mesh[2]);
            if (materials.ndim() != 1 || materials.shape(0) != triangles.shape(0))
                throw py::value_error("materials must have one number for each triangle");
            view.materials = materials.data();
        }
        view.file = mesh[4].cast<std::uint32_t>();
        view.mesh = mesh[5].cast<std::uint32_t>();
    }
};

/// The poses that the tree of a deformable blob suits.
using Poses = py::array_t<float, py::array::c_style>;

void set_deformation(const py::dict& given, const Poses& poses, espalier_bake_options& options) {
    options.deformable = given["deformable"].cast<bool>();
    if (!given["range"].is_none()) {
        const auto range = given["range"].cast<std::array<float, 6>>();
        options.has_range = 1;
        options.range = {{range[0], range[1], range[2]}, {range[3], range[4], range[5]}};
    }
    options.poses = poses.data();
    options.pose_count = static_cast<std::size_t>(poses.shape(0));
}

espalier_bake_options options_of(const py::dict& given) {
    espalier_bake_options options;
    espalier_init_bake_options(&options, sizeof options);
    options.resolution_kind = given["resolution_kind"].cast<std::uint8_t>();
    options.resolution = given["resolution"].cast<double>();
    options.profile = given["profile"].cast<std::uint8_t>();
    options.effort = given["effort"].cast<std::uint8_t>();
    options.builder = given["builder"].cast<std::uint8_t>();
    options.original_ids = given["original_ids"].cast<bool>();
    options.drop_bad_triangles = given["drop_bad_triangles"].cast<bool>();
    options.max_dropped = given["max_dropped"].cast<double>();
    options.allow_empty = given["allow_empty"].cast<bool>();
    options.strict = given["strict"].cast<bool>();
    options.with_remap = 1;
    options.oriented_box = options.sphere = options.k_dop = given["bounds"].cast<bool>();
    options.flat_angle = given["flat_angle"].is_none() ? -1.0 : given["flat_angle"].cast<double>();
    if (given["origin"].is_none()) {
        options.chooses_origin = 1;
    } else {
        const auto origin = given["origin"].cast<std::array<double, 3>>();
        options.origin = {origin[0], origin[1], origin[2]};
    }
    options.duplicate_budget = given["duplicate_budget"].cast<double>();
    options.byte_price = given["byte_price"].cast<float>();
    options.max_leaf_triangles = given["max_leaf_triangles"].cast<std::uint32_t>();
    options.threads = given["threads"].cast<std::uint32_t>();
    return options;
}

py::object place_of(const espalier_source_place& place) {
    if (place.is_known == 0) return py::none();
    return py::make_tuple(
        place.file, place.mesh,
        place.triangle == ESPALIER_NO_TRIANGLE ? py::object(py::none()) : py::object(py::int_(place.triangle)));
}

py::dict finding_of(const espalier_bake_finding& finding) {
    py::dict result;
    result["count"] = finding.count;
    result["first"] = finding.first;
    result["place"] = place_of(finding.place);
    return result;
}

py::dict report_of(const espalier_bake_report& report) {
    py::dict result;
    result["source_triangles"] = report.source_triangles;
    result["source_vertices"] = report.source_vertices;
    result["equal_corners"] = report.equal_corners;
    result["not_finite"] = finding_of(report.not_finite);
    result["index_out_of_range"] = finding_of(report.index_out_of_range);
    result["zero_area"] = finding_of(report.zero_area);
    result["collapsed"] = finding_of(report.collapsed);
    result["duplicate"] = finding_of(report.duplicate);
    result["extent"] = report.extent;
    result["box_volume"] = report.box_volume;
    result["oriented_box_volume"] = report.oriented_box_volume;
    result["sphere_volume"] = report.sphere_volume;
    result["k_dop_volume"] = report.k_dop_volume;
    result["step"] = report.step;
    result["max_error"] = report.max_error;
    result["origin"] = py::make_tuple(report.origin.x, report.origin.y, report.origin.z);
    result["bits"] = report.bits;
    result["triangles"] = report.triangles;
    result["duplicate_references"] = report.duplicate_references;
    result["vertices"] = report.vertices;
    result["nodes"] = report.nodes;
    result["leaves"] = report.leaves;
    result["depth"] = report.depth;
    result["is_closed"] = report.is_closed != 0;
    result["bits_that_keep_closed"] = report.bits_that_keep_closed;
    result["bytes"] = report.bytes;
    result["seconds"] = report.seconds;
    py::list warnings;
    for (std::size_t i = 0; i < report.warning_count; ++i) warnings.append(report.warnings[i].message);
    result["warnings"] = py::tuple(warnings);
    return result;
}

/// Returns (blob, report, remap), or (status, message, place) of a refusal.
py::tuple bake_meshes(const py::list& given, const py::dict& given_options) {
    std::vector<std::unique_ptr<MeshArrays>> meshes;
    std::vector<espalier_mesh_view> views;
    for (const py::handle mesh : given) {
        meshes.push_back(std::make_unique<MeshArrays>(mesh.cast<py::tuple>()));
        meshes.back()->view.name = meshes.back()->name.c_str();
        views.push_back(meshes.back()->view);
    }
    espalier_bake_options options = options_of(given_options);
    const auto poses = given_options["poses"].cast<Poses>();
    set_deformation(given_options, poses, options);
    const espalier_bake_result* result = nullptr;
    Blob blob;
    {
        const py::gil_scoped_release unlocked;
        result = espalier_bake(views.data(), views.size(), &options);
        if (result->status == ESPALIER_BAKE_OK)
            blob = open({static_cast<const std::byte*>(result->bytes), result->byte_count});
    }
    auto held = HeldBytes::of(result);
    if (result->status != ESPALIER_BAKE_OK)
        return py::make_tuple(static_cast<int>(result->status), result->message, place_of(result->place));
    py::array remap(dtype_of("remap"), std::vector<py::ssize_t>{static_cast<py::ssize_t>(result->remap_count)});
    std::memcpy(remap.mutable_data(), result->remap, result->remap_count * sizeof(OriginalTriangle));
    py::dict report = report_of(*result->report);
    return py::make_tuple(HeldBlob{std::move(held), blob}, report, remap);
}

}  // namespace

void bind_bake(py::module_& module) { module.def("bake", bake_meshes); }

}  // namespace espalier::python
