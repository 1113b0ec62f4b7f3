// Reading the two formats of the usual research meshes without the baker's importer: Wavefront OBJ (triangles fanned)
// and binary little-endian PLY (float positions first, triangle lists).
#pragma once

#include <string>
#include <vector>

#include <espalier/bake.hpp>

namespace espalier::bench {

struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;
};

/// Exits with a message when the file cannot be read: this is a benchmark.
Mesh read_mesh(const std::string& path);

}  // namespace espalier::bench
