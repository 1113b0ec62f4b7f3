// What every importer does with the meshes of a file: numbers, names, materials, limits, the asset's units and axes.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/placement.hpp"
#include "imported.hpp"

namespace espalier::tools {

/// Appends the meshes of one file to those of the files before it.
class MeshCollector {
public:
    /// Takes `file` as the next of `imported.files`, where the caller puts it after its last mesh.
    MeshCollector(const ImportOptions& options, ImportedFile& file, Imported& imported);

    /// Returns the transform from the file's units and axes to the asset's. `file.metres_per_unit` is final before.
    [[nodiscard]] Placement asset_placement() const;
    /// Throws CommandError (unsupported) when `triangles` more of them exceed what a blob can hold: called before
    /// anything is allocated, since a small file can place one mesh a million times. `words` name their origin.
    void require_room(std::uint64_t triangles, std::string_view words) const;
    /// Returns a mesh without triangles that has the file's next number. `name` comes from the file, or is empty.
    /// Throws CommandError (unsupported) without room for `triangles`.
    [[nodiscard]] ImportedMesh begin(std::string_view name, std::uint64_t triangles);
    /// Appends the mesh that begin() returned. `material` is the number within the file.
    void add(ImportedMesh mesh, std::uint64_t material);
    /// Appends the mesh that begin() returned, with a material within the file for each triangle.
    void add(ImportedMesh mesh);

private:
    const ImportOptions& options_;
    ImportedFile& file_;
    Imported& imported_;
    std::uint64_t first_material_ = 0;
    std::uint64_t triangles_before_ = 0;
};

}  // namespace espalier::tools
