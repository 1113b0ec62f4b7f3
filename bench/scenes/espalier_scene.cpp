#include <stdexcept>

#include <espalier/bake.hpp>

#include "scene_system.hpp"

namespace espalier::bench {
namespace {

class EspalierScene final : public SceneSystem {
public:
    EspalierScene(const Placed& placed, Profile profile) {
        std::vector<std::vector<std::byte>> blobs;
        for (const Mesh& mesh : placed.meshes) {
            BakeOptions options;
            options.profile = profile;
            BakeResult baked = bake(std::array{mesh.view()}, options);
            if (!baked) throw std::runtime_error(baked.message);
            blobs.push_back(std::move(baked.bytes));
        }
        SceneBakeResult baked =
            bake_scene(std::vector<std::span<const std::byte>>(blobs.begin(), blobs.end()), placed.instances);
        if (!baked) throw std::runtime_error(baked.message);
        bytes_ = std::move(baked.bytes);
        meshes_.resize(mesh_count_of_scene(bytes_));
        scene_ = open_scene(bytes_, meshes_);
        if (!scene_) throw std::runtime_error(describe(scene_.status()));
    }
    void closest(const std::vector<Ray>& rays, std::vector<float>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const InScene<RayHit> hit = raycast(scene_, rays[i]);
            hits[i] = hit ? hit->t : miss;
        }
    }
    [[nodiscard]] std::size_t bytes() const override { return bytes_.size(); }

private:
    std::vector<std::byte> bytes_;
    std::vector<Blob> meshes_;
    BakedScene scene_;
};

/// The first mesh alone, without a scene around it.
class EspalierMesh final : public SceneSystem {
public:
    EspalierMesh(const Placed& placed, Profile profile) {
        BakeOptions options;
        options.profile = profile;
        BakeResult baked = bake(std::array{placed.meshes.front().view()}, options);
        if (!baked) throw std::runtime_error(baked.message);
        bytes_ = std::move(baked.bytes);
        blob_ = open(bytes_);
    }
    void closest(const std::vector<Ray>& rays, std::vector<float>& hits) override {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayHit hit = raycast(blob_, rays[i]);
            hits[i] = hit ? hit.t : miss;
        }
    }
    [[nodiscard]] std::size_t bytes() const override { return bytes_.size(); }

private:
    std::vector<std::byte> bytes_;
    Blob blob_;
};

}  // namespace

std::vector<SceneMaker> espalier_scene_makers() {
    std::vector<SceneMaker> makers;
    for (const auto& [name, profile] : {std::pair{"fast", Profile::fast}, std::pair{"balanced", Profile::balanced}})
        makers.push_back({"espalier", name, [profile = profile](const Placed& placed) -> std::unique_ptr<SceneSystem> {
                              if (placed.instances.empty()) return std::make_unique<EspalierMesh>(placed, profile);
                              return std::make_unique<EspalierScene>(placed, profile);
                          }});
    return makers;
}

}  // namespace espalier::bench
