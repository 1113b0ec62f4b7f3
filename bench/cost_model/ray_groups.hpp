// Rays sorted into groups of like work, and what each group costs.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>

namespace espalier::bench {

/// Means of one ray of the group.
struct RayGroup {
    Blob blob;
    std::vector<Ray> rays;
    double nodes = 0.0;
    double leaves = 0.0;
    double groups = 0.0;  ///< of 8 triangles
    double triangles = 0.0;
    double nanoseconds = 0.0;
};

/// Equal shares by nodes visited, and each of these in equal shares by triangles. Within a group the rays keep their
/// order, so that incoherent ones stay incoherent.
std::vector<RayGroup> group_by_work(const Blob& blob, const std::vector<Ray>& rays);

/// Casts all groups in turn, again and again. A group's time is the median over the rounds of its ratio to the round's
/// median, times the median of these: a machine that is busy elsewhere for a while slows whole rounds down.
void time_groups(std::vector<RayGroup>& groups, unsigned rounds);

}  // namespace espalier::bench
