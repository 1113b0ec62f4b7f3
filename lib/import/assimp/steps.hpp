// The steps of an import by assimp: what it opens and reports, what it returns, and what that hides.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <assimp/IOSystem.hpp>

#include <import/base/importers.hpp>

struct aiScene;

namespace espalier::importer {

/// The paths of files that assimp opened or looked for. It chooses an importer by the ending of a name: a file that is
/// to be read in another format has a second name with that ending.
struct OpenedFiles {
    std::string path;
    std::string second_name;
    std::vector<std::string>& opened;
    std::vector<std::string> missing = {};  ///< those that are not there, or are folders
    std::string unreadable = {};            ///< the first one of which reading failed
    int error = 0;                          ///< why, a value of errno
};

/// Returns a reader of files that fills the lists, which must live as long. Texts in UTF-16 are converted to UTF-8.
std::unique_ptr<Assimp::IOSystem> list_opened_files(OpenedFiles& files);

/// While it lives, assimp's reports are read. One at a time.
class ImporterLog {
public:
    explicit ImporterLog(const ImportOptions& options);
    ~ImporterLog();
    ImporterLog(const ImporterLog&) = delete;
    ImporterLog& operator=(const ImporterLog&) = delete;

    /// Returns the reports of lost geometry.
    [[nodiscard]] const std::vector<std::string>& losses() const { return losses_; }

private:
    std::vector<std::string> losses_;
};

/// Returns true for an error of assimp, and for a warning that something was left out, unless it is only about looks,
/// lights, cameras or motion. `line` begins with its severity, as assimp writes it.
bool reports_lost_geometry(std::string_view line);

/// Appends the meshes of a file's scene to `imported`, and sets the format, unit, axis and warnings of `file`. Throws
/// ImportError (invalid_input) for a scene that contradicts itself.
void read_scene(const aiScene& scene, const ImportOptions& options, ImportedFile& file, ImportResult& imported);

/// Tests the text or the chunks of a file that assimp has read, by its format. Appends a warning for one that lacks its
/// end. Throws ImportError (invalid_input) for an index beyond the vertices, (unsupported) for lists of polygons of
/// which assimp keeps one.
void find_hidden_defects(ImportedFile& file);

/// Returns the value of an attribute in the text between `<` and `>`; empty without one.
std::string_view tag_attribute(std::string_view tag, std::string_view name);

/// Returns the value of an attribute of the first element of that name in a text; empty without one.
std::string_view xml_attribute(std::string_view text, std::string_view element, std::string_view name);

}  // namespace espalier::importer
