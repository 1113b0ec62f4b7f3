// Whether the vertices of a source lie on the surface of a blob or a scene, within its max error.
#pragma once

#include <cstdint>
#include <string>

#include <espalier/blob.hpp>
#include <espalier/import.hpp>
#include <espalier/scene.hpp>

namespace espalier::tools {

struct VertexCheck {
    std::uint64_t vertices = 0;  ///< of sound triangles of the source, at all places
    std::uint64_t checked = 0;   ///< evenly spread over them
    std::uint64_t too_far = 0;
    double measuring_error = 0.0;  ///< what the measured distances may be too large by, at the worst vertex
    double worst_distance = 0.0;
    std::string worst;  ///< "level.obj, mesh 3 (walls), vertex 12"
};

/// Measures source vertices, as the files have them in float64, against the surface: all of them up to a hundred
/// thousand or so, else every so many. Vertices that are not finite are left out: they were dropped or refused.
VertexCheck check_vertices(const Blob& blob, const ImportResult& source);
VertexCheck check_vertices(const BakedScene& scene, const ImportResult& source);

}  // namespace espalier::tools
