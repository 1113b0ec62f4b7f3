#include "scene_system.hpp"

namespace espalier::bench {
namespace {

std::vector<std::byte> bake_placed(const Placed& placed, Profile profile) {
    std::vector<std::vector<std::byte>> blobs;
    for (const Mesh& mesh : placed.meshes) blobs.push_back(bake_blob(mesh, profile).baked.bytes);
    SceneBakeResult baked =
        bake_scene(std::vector<std::span<const std::byte>>(blobs.begin(), blobs.end()), placed.instances);
    if (!baked) throw std::runtime_error(baked.message);
    return std::move(baked.bytes);
}

class EspalierScene final : public SceneSystem {
public:
    EspalierScene(const std::vector<std::byte>& baked, Pages pages) : memory_(baked.size(), pages) {
        std::memcpy(memory_.data(), baked.data(), baked.size());
        const std::span<const std::byte> bytes(memory_.data(), baked.size());
        meshes_.resize(mesh_count_of_scene(bytes));
        scene_ = open_scene(bytes, meshes_);
        if (!scene_) throw std::runtime_error(describe(scene_.status()));
    }
    void closest(const std::vector<Ray>& rays, std::vector<float>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const InScene<RayHit> hit = raycast(scene_, rays[i]);
            hits[i] = hit ? hit->t : miss;
        }
    }
    [[nodiscard]] std::size_t bytes() const override { return scene_.size(); }

private:
    Memory memory_;
    std::vector<Blob> meshes_;
    BakedScene scene_;
};

/// The first mesh alone, without a scene around it.
class EspalierMesh final : public SceneSystem {
public:
    EspalierMesh(const Placed& placed, Profile profile, Pages pages) {
        const std::vector<std::byte> bytes = bake_blob(placed.meshes.front(), profile).baked.bytes;
        memory_.emplace(bytes.size(), pages);
        std::memcpy(memory_->data(), bytes.data(), bytes.size());
        blob_ = open({memory_->data(), bytes.size()});
    }
    void closest(const std::vector<Ray>& rays, std::vector<float>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayHit hit = raycast(blob_, rays[i]);
            hits[i] = hit ? hit.t : miss;
        }
    }
    [[nodiscard]] std::size_t bytes() const override { return blob_.size(); }

private:
    std::optional<Memory> memory_;
    Blob blob_;
};

}  // namespace

std::vector<SceneMaker> espalier_scene_makers() {
    struct Kind {
        const char* name;
        Profile profile;
        Pages pages;
    };
    std::vector<SceneMaker> makers;
    for (const Kind& kind :
         {Kind{"fast", Profile::fast, Pages::small}, Kind{"fast, huge pages", Profile::fast, Pages::huge},
          Kind{"balanced", Profile::balanced, Pages::small},
          Kind{"balanced, huge pages", Profile::balanced, Pages::huge}}) {
        makers.push_back({"espalier", kind.name, [kind](const Placed& placed) -> std::unique_ptr<SceneSystem> {
                              if (placed.instances.empty())
                                  return std::make_unique<EspalierMesh>(placed, kind.profile, kind.pages);
                              return std::make_unique<EspalierScene>(bake_placed(placed, kind.profile), kind.pages);
                          }});
    }
    return makers;
}

std::vector<SceneMaker> baked_scene_makers(const std::vector<std::byte>& scene) {
    const auto maker = [&](const char* name, Pages pages) {
        return SceneMaker{"espalier", name,
                          [scene, pages](const Placed&) { return std::make_unique<EspalierScene>(scene, pages); }};
    };
    return {maker("as baked", Pages::small), maker("as baked, huge pages", Pages::huge)};
}

}  // namespace espalier::bench
