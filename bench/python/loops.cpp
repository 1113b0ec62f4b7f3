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

/// A loop of which `expression` is one turn, over two arrays of vectors.
#define LOOP(name, Answer, expression)                                                                     \
    void loop_##name(const void* bytes, std::size_t size, std::size_t count, const Vec3* a, const Vec3* b, \
                     Answer* answers) {                                                                    \
        const Blob& blob = opened(bytes, size);                                                            \
        for (std::size_t i = 0; i < count; ++i, ++a, ++b) answers[i] = expression;                         \
    }
LOOP(raycast, RayHit, raycast(blob, {*a, *b}))
LOOP(occluded, YesNo, occluded(blob, {*a, *b}))
LOOP(closest_point, ClosestPoint, closest_point(blob, *a))
LOOP(signed_distance, ClosestPoint, signed_distance(blob, *a))
LOOP(contains, YesNo, contains(blob, *a))
LOOP(overlaps, YesNo, overlaps(blob, Sphere{*a, 0.1f}))
LOOP(sweep, SweepHit, sweep(blob, Sphere{*a, 0.1f}, *b))
#undef LOOP

void loop_all_hits(const void* bytes, std::size_t size, std::size_t count, const Vec3* origins, const Vec3* directions,
                   std::size_t* total) {
    const Blob& blob = opened(bytes, size);
    std::vector<RayHit> all;
    for (std::size_t i = 0; i < count; ++i)
        static_cast<void>(
            for_each_hit(blob, {origins[i], directions[i]}, [&](const RayHit& hit) { all.push_back(hit); }));
    *total = all.size();
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

}  // extern "C"
