// The walk that most volumes share: the variant that suits the machine.
#include <runtime/traversal/volume.hpp>

#define ESPALIER_FRAGMENT <runtime/traversal/volume_queries.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier::detail {

bool find_overlaps_of_volume(const BlobData& blob, const Volume& volume, Each& answer, const WalkAccuracy& accuracy) {
    return ESPALIER_DISPATCH(find_overlaps_of_volume, blob, volume, answer, accuracy);
}

}  // namespace espalier::detail
