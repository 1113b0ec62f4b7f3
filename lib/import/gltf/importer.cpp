#include <import/base/importers.hpp>

#include <algorithm>
#include <map>
#include <utility>

#include <import/base/mesh_collector.hpp>
#include <import/base/numbers.hpp>
#include <import/base/text_file.hpp>
#include <import/gltf/data/accessors.hpp>
#include <import/gltf/data/container.hpp>
#include <import/gltf/extensions.hpp>
#include <import/gltf/nodes.hpp>
#include <import/guards/limit_guard.hpp>

namespace espalier::importer {

namespace {

bool is_named_gltf(const std::string& path, const ImportOptions& options) {
    const std::string name = options.format.empty() ? ending_of(path) : "." + options.format;
    return name == ".gltf" || name == ".glb" || name == ".b3dm";
}

/// What the accessors of a mesh claim.
struct ClaimedMesh {
    std::uint64_t primitives = 0;
    std::uint64_t triangles = 0;
};

/// Counts what a warning is about, with the first mesh as its example.
struct Found {
    std::uint64_t count = 0;
    std::uint32_t mesh = 0;
    std::string name;

    void add(const ImportedMesh& example) {
        if (count++ > 0) return;
        mesh = example.mesh;
        name = example.name;
    }
};

/// Reads one file's default scene into `imported`.
class GltfReader {
public:
    GltfReader(const GltfContainer& container, const ImportOptions& options, ImportedFile& file, ImportResult& imported)
        : options_(options),
          file_(file),
          data_(file.path, container, file.opened),
          root_(data_.root()),
          meshes_(options, file, imported) {
        require_known_gltf_extensions(root_);
        std::vector<std::string> materials = root_.names_in("materials");
        materials.emplace_back();  // of primitives without a material
        set_materials(file_, materials);
        file_.metres_per_unit = options.metres_per_unit.value_or(1.0);
        if (container.trailing_bytes > 0) {
            add_warning(file_, "trailing_bytes",
                        text(root_.words(), ": ", counted(container.trailing_bytes, "byte"),
                             " after the last chunk were not read. Export it again."));
        }
        file_.unit_origin = options.metres_per_unit ? "--unit" : "glTF is in metres";
    }

    void read() {
        nodes_ = read_gltf_nodes(root_);
        asset_ = combine(meshes_.asset_placement(), gltf_centre(root_));
        for (const std::size_t number : nodes_.in_scene) {
            if (const auto mesh = gltf_node(root_, number).index("mesh", root_.size_of("meshes"))) ++uses_left_[*mesh];
        }
        require_room();
        std::size_t done = 0;
        for (const std::size_t number : nodes_.in_scene) {
            add_node(number);
            show_reading(options_, static_cast<double>(++done), static_cast<double>(nodes_.in_scene.size()));
        }
        warn();
    }

private:
    struct Names {
        const std::string& mesh;
        const std::string& path;  ///< of the node
    };

    /// All that the accessors claim, before the first of it is read.
    void require_room() {
        std::uint64_t triangles = 0;
        std::uint64_t places = 0;
        std::uint64_t copies = 0;
        std::map<std::size_t, ClaimedMesh> claimed;
        for (const std::size_t number : nodes_.in_scene) {
            const GltfObject node = gltf_node(root_, number);
            const auto mesh_number = node.index("mesh", root_.size_of("meshes"));
            if (!mesh_number) continue;
            const auto [place, is_new] = claimed.try_emplace(*mesh_number);
            if (is_new) place->second = claimed_mesh(mesh_object(*mesh_number));
            const ClaimedMesh& mesh = place->second;
            const std::uint64_t instances = count_gltf_instances(node, data_);
            // Each factor and each sum is refused long before 64 bits overflow.
            if (meshes_.keeps_places()) {
                meshes_.require_places(instances, node.words());
                places += instances * mesh.primitives;
                meshes_.require_places(places, node.words());
                triangles += is_new ? mesh.triangles : 0;
            } else {
                meshes_.require_room(instances, node.words());
                meshes_.require_room(instances * mesh.triangles, node.words());
                // One without primitives still has instances to read.
                copies += (instances - std::min<std::uint64_t>(instances, is_new ? 1 : 0)) *
                          std::max<std::uint64_t>(1, mesh.primitives);
                meshes_.require_copies(copies, node.words());
                triangles += instances * mesh.triangles;
            }
            meshes_.require_room(triangles, node.words());
        }
    }

    ClaimedMesh claimed_mesh(const GltfObject& mesh) {
        ClaimedMesh claimed{mesh.size_of("primitives"), 0};
        for (std::size_t i = 0; i < claimed.primitives; ++i) {
            const GltfObject primitive = mesh.object_in("primitives", i, text(mesh.words(), ", primitive ", i));
            claimed.triangles += count_gltf_triangles(primitive, data_);
            meshes_.require_room(claimed.triangles, primitive.words());
        }
        return claimed;
    }

    void add_node(std::size_t number) {
        const GltfObject node = gltf_node(root_, number);
        const auto mesh_number = node.index("mesh", root_.size_of("meshes"));
        if (!mesh_number) return;
        const GltfObject mesh = mesh_object(*mesh_number);
        const auto skin = node.index("skin", root_.size_of("skins"));
        const std::vector<Placement>* const joints = skin ? &joints_of(*skin) : nullptr;
        if (skin && node.extension("EXT_mesh_gpu_instancing")) {
            node.refuse("it is skinned and instanced, which glTF leaves open. Export it without one of these.");
        }
        const Placement placement = combine(asset_, nodes_.global[number]);
        const std::string path = nodes_.paths.path_of(nodes_.path[number]);
        std::vector<GltfPrimitive>& primitives = primitives_of(*mesh_number, mesh);
        for (const Placement& instance : gltf_instances(node, data_)) {
            for (std::size_t i = 0; i < primitives.size(); ++i) {
                std::string name = mesh.text_of("name");
                if (primitives.size() > 1 && !name.empty()) name += text("-", i);
                add_mesh(node, mesh, primitives[i], {name, path}, combine(placement, instance), joints);
            }
        }
        if (--uses_left_[*mesh_number] == 0) primitives_.erase(*mesh_number);
    }

    [[nodiscard]] GltfObject mesh_object(std::size_t number) const {
        const std::string name = root_.object_in("meshes", number, root_.words()).text_of("name");
        return root_.object_in(
            "meshes", number,
            text(root_.words(), ", glTF mesh ", number, name.empty() ? "" : " (" + printable(name) + ")"));
    }

    /// Many nodes may share a skin.
    const std::vector<Placement>& joints_of(std::size_t skin) {
        const auto found = joints_.find(skin);
        if (found != joints_.end()) return found->second;
        return joints_.emplace(skin, joint_placements(data_, skin, nodes_, asset_)).first->second;
    }

    /// The primitives of a mesh stay until its last node is done.
    std::vector<GltfPrimitive>& primitives_of(std::size_t number, const GltfObject& mesh) {
        const auto found = primitives_.find(number);
        if (found != primitives_.end()) return found->second;
        std::vector<GltfPrimitive>& result = primitives_[number];
        for (std::size_t i = 0; i < mesh.size_of("primitives"); ++i) {
            const std::string words = text(mesh.words(), ", primitive ", i);
            result.push_back(
                read_gltf_primitive(mesh.object_in("primitives", i, words), data_, options_.keep_vertices));
        }
        return result;
    }

    void add_mesh(const GltfObject& node, const GltfObject& owner, GltfPrimitive& primitive, const Names& names,
                  const Placement& placement, const std::vector<Placement>* joints) {
        ImportedMesh mesh = meshes_.begin(names.mesh, primitive.imported ? 0 : primitive.triangles.size(), names.path);
        file_.points_and_lines += primitive.points_and_lines;
        if (primitive.left_over_corners > 0) left_over_.add(mesh);
        if (!primitive.has_positions) without_positions_.add(mesh);
        if (primitive.differs_from_accessors) differing_.add(mesh);
        if (primitive.is_morphed) morphed_.add(mesh);
        const bool is_skinned = joints != nullptr && !primitive.influences.empty();
        if (is_skinned) skinned_.add(mesh);
        if (joints != nullptr && !is_skinned) unweighted_.add(mesh);
        if (primitive.imported && !is_skinned) return meshes_.add_place(*primitive.imported, mesh, placement);

        mesh.positions = shape_of(node, owner, primitive);
        const Placement applied = meshes_.applied(placement);
        std::vector<bool> mirrors(is_skinned ? primitive.vertices.size() : 0);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            Vec3d& position = mesh.positions[i];
            if (!is_skinned) {
                position = applied(position);
                continue;
            }
            const Placement skinned =
                skinned_placement(primitive.influences, primitive.vertices[i], *joints, asset_, primitive.object);
            mirrors[i] = skinned.mirrors();
            position = skinned(position);
        }
        // A mirrored mesh must keep its front outside: its corners run the other way.
        mesh.triangles = primitive.triangles;
        const bool is_mirrored = applied.mirrors();
        for (TriangleVertices& triangle : mesh.triangles) {
            const auto turned = [&](std::uint32_t vertex) { return vertex < mirrors.size() && mirrors[vertex]; };
            const int turned_corners = turned(triangle[0]) + turned(triangle[1]) + turned(triangle[2]);
            if (is_skinned ? turned_corners >= 2 : is_mirrored) std::swap(triangle[1], triangle[2]);
        }
        const std::size_t materials = root_.size_of("materials");
        const std::uint32_t index =
            meshes_.add(std::move(mesh), primitive.object.index("material", materials).value_or(materials),
                        is_skinned ? Placement{} : placement);
        // A skin and a node's weights give each place a shape of its own.
        if (meshes_.keeps_places() && !is_skinned && !primitive.is_morphed) primitive.imported = index;
    }

    /// By the node's weights, else the mesh's, which are those of all its other nodes too.
    std::vector<Vec3d> shape_of(const GltfObject& node, const GltfObject& mesh, GltfPrimitive& primitive) {
        if (!primitive.is_morphed || node.has("weights"))
            return primitive.shape_by(node.has("weights") ? node : mesh, data_);
        if (!primitive.shape) primitive.shape = primitive.shape_by(mesh, data_);
        return *primitive.shape;
    }

    void warn() {
        warn_about(skinned_, "skinned_mesh",
                   "has a skin and is baked in the pose in which the file's nodes stand. To bake another pose, apply "
                   "it before the export.");
        warn_about(unweighted_, "unweighted_mesh",
                   "is on a node with a skin and has no joints and weights, so it is baked where its node stands. "
                   "Export it with them if it follows the skin.");
        warn_about(morphed_, "morphed_mesh",
                   "has morph targets and is baked with the file's default weights. To bake others, apply them before "
                   "the export.");
        warn_about(left_over_, "incomplete_triangle",
                   "ends with one or two corners, too few for a triangle, which are left out. Export it again.");
        warn_about(without_positions_, "missing_positions",
                   "has a primitive without the attribute POSITION, which is left out. Export it with positions.");
        warn_about(
            differing_, "draco_count",
            "has other numbers of corners or vertices in its Draco data than its accessors state, and is baked as "
            "the data has it. Export it again.");
        warn_about_unused_meshes();
        if (nodes_.left_out.empty()) return;
        add_warning(
            file_, "scene_left_out",
            text(root_.words(), ": ", counted(nodes_.left_out.size(), "node"), " with a mesh, the first is node ",
                 nodes_.left_out.front(),
                 ", is in no scene or in another one than the default scene, and is left out. Export the scenes one "
                 "by one to bake them."));
    }

    /// Meshes that no node of any scene names.
    void warn_about_unused_meshes() {
        std::vector<bool> is_used(root_.size_of("meshes"));
        for (std::size_t i = 0; i < root_.size_of("nodes"); ++i) {
            if (const auto mesh = gltf_node(root_, i).index("mesh", is_used.size())) is_used[*mesh] = true;
        }
        const auto unused = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), false));
        if (unused == 0) return;
        const auto first = static_cast<std::size_t>(std::find(is_used.begin(), is_used.end(), false) - is_used.begin());
        add_warning(file_, "unused_mesh",
                    text(mesh_object(first).words(), ": no node uses the mesh, and it is left out.",
                         unused > 1 ? text(" The file has ", unused, " such meshes.") : "",
                         " Give it a node in the scene to bake it."));
    }

    void warn_about(const Found& found, const char* kind, const char* what) {
        if (found.count == 0) return;
        const std::string all = found.count > 1 ? text(" The file has ", found.count, " such meshes.") : "";
        add_warning(file_, kind, text(found.name, ": the mesh ", what, all), found.mesh);
    }

    const ImportOptions& options_;
    ImportedFile& file_;
    GltfData data_;
    const GltfObject& root_;
    MeshCollector meshes_;
    GltfNodes nodes_;
    Placement asset_;
    std::map<std::size_t, std::size_t> uses_left_;
    std::map<std::size_t, std::vector<GltfPrimitive>> primitives_;
    std::map<std::size_t, std::vector<Placement>> joints_;
    Found skinned_, unweighted_, morphed_, left_over_, without_positions_, differing_;
};

}  // namespace

bool import_gltf(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    const CrashGuard guard(path, options);
    const std::optional<GltfContainer> container = read_gltf_container(path, is_named_gltf(path, options));
    if (!container) return false;
    ImportedFile file;
    file.path = path;
    file.format = container->format;
    file.opened.push_back(path);
    GltfReader(*container, options, file, imported).read();
    imported.files.push_back(std::move(file));
    return true;
}

}  // namespace espalier::importer
