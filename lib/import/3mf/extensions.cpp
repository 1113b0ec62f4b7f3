#include <import/3mf/extensions.hpp>

#include <algorithm>
#include <utility>

#include <import/base/error.hpp>

namespace espalier::importer {

namespace {

/// Parts of their namespaces, which end with a year and a month.
constexpr std::pair<std::string_view, std::string_view> geometry[] = {{"/beamlattice/", "beam lattice"},
                                                                      {"/booleanoperations/", "boolean operations"},
                                                                      {"/displacement/", "displacement"},
                                                                      {"/implicit/", "implicit functions"},
                                                                      {"/volumetric/", "volumetric shape"},
                                                                      {"/securecontent/", "secure content"},
                                                                      {"/slice/", "slices"}};
constexpr std::string_view harmless[] = {"/core/", "/production/", "/material/", "/trianglesets/"};

}  // namespace

std::string_view name_of_3mf_geometry(std::string_view name_space) {
    for (const auto& [part, name] : geometry)
        if (name_space.find(part) != std::string_view::npos) return name;
    return {};
}

void require_known_3mf_extension(const std::string& words, std::string_view name_space, ImportedFile& file) {
    if (const std::string_view name = name_of_3mf_geometry(name_space); !name.empty()) {
        throw_error(ImportStatus::unsupported, words, ": it requires the 3MF extension for ", name,
                    ", which changes its geometry and is not read. Export it as a mesh, without this extension.");
    }
    const auto is_part = [name_space](std::string_view part) {
        return name_space.find(part) != std::string_view::npos;
    };
    if (std::any_of(std::begin(harmless), std::end(harmless), is_part)) return;
    add_warning(file, "unknown_extension",
                text(words, ": it requires the extension '", printable(name_space),
                     "' of 3MF, which is unknown here. If that changes its geometry, export it "
                     "without."));
}

}  // namespace espalier::importer
