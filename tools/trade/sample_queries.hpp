// The questions that blobs of one source are compared by: the same for each of them, and the same on every machine.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>

#include "import/base/imported.hpp"

namespace espalier::tools {

struct SampleQueries {
    /// From a sphere of 1.2 radii around the source towards random points in its box; both the
    /// closest and any hit are queried.
    std::vector<Ray> rays;
    /// Of a fortieth of the box's diagonal, around points up to a twentieth of it beside the surface.
    std::vector<Sphere> spheres;
    /// On the source's surface, evenly by area.
    std::vector<Vec3> surface_points;
};

/// As many of each as `count`; none when the source has no sound triangle with an area. Every machine makes
/// the same queries: the arithmetic rounds alike everywhere, and the generator is our own.
SampleQueries make_sample_queries(const Imported& source, std::size_t count);

}  // namespace espalier::tools
