#include "unitless_file.hpp"

#include <algorithm>
#include <utility>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

ImportedFile new_record(const std::string& path, const char* format, const ImportOptions& options) {
    ImportedFile record;
    record.path = path;
    record.opened.push_back(path);
    record.format = format;
    record.metres_per_unit = options.metres_per_unit.value_or(1.0);
    record.unit_origin = options.metres_per_unit ? "--unit" : "not stated";
    return record;
}

}  // namespace

UnitlessFile::UnitlessFile(const std::string& path, const char* format, const ImportOptions& options,
                           Imported& imported)
    : imported_(imported), record_(new_record(path, format, options)), meshes_(options, record_, imported) {}

void UnitlessFile::add(const std::string& name, std::vector<Vec3> positions, std::vector<TriangleVertices> triangles,
                       std::vector<std::uint32_t> materials) {
    ImportedMesh mesh = meshes_.begin(name, triangles.size());
    const Placement placement = meshes_.asset_placement();
    const Placement applied = meshes_.applied(placement);
    for (Vec3& position : positions) position = applied(position);
    materials.resize(triangles.size());
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    mesh.materials = std::move(materials);
    meshes_.add(std::move(mesh), placement);
}

void UnitlessFile::warn(const char* kind, const std::string& message) {
    record_.warnings.push_back({kind, text(printable(path()), message), path(), std::nullopt, std::nullopt});
}

void UnitlessFile::finish() {
    record_.materials = std::max<std::uint64_t>(1, record_.materials);
    imported_.files.push_back(std::move(record_));
}

}  // namespace espalier::tools
