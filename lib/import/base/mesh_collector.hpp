// What every importer does with the meshes of a file: numbers, names, materials, limits, the asset's units and axes;
// and files of formats that state neither a unit nor an up axis.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <import/base/importers.hpp>
#include <import/base/placement.hpp>

namespace espalier::importer {

/// Returns how many of a mesh's vertices no triangle names: a file of triangles has them as points.
std::uint64_t unused_vertices(std::size_t vertices, const std::vector<TriangleVertices>& triangles);

/// Gives the file materials of these names, in the order of their numbers.
void set_materials(ImportedFile& file, const std::vector<std::string>& names);

/// Appends the meshes of one file to those of the files before it.
class MeshCollector {
public:
    /// Takes `file` as the next of `imported.files`, where the caller puts it after its last mesh.
    MeshCollector(const ImportOptions& options, ImportedFile& file, ImportResult& imported);

    /// Returns the transform from the file's units and axes to the asset's. `file.metres_per_unit` is final before.
    [[nodiscard]] Placement asset_placement() const;
    /// Returns whether meshes stay in their own space, with a list of places (ImportOptions::keep_places).
    [[nodiscard]] bool keeps_places() const { return options_.keep_places; }
    /// Returns what a reader applies to the positions of a mesh at that place: nothing if places are kept.
    [[nodiscard]] Placement applied(const Placement& placement) const {
        return keeps_places() ? Placement{} : placement;
    }
    /// Throws ImportError (unsupported) when `triangles` more of them exceed what a blob can hold: called before
    /// anything is allocated, since a small file can place one mesh a million times. `words` name their origin. Where
    /// places are kept, a mesh counts once.
    void require_room(std::uint64_t triangles, std::string_view words) const;
    /// Returns a mesh without triangles that has the file's next number. `name` comes from the file, or is empty, and
    /// so is the path of its node. Throws ImportError (unsupported) without room for `triangles`, or for names that
    /// many meshes repeat.
    [[nodiscard]] ImportedMesh begin(std::string_view name, std::uint64_t triangles, std::string_view path = {});
    /// Throws ImportError (unsupported) when `copies` exceed what a file may have where places are not kept: those of
    /// meshes at all their places but the first. A few lines can make millions.
    void require_copies(std::uint64_t copies, std::string_view words) const;
    /// Throws ImportError (unsupported) when `places` more of them exceed what a scene can hold.
    void require_places(std::uint64_t places, std::string_view words) const;
    /// Appends the mesh that begin() returned, to whose positions applied(placement) was applied. `material` is the
    /// number within the file. Returns its index.
    std::uint32_t add(ImportedMesh mesh, std::uint64_t material, const Placement& placement);
    /// Appends the mesh that begin() returned, with a material within the file for each triangle.
    std::uint32_t add(ImportedMesh mesh, const Placement& placement);
    /// Appends a further place of the mesh with that index. `numbered` is what begin() returned for it.
    void add_place(std::uint32_t mesh, const ImportedMesh& numbered, const Placement& placement);

private:
    const ImportOptions& options_;
    ImportedFile& file_;
    ImportResult& imported_;
    std::uint64_t first_material_ = 0;
    std::uint64_t triangles_ = 0;   ///< of the meshes so far, each counted once
    std::uint64_t name_bytes_ = 0;  ///< of the file's meshes so far
    std::uint64_t path_bytes_ = 0;  ///< those of the paths
};

/// The record and the meshes of one file. The unit is the options', else a metre.
class UnitlessFile {
public:
    UnitlessFile(const std::string& path, const char* format, const ImportOptions& options, ImportResult& imported);
    UnitlessFile(const UnitlessFile&) = delete;
    UnitlessFile& operator=(const UnitlessFile&) = delete;

    [[nodiscard]] ImportedFile& record() { return record_; }
    [[nodiscard]] const std::string& path() const { return record_.path; }
    /// Adds a mesh in the file's units and axes. Materials are numbers of the file, one for each triangle, or none:
    /// material 0. Throws ImportError (unsupported) beyond the triangles that a blob can hold.
    void add(const std::string& name, std::vector<Vec3d> positions, std::vector<TriangleVertices> triangles,
             std::vector<std::uint32_t> materials);
    /// Adds a mesh of triangles whose corners come three by three, if there are any.
    void add_triangles(const std::string& name, std::vector<Vec3d> corners);
    /// Leaves out zero bytes at the end of a text, which programs append to fill a block, with a warning.
    void leave_out_zero_bytes(std::string& content);
    /// Appends a warning that begins with the file's name.
    void warn(const char* kind, const std::string& message);
    /// Appends the record to the import, after the last mesh.
    void finish();

private:
    ImportResult& imported_;
    ImportedFile record_;
    MeshCollector meshes_;
};

}  // namespace espalier::importer
