#include "importer.hpp"

#include <assimp/commonMetaData.h>
#include <assimp/config.h>
#include <assimp/mesh.h>
#include <assimp/metadata.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/DefaultLogger.hpp>
#include <assimp/IOStream.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/ProgressHandler.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "hidden_defects.hpp"
#include "import/base/mesh_collector.hpp"
#include "import/base/text_file.hpp"
#include "import/guards/crash_guard.hpp"
#include "importer_reports.hpp"
#include "xml_tags.hpp"

namespace espalier::tools {

namespace {

/// assimp's reasons end with a full stop or without, or are missing.
std::string sentence(const char* reason) {
    std::string result = printable(reason);
    if (result.empty()) return "the importer gives no reason.";
    if (result.back() != '.' && result.back() != '!') result += '.';
    return result;
}

Placement placement_of(const aiMatrix4x4& matrix) {
    Placement result;
    for (unsigned row = 0; row < 3; ++row) {
        for (unsigned column = 0; column < 3; ++column) {
            result.linear[row][column] = static_cast<double>(matrix[row][column]);
        }
        result.offset[row] = static_cast<double>(matrix[row][3]);
    }
    return result;
}

class ImportProgress : public Assimp::ProgressHandler {
public:
    explicit ImportProgress(const ImportOptions& options) : options_(options) {}
    bool Update(float done) override {
        if (options_.progress) options_.progress("reading", static_cast<double>(done));
        return true;  // go on
    }

private:
    const ImportOptions& options_;
};

/// Passes on what assimp reports, one line each, and keeps the warnings and errors about lost geometry.
class ReportStream : public Assimp::LogStream {
public:
    ReportStream(const ImportOptions& options, std::vector<std::string>* losses) : options_(options), losses_(losses) {}
    void write(const char* message) override {
        std::string line = message;
        while (line.ends_with('\n') || line.ends_with(' ')) line.pop_back();
        line = printable(line);
        if (losses_ != nullptr && reports_lost_geometry(line)) losses_->push_back(line);
        if (options_.log) options_.log(line);
    }

private:
    const ImportOptions& options_;
    std::vector<std::string>* losses_;
};

/// While it lives, assimp's reports are read.
class ImporterLog {
public:
    explicit ImporterLog(const ImportOptions& options) {
        Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
        Assimp::Logger* logger = Assimp::DefaultLogger::get();  // which deletes the streams
        logger->attachStream(new ReportStream(options, &losses_), Assimp::Logger::Warn | Assimp::Logger::Err);
        if (options.log) logger->attachStream(new ReportStream(options, nullptr), Assimp::Logger::Info);
    }
    ~ImporterLog() { Assimp::DefaultLogger::kill(); }
    ImporterLog(const ImporterLog&) = delete;
    ImporterLog& operator=(const ImporterLog&) = delete;

    [[nodiscard]] const std::vector<std::string>& losses() const { return losses_; }

private:
    std::vector<std::string> losses_;
};

/// A text that was stored as UTF-16, as UTF-8: not all importers convert it.
class ConvertedStream : public Assimp::IOStream {
public:
    explicit ConvertedStream(std::string text) : text_(std::move(text)) {}
    std::size_t Read(void* target, std::size_t size, std::size_t count) override {
        if (size == 0) return 0;
        count = std::min(count, (text_.size() - at_) / size);
        std::memcpy(target, text_.data() + at_, count * size);
        at_ += count * size;
        return count;
    }
    std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
    aiReturn Seek(std::size_t offset, aiOrigin origin) override {
        const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : text_.size();
        if (from + offset > text_.size()) return aiReturn_FAILURE;
        at_ = from + offset;
        return aiReturn_SUCCESS;
    }
    std::size_t Tell() const override { return at_; }
    std::size_t FileSize() const override { return text_.size(); }
    void Flush() override {}

private:
    std::string text_;
    std::size_t at_ = 0;
};

/// Reads files, and lists those that an importer opened, which are the mesh and what it refers to, and those that it
/// did not find.
class ListedFiles : public Assimp::DefaultIOSystem {
public:
    ListedFiles(std::vector<std::string>& opened, std::vector<std::string>& missing)
        : opened_(opened), missing_(missing) {}

    bool Exists(const char* path) const override {
        const bool exists = DefaultIOSystem::Exists(path);
        if (!exists) list(path, missing_);
        return exists;
    }
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
        list(path, stream != nullptr ? opened_ : missing_);
        if (stream == nullptr || !is_utf16(*stream)) return stream;
        Close(stream);
        return new ConvertedStream(utf8_text(read_bytes(path)));
    }

private:
    static void list(const char* path, std::vector<std::string>& paths) {
        if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.emplace_back(path);
    }
    /// A byte order mark and a letter of ASCII.
    static bool is_utf16(Assimp::IOStream& stream) {
        unsigned char begin[4] = {};
        const bool is_long = stream.Read(begin, 1, sizeof(begin)) == sizeof(begin);
        stream.Seek(0, aiOrigin_SET);
        return is_long && ((begin[0] == 0xFF && begin[1] == 0xFE && begin[2] != 0 && begin[3] == 0) ||
                           (begin[0] == 0xFE && begin[1] == 0xFF && begin[2] == 0 && begin[3] != 0));
    }

    std::vector<std::string>& opened_;
    std::vector<std::string>& missing_;
};

/// Formats with readers of their own are never left to assimp, which would find Wavefront OBJ in any file with the
/// letter v.
void remove_replaced_importers(Assimp::Importer& importer) {
    for (const char* ending : {"obj", "ply", "stl", "gltf", "raw"}) {
        while (Assimp::BaseImporter* replaced = importer.GetImporter(ending)) {
            importer.UnregisterLoader(replaced);
            delete replaced;
        }
    }
}

/// With the dot, in lower case; empty without one.
std::string ending_of(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return ending;
}

constexpr std::pair<std::string_view, double> amf_units[] = {
    {"millimeter", 0.001}, {"inch", 0.0254}, {"feet", 0.3048}, {"meter", 1.0}, {"micron", 1e-6}};

/// Reads one file's scene into `imported`.
class SceneReader {
public:
    SceneReader(const aiScene& scene, const ImportOptions& options, ImportedFile& file, Imported& imported)
        : scene_(scene), options_(options), file_(file), meshes_(options, file, imported) {}

    void read() {
        if (scene_.mMetaData != nullptr) {
            aiString format;
            if (scene_.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format)) file_.format = printable(format.C_Str());
        }
        file_.materials = std::max(1u, scene_.mNumMaterials);
        find_unit();
        find_stated_up();
        if (scene_.mRootNode != nullptr) walk(*scene_.mRootNode, meshes_.asset_placement());
        if (faces_without_corners_ == 0) return;
        warn("empty_face",
             text(counted(faces_without_corners_, "face"),
                  " came without corners, or with too few: the vertices of such a face are missing in the "
                  "file, or it has none."));
    }

private:
    struct PlacedNode {
        const aiNode* node;
        Placement parent;
    };

    /// In depth-first order with an own stack: how deep a file nests is not ours to choose.
    void walk(const aiNode& root, const Placement& asset) {
        std::vector<PlacedNode> waiting{{&root, asset}};
        while (!waiting.empty()) {
            const PlacedNode placed = waiting.back();
            waiting.pop_back();
            const aiNode& node = *placed.node;
            const Placement placement = combine(placed.parent, placement_of(node.mTransformation));
            for (unsigned i = 0; node.mMeshes != nullptr && i < node.mNumMeshes; ++i) {
                if (node.mMeshes[i] >= scene_.mNumMeshes || scene_.mMeshes[node.mMeshes[i]] == nullptr) {
                    throw CommandError(
                        ExitCode::invalid_input,
                        text("'", printable(file_.path), "', node '", printable(node.mName.C_Str()), "': names mesh ",
                             node.mMeshes[i], " of ", scene_.mNumMeshes, ". The file is broken; export it again."),
                        {.file = file_.path});
                }
                add_mesh(*scene_.mMeshes[node.mMeshes[i]], placement);
            }
            for (unsigned i = node.mChildren == nullptr ? 0 : node.mNumChildren; i-- > 0;) {
                if (node.mChildren[i] != nullptr) waiting.push_back({node.mChildren[i], placement});
            }
        }
    }

    void warn(const char* kind, const std::string& message) {
        file_.warnings.push_back({kind, text("'", printable(file_.path), "': ", message), file_.path, {}, {}});
    }

    void add_mesh(const aiMesh& source, const Placement& placement) {
        ImportedMesh mesh = meshes_.begin(source.mName.C_Str(), source.mNumFaces);
        if (source.mVertices != nullptr) {
            mesh.positions.reserve(source.mNumVertices);
            for (unsigned i = 0; i < source.mNumVertices; ++i) {
                const aiVector3D& position = source.mVertices[i];
                mesh.positions.push_back(placement(Vec3{position.x, position.y, position.z}));
            }
        }
        // A mirrored mesh must keep its front outside: its corners run the other way.
        add_triangles(source, placement.mirrors(), mesh);
        meshes_.add(std::move(mesh), source.mMaterialIndex);
    }

    // Indices are not checked against the vertices here: the baker does that, and knows whether to repair.
    void add_triangles(const aiMesh& source, bool mirrored, ImportedMesh& mesh) {
        if (source.mFaces == nullptr) return;
        const bool is_x = file_.format.find("XFile") != std::string::npos;
        mesh.triangles.reserve(source.mNumFaces);
        for (unsigned i = 0; i < source.mNumFaces; ++i) {
            const aiFace& face = source.mFaces[i];
            // Faces of X have three corners or more, and lose those whose vertices are missing.
            if (face.mIndices == nullptr || face.mNumIndices == 0 || (is_x && face.mNumIndices < 3)) {
                ++faces_without_corners_;
                continue;
            }
            if (face.mNumIndices < 3) {
                ++file_.points_and_lines;
                continue;
            }
            if (face.mNumIndices > 3) {
                throw CommandError(
                    ExitCode::invalid_input,
                    text(mesh.name, ", face ", i, ": its ", face.mNumIndices,
                         " corners could not be made into triangles. Triangulate it and export it again."),
                    {.file = file_.path, .mesh = mesh.mesh, .triangle = mesh.triangles.size()});
            }
            const unsigned second = mirrored ? 2 : 1;
            mesh.triangles.push_back({face.mIndices[0], face.mIndices[second], face.mIndices[3 - second]});
        }
    }

    void find_unit() {
        double centimetres = 0.0;
        if (options_.metres_per_unit) {
            file_.metres_per_unit = *options_.metres_per_unit;
            file_.unit_origin = "--unit";
        } else if (file_.format.find("FBX") != std::string::npos && read_number("UnitScaleFactor", centimetres) &&
                   std::isfinite(centimetres) && centimetres > 0.0) {
            // assimp 5.2 leaves the factor to its user; newer ones scale the root node by it, which is taken out again.
            const double root_scale =
                std::cbrt(std::abs(placement_of(scene_.mRootNode->mTransformation).determinant()));
            const bool applied = std::abs(root_scale - centimetres) < 1e-4 * centimetres;
            file_.metres_per_unit = applied ? 0.01 : centimetres / 100.0;
            file_.unit_origin = text("FBX unit scale factor ", centimetres);
        } else if (file_.format.find("3mf") != std::string::npos) {
            file_.metres_per_unit = 0.001;
            file_.unit_origin = "3MF, whose default is the millimetre";
            warn("unit_not_read",
                 "it was taken as millimetres, the default of 3MF; another unit that it states is not read. Give its "
                 "unit with --unit.");
        } else if (file_.format.find("AMF") != std::string::npos) {
            find_amf_unit();
        } else if (file_.format.find("Collada") != std::string::npos || file_.format.find("IFC") != std::string::npos) {
            file_.unit_origin = "converted to metres on import";
        } else {
            file_.unit_origin = "not stated";
        }
    }

    void find_amf_unit() {
        const std::string content = utf8_text(read_bytes(file_.path));
        const std::string stated(xml_attribute(content, "amf", "unit"));
        for (const auto& [name, metres] : amf_units) {
            if (stated != name && !(stated.empty() && name == amf_units[0].first)) continue;
            file_.metres_per_unit = metres;
            file_.unit_origin =
                stated.empty() ? std::string("AMF, whose default is the millimetre") : text("AMF unit ", stated);
            return;
        }
        throw CommandError(ExitCode::invalid_input,
                           text("'", printable(file_.path), "': its unit '", printable(stated),
                                "' is none of AMF. State the unit with --unit."),
                           {.file = file_.path});
    }

    void find_stated_up() {
        int axis = 1;
        if (file_.format.find("FBX") == std::string::npos || scene_.mMetaData == nullptr) return;
        if (!scene_.mMetaData->Get("UpAxis", axis) || axis < 0 || axis > 2 || axis == 1) return;
        if (!scene_.mRootNode->mTransformation.IsIdentity()) return;
        file_.stated_up = static_cast<Axis>(axis);
    }

    bool read_number(const char* key, double& value) const {
        if (scene_.mMetaData == nullptr || scene_.mRootNode == nullptr) return false;
        if (scene_.mMetaData->Get(key, value)) return true;
        float narrow = 0.0f;
        if (!scene_.mMetaData->Get(key, narrow)) return false;
        value = static_cast<double>(narrow);
        return true;
    }

    const aiScene& scene_;
    const ImportOptions& options_;
    ImportedFile& file_;
    MeshCollector meshes_;
    std::uint64_t faces_without_corners_ = 0;
};

/// Importers look for a file in several folders, and for files named like the mesh, such as its animation.
bool is_referred_to(const std::string& missing, const ImportedFile& file) {
    const std::filesystem::path name = std::filesystem::path(missing).filename();
    if (name.stem() == std::filesystem::path(file.path).stem()) return false;
    return std::none_of(file.opened.begin(), file.opened.end(), [&name](const std::string& opened) {
        return std::filesystem::path(opened).filename() == name;
    });
}

}  // namespace

void import_with_assimp(const std::string& path, const ImportOptions& options, Imported& imported) {
    const CrashGuard guard(path, options);
    const ImporterLog log(options);
    Assimp::Importer importer;
    remove_replaced_importers(importer);
    // A skeleton without a skin would come as an invented mesh; it has no surface.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    ImportedFile file;
    file.path = path;
    std::vector<std::string> missing;
    importer.SetProgressHandler(new ImportProgress(options));  // which the importer deletes, like the next
    importer.SetIOHandler(new ListedFiles(file.opened, missing));
    const std::string ending = ending_of(path);
    const bool is_known_ending = !ending.empty() && importer.IsExtensionSupported(ending);
    // Nothing but triangles is asked for: welding and dropping is the baker's work, which counts what it does.
    const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
    if (scene == nullptr && !is_known_ending) {
        throw CommandError(ExitCode::unsupported,
                           text("'", printable(path), "' cannot be imported: ",
                                ending.empty() ? std::string("its name has no ending")
                                               : text("there is no importer for '", printable(ending), "' files"),
                                ", and its content is of no format that is known. Convert it, for example to glTF."),
                           {.file = path});
    }
    if (scene == nullptr) {
        throw CommandError(
            ExitCode::invalid_input,
            text("'", printable(path), "' cannot be imported: ", sentence(importer.GetErrorString()),
                 missing.empty() ? std::string(" If the file is whole, try another format, such as glTF.")
                                 : text(" The importer looked for '", printable(missing[0]), "', which is missing.")),
            {.file = path});
    }
    SceneReader(*scene, options, file, imported).read();
    find_hidden_defects(file);
    if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
        file.warnings.push_back({"incomplete_scene",
                                 text("'", printable(path),
                                      "': its importer states that the scene is incomplete: "
                                      "triangles may be missing."),
                                 path, std::nullopt, std::nullopt});
    }
    if (!is_known_ending && !ending.empty()) {
        file.warnings.push_back({"unknown_ending",
                                 text("'", printable(path), "': there is no importer for '", printable(ending),
                                      "' files; by its content it was read by the ", file.format, '.'),
                                 path, std::nullopt, std::nullopt});
    }
    if (!log.losses().empty()) {
        file.warnings.push_back(
            {"importer_report",
             text("'", printable(path), "': its importer reports ", log.losses().size() == 1 ? "" : "at first ", "'",
                  log.losses()[0], "': triangles may be missing or wrong. --verbose prints all reports."),
             path, std::nullopt, std::nullopt});
    }
    for (const std::string& name : missing) {
        if (!importer.IsExtensionSupported(ending_of(name)) || !is_referred_to(name, file)) continue;
        file.warnings.push_back({"missing_file",
                                 text("'", printable(path), "' refers to '", printable(name),
                                      "', which is missing: what it contains was left out."),
                                 path, std::nullopt, std::nullopt});
    }
    imported.files.push_back(std::move(file));
}

}  // namespace espalier::tools
