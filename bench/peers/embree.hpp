// Embree as every benchmark measures it: one thread, and meshes copied into its own buffers. Version 3 is that of a
// package, version 4 that of a checkout.
#pragma once

#ifdef ESPALIER_BENCH_IS_EMBREE4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <pmmintrin.h>
#include <xmmintrin.h>

#include "../base.hpp"

namespace espalier::bench {

class EmbreeDevice {
public:
    EmbreeDevice() : device_(rtcNewDevice("threads=1,set_affinity=0")) {
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, this);
    }
    ~EmbreeDevice() { rtcReleaseDevice(device_); }
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    [[nodiscard]] RTCDevice get() const { return device_; }
    /// Returns what Embree's memory monitor states: trees, vertices and indices of the scenes that are committed.
    [[nodiscard]] std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }

    /// Returns a scene with a copy of the mesh, to be committed and released by the caller.
    [[nodiscard]] RTCScene new_scene(const Mesh& mesh) const {
        const auto copy = [&](void* vertices, void* corners) {
            std::memcpy(vertices, mesh.positions.data(), 12 * mesh.positions.size());
            std::memcpy(corners, mesh.triangles.data(), 12 * mesh.triangles.size());
        };
        return new_scene(mesh.positions.size(), mesh.triangles.size(), RTC_BUILD_QUALITY_MEDIUM, copy);
    }
    /// The same with what `fill(vertices, corners)` writes straight into Embree's own buffers.
    template <class Fill>
    [[nodiscard]] RTCScene new_scene(std::size_t vertices, std::size_t triangles, RTCBuildQuality quality,
                                     const Fill& fill) const {
        RTCScene scene = rtcNewScene(device_);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        fill(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertices),
             rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles));
        rtcSetGeometryBuildQuality(geometry, quality);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        return scene;
    }

private:
    static bool count_bytes(void* self, ssize_t bytes, bool) {
        static_cast<EmbreeDevice*>(self)->bytes_ += bytes;
        return true;
    }

    ssize_t bytes_ = 0;
    RTCDevice device_;
};

/// The processor's mode that Embree requires for its rays, from construction to destruction. The other systems are
/// measured without it.
class FlushToZero {
public:
    FlushToZero() : before_(_mm_getcsr()) { _mm_setcsr(before_ | 0x8040u); }
    ~FlushToZero() { _mm_setcsr(before_); }
    FlushToZero(const FlushToZero&) = delete;
    FlushToZero& operator=(const FlushToZero&) = delete;

private:
    unsigned before_;
};

inline RTCRay embree_ray(const Ray& ray) {
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

/// Rays in a scene, in the processor's mode that Embree requires, from construction to destruction.
class EmbreeRays {
public:
    explicit EmbreeRays(RTCScene scene, bool coherent = false) : scene_(scene) {
#if RTC_VERSION_MAJOR >= 4
        rtcInitIntersectArguments(&closest_);
        rtcInitOccludedArguments(&any_);
        if (coherent) closest_.flags = any_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
#else
        rtcInitIntersectContext(&context_);
        if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif
    }
    /// Returns the query with its answer: one without an id is a miss.
    [[nodiscard]] RTCRayHit closest(const Ray& ray) {
        RTCRayHit query;
        query.ray = embree_ray(ray);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene_, &query, &closest_);
#else
        rtcIntersect1(scene_, &context_, &query);
#endif
        return query;
    }
    [[nodiscard]] bool hits_any(const Ray& ray) {
        RTCRay query = embree_ray(ray);
#if RTC_VERSION_MAJOR >= 4
        rtcOccluded1(scene_, &query, &any_);
#else
        rtcOccluded1(scene_, &context_, &query);
#endif
        return query.tfar < 0.0f;
    }

private:
    const FlushToZero mode_;
    RTCScene scene_;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments closest_;
    RTCOccludedArguments any_;
#else
    RTCIntersectContext context_;
#endif
};

inline bool is_hit(const RTCRayHit& query) { return query.hit.geomID != RTC_INVALID_GEOMETRY_ID; }

}  // namespace espalier::bench
