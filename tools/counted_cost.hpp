// What queries cost, by counters instead of clocks: the same number on every machine.
#pragma once

#include <span>

#include <espalier/bake.hpp>
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>

namespace espalier::tools {

/// Work of one closest-hit ray, on average.
struct CountedWork {
    double nodes = 0.0;
    double leaves = 0.0;
    double groups = 0.0;  ///< of up to 8 triangles of a leaf, which are tested together
    double triangles = 0.0;
    double candidates = 0.0;
};

/// Casts every ray by the scalar path.
CountedWork count_work(const Blob& blob, std::span<const Ray> rays);

/// The cost of that work in visits of a node of the fast profile: the same sum that the baker minimises, with visits
/// that were counted in place of areas, and without the price on bytes.
double counted_cost(const CountedWork& work, const CostModel& model, format::Profile profile);

}  // namespace espalier::tools
