// Bakes one source in many ways and measures them side by side.
#pragma once

#include <functional>
#include <vector>

#include "import/base/imported.hpp"
#include "point.hpp"

namespace espalier::tools {

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
