// Rays sorted into groups of like work, and what each group costs.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>

namespace espalier::bench {

/// Means of one ray of the group.
struct RayGroup {
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

/// Casts all groups in turn, again and again; a group's time is its median.
void time_groups(const Blob& blob, std::vector<RayGroup>& groups, unsigned repetitions);

}  // namespace espalier::bench
