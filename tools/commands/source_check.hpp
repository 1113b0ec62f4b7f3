// Tests promise P3 on the blob itself: the source lies within max_error of the baked surface.
#pragma once

#include <cstdint>
#include <string>

#include <espalier/blob.hpp>
#include <espalier/scene.hpp>

#include "import/base/imported.hpp"

namespace espalier::tools {

struct SourceCheck {
    std::uint64_t vertices = 0;  ///< of triangles of the source
    std::uint64_t checked = 0;   ///< evenly spread over them; none when the blob or scene is empty
    std::uint64_t too_far = 0;
    std::uint64_t triangles_with_area = 0;
    double measuring_error = 0.0;  ///< what the measured distances may be too large by, at the worst vertex
    double worst_distance = 0.0;
    std::string worst;  ///< "level.obj, mesh 3 (walls), vertex 12"
};

/// Whether anything of the source should be in a blob at all is left to the caller: triangles_with_area.
/// Measures source vertices against the surface with closest_point: all of them up to a hundred thousand or so, else
/// every so many. Vertices that are not finite are left out: they were dropped or refused.
SourceCheck check_source(const Blob& blob, const Imported& source);

/// The same for a scene, and for the source with every mesh at its places.
SourceCheck check_source(const BakedScene& scene, const Imported& source);

}  // namespace espalier::tools
