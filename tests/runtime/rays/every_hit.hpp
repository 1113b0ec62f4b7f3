// Every hit of a ray, for tests.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

/// Collects the hits before a test requires anything of them, because no exception may pass through the runtime.
inline std::vector<RayHit> every_hit(const Blob& blob, const Ray& ray) {
    std::vector<RayHit> hits;
    static_cast<void>(for_each_hit(blob, ray, [&](const RayHit& hit) { hits.push_back(hit); }));
    return hits;
}

}  // namespace espalier::tests
