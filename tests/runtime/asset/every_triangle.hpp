// Every triangle of a blob, for tests.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

/// Collects the triangles before a test requires anything of them, because no exception may pass through the runtime.
inline std::vector<Triangle> every_triangle(const Blob& blob) {
    std::vector<Triangle> triangles;
    CHECK(for_each_triangle(blob, [&](TriangleId triangle, const Triangle& corners) {
              CHECK(triangle.index == triangles.size());
              triangles.push_back(corners);
          }) == QueryStatus::ok);
    return triangles;
}

}  // namespace espalier::tests
