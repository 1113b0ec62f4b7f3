// Which number a material of an OBJ file has.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::importer {

/// Material 0 is that of faces before the first usemtl. The others are numbered from 1 in the order in which newmtl in
/// a library or, for those without, usemtl names them first.
class ObjMaterials {
public:
    struct MissingLibrary {
        std::string name;
        std::uint64_t first_changed;  ///< materials from this number on would have others with the library
    };

    /// Reads the libraries that a mtllib line names, relative to the folder of the mesh, and appends those that exist
    /// to `opened`. A missing library changes numbers, and no triangle.
    void read_libraries(const std::string& mesh_path, std::string_view names, std::vector<std::string>& opened);
    std::uint32_t number_of(std::string_view name);
    [[nodiscard]] std::uint64_t count() const { return numbers_.size() + 1; }
    /// Returns all names in the order of the numbers.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] const std::optional<MissingLibrary>& first_missing() const { return first_missing_; }

private:
    void read_library(const std::string& path);

    std::set<std::string> read_;  // libraries, by their paths without ".", ".." and links
    std::optional<MissingLibrary> first_missing_;
    std::map<std::string, std::uint32_t, std::less<>> numbers_;
};

}  // namespace espalier::importer
