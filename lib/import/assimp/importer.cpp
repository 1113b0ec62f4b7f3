#include <import/base/importers.hpp>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <utility>

#include <import/assimp/steps.hpp>
#include <import/base/library_state.hpp>
#include <import/base/text_file.hpp>
#include <import/guards/limit_guard.hpp>
#include <import/platform/files.hpp>

namespace espalier::importer {

namespace {

/// assimp's reasons end with a full stop or without, or are missing.
std::string sentence(const char* reason) {
    std::string result = printable(reason);
    if (result.empty()) return "the importer gives no reason.";
    if (result.back() != '.' && result.back() != '!') result += '.';
    return result;
}

class ImportProgress : public Assimp::ProgressHandler {
public:
    explicit ImportProgress(const ImportOptions& options) : options_(options) {}
    bool Update(float done) override {
        show_reading(options_, static_cast<double>(done), 1.0);
        return true;  // go on
    }

private:
    const ImportOptions& options_;
};

/// Formats with readers of their own are never left to assimp, which would find Wavefront OBJ in any file with the
/// letter v.
void remove_replaced_importers(Assimp::Importer& importer) {
    for (const char* ending : {"obj", "ply", "stl", "off", "gltf", "raw", "3mf"}) {
        while (Assimp::BaseImporter* replaced = importer.GetImporter(ending)) {
            importer.UnregisterLoader(replaced);
            delete replaced;
        }
    }
}

/// Importers look for a file in several folders, and for files named like the mesh, such as its animation.
bool is_referred_to(const std::string& missing, const ImportedFile& file) {
    const std::filesystem::path name = path_of(missing).filename();
    if (name.stem() == path_of(file.path).stem()) return false;
    return std::none_of(file.opened.begin(), file.opened.end(),
                        [&name](const std::string& opened) { return path_of(opened).filename() == name; });
}

}  // namespace

void import_with_assimp(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    const std::lock_guard lock(library_state());
    const CrashGuard guard(path, options);
    const ImporterLog log(options);
    Assimp::Importer importer;
    remove_replaced_importers(importer);
    // A skeleton without a skin would come as an invented mesh; it has no surface.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    ImportedFile file;
    file.path = path;
    const bool is_stated = !options.format.empty();
    const std::string ending = is_stated ? "." + options.format : ending_of(path);
    // By the ending of this name assimp finds the importer: what gzip packed has another one.
    const bool has_ending = !is_stated && lower_case(path).ends_with(ending);
    OpenedFiles files{path, has_ending ? path : path + ending, file.opened};
    const std::vector<std::string>& missing = files.missing;
    importer.SetProgressHandler(new ImportProgress(options));  // which the importer deletes, like the next
    importer.SetIOHandler(list_opened_files(files).release());
    const bool is_known_ending = !ending.empty() && importer.IsExtensionSupported(ending);
    if (is_stated && !is_known_ending) {
        throw_error(
            ImportStatus::invalid_options, "--format '", printable(options.format),
            "': it is none of obj, off, ply, stl, raw, gltf and 3mf, nor the ending of a format that assimp reads.");
    }
    // Requests triangles only: welding and dropping is the baker's work, which counts what it does.
    const aiScene* scene = importer.ReadFile(files.second_name, aiProcess_Triangulate);
    if (files.error != 0) fail_to_read(files.unreadable, files.error);
    if (scene == nullptr && !is_known_ending) {
        throw_file_error(ImportStatus::unsupported, path, " cannot be imported: ",
                         ending.empty() ? std::string("its name has no ending")
                                        : text("there is no importer for '", printable(ending), "' files"),
                         ", and its content is of no format that is known. Convert it, for example to glTF.");
    }
    if (scene == nullptr) {
        throw_file_error(
            ImportStatus::invalid_input, path, " cannot be imported: ", sentence(importer.GetErrorString()),
            missing.empty() ? std::string(" If the file is whole, try another format, such as glTF.")
                            : text(" The importer looked for '", printable(missing[0]), "', which is missing."));
    }
    read_scene(*scene, options, file, imported);
    find_hidden_defects(file);
    if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
        add_warning(file, "incomplete_scene",
                    text("'", printable(path),
                         "': its importer states that the scene is incomplete: "
                         "triangles may be missing."));
    }
    if (!is_known_ending && !ending.empty()) {
        add_warning(file, "unknown_ending",
                    text("'", printable(path), "': there is no importer for '", printable(ending),
                         "' files; by its content it was read by the ", file.format, '.'));
    }
    if (!log.losses().empty()) {
        add_warning(file, "importer_report",
                    text("'", printable(path), "': its importer reports ", log.losses().size() == 1 ? "" : "at first ",
                         "'", log.losses()[0], "': triangles may be missing or wrong. --verbose prints all reports."));
    }
    for (const std::string& name : missing) {
        if (!importer.IsExtensionSupported(ending_of(name)) || !is_referred_to(name, file)) continue;
        add_warning(file, "missing_file",
                    text("'", printable(path), "' refers to '", printable(name),
                         "', which is missing: what it contains was left out."));
    }
    imported.files.push_back(std::move(file));
}

}  // namespace espalier::importer
