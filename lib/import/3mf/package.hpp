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

/// An object that stands in another one, or in the build. Objects have numbers of their own in each of the package's
/// models.
struct ThreeMfUse {
    std::size_t model = 0;  ///< in ThreeMfPackage::models
    std::uint32_t id = 0;
    Placement placement;
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
    std::vector<std::string> models;                   ///< their paths, in the order in which they are first named
    std::map<std::string, std::size_t> model_numbers;  ///< in `models`, by the archive's keys of their paths
    std::vector<ThreeMfObject> objects;
    std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> numbers;  ///< of objects, by model and id
    std::vector<ThreeMfUse> items;                                         ///< of the build
    std::string unit;                                                      ///< empty: none is stated
    double metres_per_unit = 0.001;
    std::vector<std::string> materials = {""};  ///< the names of base materials, from 1 on, and of 0, which is none

    /// Returns the number of a model, which may not be read yet.
    std::size_t model_number(std::string_view reference);
};

/// Reads the package that is a file. Appends to `file` warnings about what changes its geometry and is not read. Throws
/// ImportError: (invalid_input) for a broken package, (unsupported) for one that requires such an extension.
ThreeMfPackage read_3mf_package(const ImportOptions& options, ImportedFile& file);

/// Reads the model with that number in a package, a text of XML: its objects, and the build if it is the first. Throws
/// as read_3mf_package does.
void read_3mf_model(std::size_t model, std::string_view xml, const ImportOptions& options, ImportedFile& file,
                    ThreeMfPackage& package);

}  // namespace espalier::importer
