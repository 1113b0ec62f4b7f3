#include "../peers/embree.hpp"
#include "scenes.hpp"

namespace espalier::bench {
namespace {

class EmbreeScene {
public:
    explicit EmbreeScene(const Placed& placed) {
        for (const Mesh& mesh : placed.meshes) {
            meshes_.push_back(device_.new_scene(mesh));
            rtcCommitScene(meshes_.back());
        }
        if (placed.instances.empty()) return;
        scene_ = rtcNewScene(device_.get());
        for (const Instance& instance : placed.instances) {
            RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, meshes_[instance.mesh]);
            rtcSetGeometryTimeStepCount(geometry, 1);
            float columns[12];
            const Transform& t = instance.transform;
            const Vec3 axes[3] = {direction_to_world(t, {1, 0, 0}), direction_to_world(t, {0, 1, 0}),
                                  direction_to_world(t, {0, 0, 1})};
            for (int k = 0; k < 3; ++k) std::memcpy(columns + 3 * k, &axes[k], 12);
            std::memcpy(columns + 9, &t.translation, 12);
            rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(scene_, geometry);
            rtcReleaseGeometry(geometry);
        }
        rtcCommitScene(scene_);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;
    ~EmbreeScene() {
        if (scene_ != nullptr) rtcReleaseScene(scene_);
        for (RTCScene mesh : meshes_) rtcReleaseScene(mesh);
    }
    void closest(std::span<const Ray> rays, std::span<float> hits) const {
        EmbreeRays asked(scene_ != nullptr ? scene_ : meshes_.front());
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RTCRayHit query = asked.closest(rays[i]);
            hits[i] = is_hit(query) ? query.ray.tfar : std::numeric_limits<float>::infinity();
        }
    }
    [[nodiscard]] std::size_t bytes() const { return device_.bytes(); }

private:
    EmbreeDevice device_;
    std::vector<RTCScene> meshes_;
    RTCScene scene_ = nullptr;
};

}  // namespace

void add_embree_scene(const Placed& placed, SceneContest& to) {
    const auto scene = std::make_shared<EmbreeScene>(placed);
    to.push_back({"embree", "default", [scene](auto rays, auto hits) { scene->closest(rays, hits); }, scene->bytes()});
}

}  // namespace espalier::bench
