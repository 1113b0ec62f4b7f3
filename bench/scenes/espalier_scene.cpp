#include "../memory.hpp"
#include "scenes.hpp"

#include <espalier/scenes/bake.hpp>

namespace espalier::bench {
namespace {

std::vector<std::byte> bake_placed(const Placed& placed, Profile profile) {
    std::vector<std::vector<std::byte>> blobs;
    for (const Mesh& mesh : placed.meshes) blobs.push_back(bake_blob(mesh, profile).baked.bytes);
    if (placed.instances.empty()) return blobs.front();
    SceneBakeResult baked =
        bake_scene(std::vector<std::span<const std::byte>>(blobs.begin(), blobs.end()), placed.instances);
    if (!baked) throw std::runtime_error(baked.message);
    return std::move(baked.bytes);
}

/// Bytes in memory of their own.
struct Copied {
    Copied(const std::vector<std::byte>& from, Pages pages) : memory(from.size(), pages), size(from.size()) {
        std::memcpy(memory.data(), from.data(), size);
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {memory.data(), size}; }
    Memory memory;
    std::size_t size;
};

struct OpenedScene : Copied {
    OpenedScene(const std::vector<std::byte>& from, Pages pages) : Copied(from, pages) {
        meshes.resize(mesh_count_of_scene(bytes()));
        scene = open_scene(bytes(), meshes);
        if (!scene) throw std::runtime_error(describe(scene.status()));
    }
    std::vector<Blob> meshes;
    BakedScene scene;
};

/// With small pages and with huge ones.
void add(const std::string& name, const std::vector<std::byte>& bytes, bool is_scene, SceneContest& to) {
    for (const auto& [suffix, pages] : {std::pair{"", Pages::small}, std::pair{", huge pages", Pages::huge}}) {
        if (is_scene) {
            const auto opened = std::make_shared<OpenedScene>(bytes, pages);
            to.push_back({"espalier", name + suffix, one_by_one([opened](const Ray& ray) {
                              const InScene<RayHit> hit = raycast(opened->scene, ray);
                              return hit ? hit->t : std::numeric_limits<float>::infinity();
                          }),
                          opened->scene.size()});
        } else {  // the mesh alone, without a scene around it
            const auto copied = std::make_shared<Copied>(bytes, pages);
            const Blob blob = open(copied->bytes());
            to.push_back({"espalier", name + suffix,
                          one_by_one([copied, blob](const Ray& ray) { return raycast(blob, ray).t; }), blob.size()});
        }
    }
}

}  // namespace

void add_espalier_scenes(const Placed& placed, SceneContest& to) {
    add("fast", bake_placed(placed, Profile::fast), !placed.instances.empty(), to);
    add("balanced", bake_placed(placed, Profile::balanced), !placed.instances.empty(), to);
}

void add_baked_scene(const std::vector<std::byte>& scene, SceneContest& to) { add("as baked", scene, true, to); }

}  // namespace espalier::bench
