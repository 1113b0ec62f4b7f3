// The walk that most shapes share.
#ifndef ESPALIER_TRAVERSAL_VOLUME_QUERIES_HPP
#define ESPALIER_TRAVERSAL_VOLUME_QUERIES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/volume_shape.hpp>

ESPALIER_BEGIN_SET

ESPALIER_QUERY_OF_SET bool find_overlaps_of_volume(const BlobData& blob, const Volume& volume, Each& answer,
                                                   const WalkAccuracy& accuracy) {
    VolumeShape shape = {blob, volume};
    return find_each<Each>(blob, shape, answer, accuracy);
}

ESPALIER_END_SET

#endif
