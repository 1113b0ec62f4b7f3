#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <cstring>

#include "stopwatch.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

// Bytes are what Embree's memory monitor says the device holds once the scene is committed: tree, vertices and indices.
// Building is the commit; the copies of the arrays into Embree's buffers are made before.
class EmbreeSystem final : public System {
public:
    EmbreeSystem(const Mesh& mesh, int flags) {
        device_ = rtcNewDevice("threads=1,set_affinity=0");
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, this);
        scene_ = rtcNewScene(device_);
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
        const Stopwatch watch;
        rtcCommitScene(scene_);
        seconds_ = watch.seconds();
    }
    ~EmbreeSystem() override {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
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
    void any(const std::vector<Ray>& rays, std::vector<std::uint8_t>& answers) override {
        const Mode mode;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            RTCRay query = to_ray(rays[i]);
            rtcOccluded1(scene_, &context, &query);
            answers[i] = query.tfar < 0.0f;
        }
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
    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    ssize_t bytes_ = 0;
    double seconds_ = 0.0;
};

}  // namespace

std::vector<Maker> embree_makers() {
    struct Mode {
        const char* profile;
        int flags;
    };
    const Mode modes[] = {
        {"default", RTC_SCENE_FLAG_NONE},
        {"compact", RTC_SCENE_FLAG_COMPACT},
        {"robust", RTC_SCENE_FLAG_ROBUST},
        {"compact+robust", RTC_SCENE_FLAG_COMPACT | RTC_SCENE_FLAG_ROBUST},
    };
    std::vector<Maker> makers;
    for (const Mode& mode : modes)
        makers.push_back({"embree", mode.profile, RTC_VERSION_STRING, [flags = mode.flags](const Mesh& mesh) {
                              return std::make_unique<EmbreeSystem>(mesh, flags);
                          }});
    return makers;
}

}  // namespace espalier::bench
