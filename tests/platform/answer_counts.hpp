// What was asked and found, and how a triangle enters the hash.
#pragma once

#include <cstdint>

#include <espalier/espalier.hpp>

#include "fingerprint.hpp"

namespace espalier::platform {

/// What was asked and found. The counts show that the hash is not one of "nothing" a thousand times.
struct Answers {
    Fingerprint fingerprint;
    std::uint32_t calls = 0;  // of any function that answers
    std::uint32_t rays = 0, rays_hit = 0, hits = 0, spheres = 0, overlaps = 0, points = 0, points_found = 0;
    std::uint32_t pairs_near = 0;  // of two placed blobs

    constexpr void add(const Answers& part) {
        fingerprint.add(part.fingerprint);
        calls += part.calls;
        rays += part.rays;
        rays_hit += part.rays_hit;
        hits += part.hits;
        spheres += part.spheres;
        overlaps += part.overlaps;
        points += part.points;
        points_found += part.points_found;
        pairs_near += part.pairs_near;
    }
};

/// Returns the number that the status of a lookup had when golden.txt was recorded.
constexpr std::uint32_t lookup_word(QueryStatus status) {
    return status == QueryStatus::invalid_argument ? 1
           : status == QueryStatus::not_found      ? 7
           : status == QueryStatus::not_open       ? 8
           : status == QueryStatus::no_data        ? 9
                                                   : 0;
}

inline void add_triangle(Fingerprint& fingerprint, const Blob& blob, TriangleId triangle) {
    const Result<OriginalTriangle> original = original_triangle(blob, triangle);
    fingerprint.add(triangle.index, static_cast<bool>(original), original->file, original->mesh, original->triangle,
                    original->first_corner, std::uint32_t{material(blob, triangle)});
}

}  // namespace espalier::platform
