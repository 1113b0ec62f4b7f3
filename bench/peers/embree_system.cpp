#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <chrono>
#include <cstring>

#include "system.hpp"

namespace espalier::bench {
namespace {

class EmbreeSystem final : public System {
public:
    EmbreeSystem(const Mesh& mesh, EmbreeMode mode) : mode_(mode) {
        device_ = rtcNewDevice("threads=1,set_affinity=0");
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, this);
        scene_ = rtcNewScene(device_);
        int flags = RTC_SCENE_FLAG_NONE;
        if (mode == EmbreeMode::compact || mode == EmbreeMode::compact_robust) flags |= RTC_SCENE_FLAG_COMPACT;
        if (mode == EmbreeMode::robust || mode == EmbreeMode::compact_robust) flags |= RTC_SCENE_FLAG_ROBUST;
        rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(flags));
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size());
        std::memcpy(vertices, mesh.positions.data(), 12 * mesh.positions.size());
        void* indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size());
        std::memcpy(indices, mesh.triangles.data(), 12 * mesh.triangles.size());
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        const auto start = std::chrono::steady_clock::now();
        rtcCommitScene(scene_);
        seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    ~EmbreeSystem() override {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    [[nodiscard]] const char* name() const override { return "embree"; }
    [[nodiscard]] const char* profile() const override {
        switch (mode_) {
            case EmbreeMode::fast:
                return "default";
            case EmbreeMode::compact:
                return "compact";
            case EmbreeMode::robust:
                return "robust";
            case EmbreeMode::compact_robust:
                return "compact+robust";
        }
        return "";
    }
    [[nodiscard]] std::size_t bytes() const override { return static_cast<std::size_t>(bytes_); }
    [[nodiscard]] double build_seconds() const override { return seconds_; }
    void closest(const std::vector<Ray>& rays, bool coherent, std::vector<Hit>& hits) override {
        const Mode mode;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RTCRayHit query;
            query.ray = to_ray(rays[i]);
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene_, &context, &query);
            hits[i].found = query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
            if (hits[i].found)
                hits[i] = {true,
                           query.ray.tfar,
                           query.hit.u,
                           query.hit.v,
                           Vec3{query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z},
                           query.hit.primID};
        }
    }
    std::size_t any(const std::vector<Ray>& rays) override {
        const Mode mode;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        std::size_t count = 0;
        for (const Ray& ray : rays) {
            RTCRay query = to_ray(ray);
            rtcOccluded1(scene_, &context, &query);
            count += query.tfar < 0.0f;
        }
        return count;
    }

private:
    /// Embree asks for flush-to-zero; the others are measured without.
    struct Mode {
        Mode() : before(_mm_getcsr()) { _mm_setcsr(before | 0x8040u); }
        ~Mode() { _mm_setcsr(before); }
        unsigned before;
    };
    static bool count_bytes(void* self, ssize_t bytes, bool) {
        static_cast<EmbreeSystem*>(self)->bytes_ += bytes;
        return true;
    }
    static RTCRay to_ray(const Ray& ray) {
        RTCRay query;
        query.org_x = ray.origin.x;
        query.org_y = ray.origin.y;
        query.org_z = ray.origin.z;
        query.tnear = ray.t_min;
        query.dir_x = ray.direction.x;
        query.dir_y = ray.direction.y;
        query.dir_z = ray.direction.z;
        query.time = 0.0f;
        query.tfar = ray.t_max;
        query.mask = ~0u;
        query.id = 0;
        query.flags = 0;
        return query;
    }
    EmbreeMode mode_;
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    ssize_t bytes_ = 0;
    double seconds_ = 0.0;
};

}  // namespace

std::unique_ptr<System> make_embree(const Mesh& mesh, EmbreeMode mode) {
    return std::make_unique<EmbreeSystem>(mesh, mode);
}

}  // namespace espalier::bench
