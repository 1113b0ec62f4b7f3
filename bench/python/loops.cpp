// Plain loops of C++ over arrays, one query at a time: what the batches of Python are measured against.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

using namespace espalier;

namespace {

const Blob& opened(const void* bytes, std::size_t size) {
    static Blob blob;
    blob = open({static_cast<const std::byte*>(bytes), size});
    return blob;
}

}  // namespace

extern "C" {

void loop_raycast_sources(const void* bytes, std::size_t size, std::size_t count, const Vec3* origins,
                          const Vec3* directions, RayHit* hits, double* places, OriginalHit* sources) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) {
        hits[i] = raycast(blob, {origins[i], directions[i]});
        sources[i] = original_hit(blob, hits[i]);
        places[3 * i] =
            static_cast<double>(origins[i].x) + static_cast<double>(hits[i].t) * static_cast<double>(directions[i].x);
        places[3 * i + 1] =
            static_cast<double>(origins[i].y) + static_cast<double>(hits[i].t) * static_cast<double>(directions[i].y);
        places[3 * i + 2] =
            static_cast<double>(origins[i].z) + static_cast<double>(hits[i].t) * static_cast<double>(directions[i].z);
    }
}

void loop_raycast(const void* bytes, std::size_t size, std::size_t count, const Vec3* origins, const Vec3* directions,
                  RayHit* hits) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) hits[i] = raycast(blob, {origins[i], directions[i]});
}

void loop_occluded(const void* bytes, std::size_t size, std::size_t count, const Vec3* origins, const Vec3* directions,
                   YesNo* answers) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) answers[i] = occluded(blob, {origins[i], directions[i]});
}

void loop_all_hits(const void* bytes, std::size_t size, std::size_t count, const Vec3* origins, const Vec3* directions,
                   std::size_t* total) {
    const Blob& blob = opened(bytes, size);
    std::vector<RayHit> all;
    for (std::size_t i = 0; i < count; ++i)
        static_cast<void>(
            for_each_hit(blob, {origins[i], directions[i]}, [&](const RayHit& hit) { all.push_back(hit); }));
    *total = all.size();
}

void loop_closest_point(const void* bytes, std::size_t size, std::size_t count, const Vec3* points, const Vec3*,
                        ClosestPoint* nearest) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) nearest[i] = closest_point(blob, points[i]);
}

void loop_signed_distance(const void* bytes, std::size_t size, std::size_t count, const Vec3* points, const Vec3*,
                          ClosestPoint* nearest) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) nearest[i] = signed_distance(blob, points[i]);
}

void loop_contains(const void* bytes, std::size_t size, std::size_t count, const Vec3* points, const Vec3*,
                   YesNo* answers) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) answers[i] = contains(blob, points[i]);
}

void loop_overlaps(const void* bytes, std::size_t size, std::size_t count, const Vec3* points, const Vec3*,
                   YesNo* answers) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) answers[i] = overlaps(blob, Sphere{points[i], 0.1f});
}

void loop_overlapping_triangles(const void* bytes, std::size_t size, std::size_t count, const Vec3* points, const Vec3*,
                                std::size_t* total) {
    const Blob& blob = opened(bytes, size);
    std::vector<TriangleId> all;
    for (std::size_t i = 0; i < count; ++i)
        static_cast<void>(for_each_overlap(blob, Sphere{points[i], 0.1f},
                                           [&](TriangleId triangle, const Triangle&) { all.push_back(triangle); }));
    *total = all.size();
}

void loop_sweep(const void* bytes, std::size_t size, std::size_t count, const Vec3* points, const Vec3* directions,
                SweepHit* hits) {
    const Blob& blob = opened(bytes, size);
    for (std::size_t i = 0; i < count; ++i) hits[i] = sweep(blob, Sphere{points[i], 0.1f}, directions[i]);
}

}  // extern "C"
