// The content of a 3MF package: objects of meshes and of other objects, and what is built of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <espalier/bake.hpp>

#include <import/base/importers.hpp>
#include <import/base/placement.hpp>

namespace espalier::importer {

/// An object that stands in another one, or in the build. Objects are numbered in each of the package's models.
struct ThreeMfUse {
    std::string model;  ///< the path of its part in the package
    std::uint32_t id = 0;
    Placement placement;
    std::string words;  ///< name the user in messages: "'gear.3mf', object 3 (gear), component 0"
};

struct ThreeMfObject {
    std::string words;  ///< "'gear.3mf', object 3 (gear)"
    std::string name;
    bool is_other = false;  ///< of type other: no part of what is built
    std::vector<Vec3d> positions;
    std::vector<TriangleVertices> triangles;
    std::vector<std::uint32_t> materials;  ///< one for each triangle: 0 without one
    std::vector<ThreeMfUse> components;
};

/// Returns the path of a part as the archive lists it: references begin with a slash.
inline std::string model_path(std::string_view reference) {
    return std::string(reference.starts_with('/') ? reference.substr(1) : reference);
}

struct ThreeMfPackage {
    std::vector<ThreeMfObject> objects;
    std::map<std::pair<std::string, std::uint32_t>, std::size_t> numbers;  ///< of objects, by model and id
    std::vector<ThreeMfUse> items;                                         ///< of the build
    std::string unit;                                                      ///< empty: none is stated
    double metres_per_unit = 0.001;
    std::uint64_t materials = 1;  ///< those of base materials, from 1 on, and 0
};

/// Reads the package that is a file. Appends to `file` warnings about what changes its geometry and is not read. Throws
/// ImportError: (invalid_input) for a broken package, (unsupported) for one that requires such an extension.
ThreeMfPackage read_3mf_package(const ImportOptions& options, ImportedFile& file);

/// Reads one model of a package, a text of XML: its objects, and those of its build if it `is_root`. Throws as
/// read_3mf_package does.
void read_3mf_model(const std::string& path, std::string_view xml, bool is_root, const ImportOptions& options,
                    ImportedFile& file, ThreeMfPackage& package);

}  // namespace espalier::importer
