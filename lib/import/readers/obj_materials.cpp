#include <import/readers/obj_materials.hpp>

#include <algorithm>
#include <filesystem>

#include <import/base/text_file.hpp>
#include <import/platform/files.hpp>

namespace espalier::importer {

namespace {

/// Empty if no such file exists. Only regular files: a device or pipe could block the bake.
std::string library_path(const std::string& mesh_path, std::string_view name) {
    std::string relative(name);
    std::replace(relative.begin(), relative.end(), '\\', '/');
    const std::filesystem::path path = path_of(mesh_path).parent_path() / path_of(relative);
    std::error_code error;
    return !name.empty() && std::filesystem::is_regular_file(path, error) ? text_of(path) : std::string();
}

}  // namespace

std::uint32_t ObjMaterials::number_of(std::string_view name) {
    const auto known = numbers_.find(name);
    if (known != numbers_.end()) return known->second;
    const auto number = static_cast<std::uint32_t>(count());
    numbers_.emplace(name, number);
    return number;
}

std::vector<std::string> ObjMaterials::names() const {
    std::vector<std::string> result(count());
    for (const auto& [name, number] : numbers_) result[number] = name;
    return result;
}

void ObjMaterials::read_library(const std::string& path) {
    const std::string library = utf8_text(read_bytes(path));
    Lines lines(library);
    for (std::string_view line; lines.next(line);) {
        Words words(line);
        if (words.next() == "newmtl" && !words.rest().empty()) number_of(words.rest());
    }
}

void ObjMaterials::read_libraries(const std::string& mesh_path, std::string_view names,
                                  std::vector<std::string>& opened) {
    std::vector<std::string_view> libraries = {names};  // names with spaces exist, and lists of names
    if (library_path(mesh_path, names).empty()) {
        libraries.clear();
        Words words(names);
        for (std::string_view name = words.next(); !name.empty(); name = words.next()) libraries.push_back(name);
    }
    for (const std::string_view name : libraries) {
        const std::string path = library_path(mesh_path, name);
        if (path.empty() && !first_missing_) first_missing_ = {std::string(name), count()};
        std::error_code error;
        if (path.empty() || !read_.insert(text_of(std::filesystem::canonical(path_of(path), error))).second) continue;
        read_library(path);
        opened.push_back(path);
    }
}

}  // namespace espalier::importer
