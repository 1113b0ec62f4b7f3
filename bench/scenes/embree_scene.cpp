#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cstring>

#include "scene_system.hpp"

namespace espalier::bench {
namespace {

// Bytes are what Embree's memory monitor states once everything is committed.
class EmbreeScene final : public SceneSystem {
public:
    explicit EmbreeScene(const Placed& placed) {
        device_ = rtcNewDevice("threads=1,set_affinity=0");
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, this);
        for (const Mesh& mesh : placed.meshes) meshes_.push_back(commit(mesh));
        if (placed.instances.empty()) return;
        scene_ = rtcNewScene(device_);
        for (const Instance& instance : placed.instances) {
            RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
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
    ~EmbreeScene() override {
        if (scene_ != nullptr) rtcReleaseScene(scene_);
        for (RTCScene mesh : meshes_) rtcReleaseScene(mesh);
        rtcReleaseDevice(device_);
    }
    void closest(const std::vector<Ray>& rays, std::vector<float>& hits) override {
        // Embree asks for flush-to-zero; the others are measured without.
        const unsigned before = _mm_getcsr();
        _mm_setcsr(before | 0x8040u);
        RTCScene scene = scene_ != nullptr ? scene_ : meshes_.front();
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray& ray = rays[i];
            RTCRayHit query;
            query.ray = {ray.origin.x,
                         ray.origin.y,
                         ray.origin.z,
                         ray.t_min,
                         ray.direction.x,
                         ray.direction.y,
                         ray.direction.z,
                         0.0f,
                         ray.t_max,
                         ~0u,
                         0,
                         0};
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &query);
            hits[i] = query.hit.geomID != RTC_INVALID_GEOMETRY_ID ? query.ray.tfar : miss;
        }
        _mm_setcsr(before);
    }
    [[nodiscard]] std::size_t bytes() const override { return static_cast<std::size_t>(bytes_); }

private:
    RTCScene commit(const Mesh& mesh) {
        RTCScene scene = rtcNewScene(device_);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size());
        std::memcpy(vertices, mesh.positions.data(), 12 * mesh.positions.size());
        void* indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size());
        std::memcpy(indices, mesh.triangles.data(), 12 * mesh.triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        return scene;
    }
    static bool count_bytes(void* self, ssize_t bytes, bool) {
        static_cast<EmbreeScene*>(self)->bytes_ += bytes;
        return true;
    }

    RTCDevice device_ = nullptr;
    std::vector<RTCScene> meshes_;
    RTCScene scene_ = nullptr;
    ssize_t bytes_ = 0;
};

}  // namespace

std::vector<SceneMaker> embree_scene_makers() {
    return {{"embree", "default", [](const Placed& placed) { return std::make_unique<EmbreeScene>(placed); }}};
}

}  // namespace espalier::bench
