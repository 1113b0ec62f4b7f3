// The extension module espalier._import: mesh files to arrays. A module of its own, since its libraries may be missing
// where the rest of the package runs.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <espalier/import.hpp>

namespace py = pybind11;

namespace espalier::python {

namespace {

/// An array of the elements that `owner` keeps, which is not copied.
template <class Number, class Elements>
py::array array_of(Elements& elements, py::ssize_t columns, const py::capsule& owner) {
    const auto rows = static_cast<py::ssize_t>(elements.size());
    auto* const first = reinterpret_cast<Number*>(elements.data());
    if (columns == 1) return py::array_t<Number>(rows, first, owner);
    return py::array_t<Number>(std::vector<py::ssize_t>{rows, columns}, first, owner);
}

/// Returns the text with U+FFFD in the place of bytes that are no UTF-8, which words and names out of a file may have.
py::str text_of(const std::string& bytes) {
    PyObject* const text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace");
    if (text == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(text);
}

/// Returns (positions, triangles, materials or None, name, file, mesh).
py::tuple mesh_of(ImportedMesh&& imported, bool has_materials) {
    auto* const mesh = new ImportedMesh(std::move(imported));
    const py::capsule owner(mesh, [](void* kept) { delete static_cast<ImportedMesh*>(kept); });
    py::object materials = py::none();
    if (has_materials) materials = array_of<std::uint32_t>(mesh->materials, 1, owner);
    return py::make_tuple(array_of<double>(mesh->positions, 3, owner),
                          array_of<std::uint32_t>(mesh->triangles, 3, owner), materials, text_of(mesh->name),
                          mesh->file, mesh->mesh);
}

/// Returns (kind, message, file, mesh, triangle).
py::tuple tuple_of(const ImportDiagnostic& diagnostic) {
    return py::make_tuple(diagnostic.kind, text_of(diagnostic.message), diagnostic.file, diagnostic.mesh,
                          diagnostic.triangle);
}

py::dict file_of(const ImportedFile& imported) {
    py::dict file;
    file["path"] = imported.path;
    file["opened"] = imported.opened;
    file["format"] = imported.format;
    file["mesh_names"] = imported.mesh_names;
    file["mesh_paths"] = imported.mesh_paths;
    file["material_names"] = imported.material_names;
    file["triangles"] = imported.triangles;
    file["materials"] = imported.materials;
    file["points_and_lines"] = imported.points_and_lines;
    file["metres_per_unit"] = imported.metres_per_unit;
    file["unit_origin"] = imported.unit_origin;
    py::list warnings;
    for (const ImportDiagnostic& warning : imported.warnings) warnings.append(tuple_of(warning));
    file["warnings"] = warnings;
    return file;
}

ImportOptions options_of(const py::dict& given) {
    ImportOptions options;
    options.format = given["format"].cast<std::string>();
    options.metres_per_unit = given["metres_per_unit"].cast<std::optional<double>>();
    options.scale = given["scale"].cast<double>();
    if (const auto up = given["up"].cast<std::optional<unsigned>>()) options.up = static_cast<Axis>(*up);
    options.materials = given["materials"].cast<bool>();
    options.keep_vertices = given["keep_vertices"].cast<bool>();
    options.require_vertices = given["require_vertices"].cast<bool>();
    options.separate_process = given["separate_process"].cast<bool>();
    options.limits.memory = given["memory"].cast<std::uint64_t>();
    options.limits.seconds = given["seconds"].cast<double>();
    return options;
}

/// Returns (status, reason, meshes, files).
py::tuple read(const std::vector<std::string>& paths, const py::dict& given) {
    const ImportOptions options = options_of(given);
    ImportResult imported;
    {
        const py::gil_scoped_release unlocked;
        imported = import_meshes(paths, options);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();  // a child ends by an interrupt, too
    py::list meshes;
    for (ImportedMesh& mesh : imported.meshes) meshes.append(mesh_of(std::move(mesh), options.materials));
    py::list files;
    for (const ImportedFile& file : imported.files) files.append(file_of(file));
    return py::make_tuple(static_cast<int>(imported.status), tuple_of(imported.reason), meshes, files);
}

}  // namespace

}  // namespace espalier::python

PYBIND11_MODULE(_import, module) {
    module.doc() = "The compiled reader of mesh files. Its functions may change; use those of the package.";
    module.def("read", espalier::python::read);
    module.def("default_memory", espalier::default_import_memory);
}
