// A mesh file of a format that states neither a unit nor an up axis, on its way into an import.
#pragma once

#include <string>
#include <vector>

#include "imported.hpp"
#include "mesh_collector.hpp"

namespace espalier::tools {

/// The record and the meshes of one file. The unit is the options', else a metre.
class UnitlessFile {
public:
    UnitlessFile(const std::string& path, const char* format, const ImportOptions& options, Imported& imported);
    UnitlessFile(const UnitlessFile&) = delete;
    UnitlessFile& operator=(const UnitlessFile&) = delete;

    [[nodiscard]] ImportedFile& record() { return record_; }
    [[nodiscard]] const std::string& path() const { return record_.path; }
    /// Adds a mesh in the file's units and axes. Materials are numbers of the file, one for each triangle, or none:
    /// material 0. Throws CommandError (unsupported) beyond the triangles that a blob can hold.
    void add(const std::string& name, std::vector<Vec3> positions, std::vector<TriangleVertices> triangles,
             std::vector<std::uint32_t> materials);
    /// Appends a warning that begins with the file's name.
    void warn(const char* kind, const std::string& message);
    /// Appends the record to the import, after the last mesh.
    void finish();

private:
    Imported& imported_;
    ImportedFile record_;
    MeshCollector meshes_;
};

}  // namespace espalier::tools
