// What queries cost, by counters instead of clocks: the same number on every machine.
#pragma once

#include <span>

#include <espalier/format.hpp>
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>

namespace espalier::tools {

/// Work of one closest-hit ray, on average.
struct CountedWork {
    double nodes = 0.0;
    double leaves = 0.0;
    double triangles = 0.0;
    double candidates = 0.0;
};

/// Casts every ray by the scalar path.
CountedWork count_work(const Blob& blob, std::span<const Ray> rays);

/// The cost of that work in visits of a node of the fast profile, by committed constants, which do not depend on the
/// options of the bake.
double counted_cost(const CountedWork& work, Profile profile);

}  // namespace espalier::tools
