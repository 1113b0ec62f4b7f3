// The questions that blobs of one source are compared by: the same for each of them, and the same on every machine.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>

#include "import/base/imported.hpp"
#include "point.hpp"

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

/// Every combination is baked.
struct TradeSpace {
    std::vector<unsigned> bits;
    std::vector<unsigned> leaf_sizes;  ///< a profile whose leaves are smaller takes its largest, once
    std::vector<float> byte_prices;
    std::vector<Profile> profiles;
    std::vector<Builder> builders;
    std::size_t rays = 0;
    unsigned repetitions = 0;
};

/// One point for each combination. `options` holds what all have in common. All blobs take turns in short slices, so
/// that a change of the machine's speed hits them alike; times are medians. `done` receives a stage and how much of
/// it is done, 0..1. Throws CommandError as bake_or_throw does, and (invalid_input) when the source has no triangle
/// with an area.
std::vector<TradePoint> measure_trade(const Imported& imported, const BakeOptions& options, const TradeSpace& space,
                                      const std::function<void(const char* stage, double done)>& done);

}  // namespace espalier::tools
