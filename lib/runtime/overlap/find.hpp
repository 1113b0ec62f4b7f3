// How most shapes find what they overlap: the file of each shape instantiates it.
#pragma once

#include <runtime/traversal/volume.hpp>

namespace espalier::detail {

/// Returns stopped if the answer stopped it.
template <OverlapShape Shape>
QueryStatus find_overlaps_in_volume(const BlobData& blob, const void* shape, Each& answer,
                                    const WalkAccuracy& accuracy) {
    Rounded<Shape> volume;
    const QueryStatus status = round_volume(blob, *static_cast<const Shape*>(shape), volume);
    if (status == QueryStatus::not_found) return QueryStatus::ok;
    if (status != QueryStatus::ok || blob.triangle_count == 0) return status;
    return find_overlaps_of_volume(blob, volume, answer, accuracy) ? QueryStatus::stopped : QueryStatus::ok;
}

template <OverlapShape Shape>
QueryStatus find_overlaps_of(const BlobData& blob, const void* shape, Each& answer, const WalkAccuracy& accuracy) {
    return find_overlaps_in_volume<Shape>(blob, shape, answer, accuracy);
}

}  // namespace espalier::detail
