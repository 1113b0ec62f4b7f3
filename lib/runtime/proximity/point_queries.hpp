// The queries by distance in lattice units, once for each instruction set.
#pragma once

#include <runtime/answers/answer.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/proximity/closest_pair.hpp>
#include <runtime/proximity/triangle_gap.hpp>

namespace espalier::detail {

// find_overlaps: triangles of which something is within the radius, in storage order; true when the answer stopped it.
// find_nearest: triangles within the radius as FoundNearest, the nearest first; find_nearest_pair: as FoundPair.
ESPALIER_IN_EACH_SET(
    bool find_overlaps(const BlobData& blob, const RoundedPoint& sphere, Each& answer, const WalkAccuracy& accuracy);
    void find_nearest(const BlobData& blob, const RoundedPoint& point, Answer& answer, const WalkAccuracy& accuracy);
    void find_nearest_pair(const BlobData& blob, const DistantShape& shape, float reach, Answer& answer);)

}  // namespace espalier::detail
