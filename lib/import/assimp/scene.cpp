#include <import/assimp/steps.hpp>

#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <import/base/error.hpp>
#include <import/base/mesh_collector.hpp>
#include <import/base/node_paths.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

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

constexpr std::pair<std::string_view, double> amf_units[] = {
    {"millimeter", 0.001}, {"inch", 0.0254}, {"feet", 0.3048}, {"meter", 1.0}, {"micron", 1e-6}};

class SceneReader {
public:
    SceneReader(const aiScene& scene, const ImportOptions& options, ImportedFile& file, ImportResult& imported)
        : scene_(scene), options_(options), file_(file), meshes_(options, file, imported) {}

    void read() {
        if (scene_.mMetaData != nullptr) {
            aiString format;
            if (scene_.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format)) file_.format = printable(format.C_Str());
        }
        set_materials(file_, material_names());
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
        std::uint32_t parent_path;
    };

    [[nodiscard]] std::vector<std::string> material_names() const {
        std::vector<std::string> names(std::max(1u, scene_.mNumMaterials));
        for (unsigned i = 0; scene_.mMaterials != nullptr && i < scene_.mNumMaterials; ++i)
            if (scene_.mMaterials[i] != nullptr) names[i] = scene_.mMaterials[i]->GetName().C_Str();
        return names;
    }

    /// In depth-first order with an own stack: how deep a file nests is not ours to choose.
    void walk(const aiNode& root, const Placement& asset) {
        std::vector<PlacedNode> waiting{{&root, asset, NodePaths::no_node}};
        while (!waiting.empty()) {
            const PlacedNode placed = waiting.back();
            waiting.pop_back();
            const aiNode& node = *placed.node;
            const Placement placement = combine(placed.parent, placement_of(node.mTransformation));
            const std::uint32_t path = paths_.add(placed.parent_path, node.mName.C_Str());
            for (unsigned i = 0; node.mMeshes != nullptr && i < node.mNumMeshes; ++i) {
                if (node.mMeshes[i] >= scene_.mNumMeshes || scene_.mMeshes[node.mMeshes[i]] == nullptr) {
                    throw_file_error(ImportStatus::invalid_input, file_.path, ", node '", printable(node.mName.C_Str()),
                                     "': names mesh ", node.mMeshes[i], " of ", scene_.mNumMeshes,
                                     ". The file is broken; export it again.");
                }
                add_mesh(node.mMeshes[i], placement, paths_.path_of(path));
            }
            for (unsigned i = node.mChildren == nullptr ? 0 : node.mNumChildren; i-- > 0;) {
                if (node.mChildren[i] != nullptr) waiting.push_back({node.mChildren[i], placement, path});
            }
        }
    }

    void warn(const char* kind, const std::string& message) {
        add_warning(file_, kind, text("'", printable(file_.path), "': ", message));
    }

    /// A mesh that was imported for its first place, and what of it was left out.
    struct ImportedOnce {
        std::uint32_t mesh;
        std::uint64_t points_and_lines;
        std::uint64_t faces_without_corners;
    };

    void add_mesh(unsigned number, const Placement& placement, const std::string& path) {
        const aiMesh& source = *scene_.mMeshes[number];
        const auto found = imported_.find(number);
        if (found != imported_.end()) {
            const ImportedOnce& once = found->second;
            meshes_.add_place(once.mesh, meshes_.begin(source.mName.C_Str(), 0, path), placement);
            file_.points_and_lines += once.points_and_lines;
            faces_without_corners_ += once.faces_without_corners;
            return;
        }
        const std::uint64_t lines_before = file_.points_and_lines;
        const std::uint64_t empty_before = faces_without_corners_;
        const std::uint32_t mesh = add_new_mesh(source, placement, path);
        if (!meshes_.keeps_places()) return;
        imported_[number] = {mesh, file_.points_and_lines - lines_before, faces_without_corners_ - empty_before};
    }

    std::uint32_t add_new_mesh(const aiMesh& source, const Placement& placement, const std::string& path) {
        ImportedMesh mesh = meshes_.begin(source.mName.C_Str(), source.mNumFaces, path);
        const Placement applied = meshes_.applied(placement);
        if (source.mVertices != nullptr) {
            mesh.positions.reserve(source.mNumVertices);
            for (unsigned i = 0; i < source.mNumVertices; ++i) {
                const aiVector3D& position = source.mVertices[i];
                mesh.positions.push_back(applied({double(position.x), double(position.y), double(position.z)}));
            }
        }
        // A mirrored mesh must keep its front outside: its corners run the other way.
        add_triangles(source, applied.mirrors(), mesh);
        return meshes_.add(std::move(mesh), source.mMaterialIndex, placement);
    }

    // Indices are not checked against the vertices here: the baker does that, as its options choose.
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
                throw ImportError(
                    ImportStatus::invalid_input,
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
        throw_file_error(ImportStatus::invalid_input, file_.path, ": its unit '", printable(stated),
                         "' is none of AMF. State the unit with --unit.");
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
    NodePaths paths_;
    std::uint64_t faces_without_corners_ = 0;
    std::map<unsigned, ImportedOnce> imported_;  ///< by the scene's number; empty unless places are kept
};

}  // namespace

void read_scene(const aiScene& scene, const ImportOptions& options, ImportedFile& file, ImportResult& imported) {
    SceneReader(scene, options, file, imported).read();
}

}  // namespace espalier::importer
