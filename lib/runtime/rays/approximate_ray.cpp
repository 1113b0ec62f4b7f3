// Whether a ray may hit the surface, by a walk that stops at small boxes, in the caller's units.
#include <espalier/approximate.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/traversal/small_boxes.hpp>

namespace espalier {

using namespace detail;

YesNo occluded(const Blob& blob, const Ray& ray, Accuracy accuracy, QueryCounters* counters) noexcept {
    const WalkAccuracy for_walk = {steps_in(data_of(blob), accuracy.distance), counters};
    return ESPALIER_DISPATCH_RAY(may_hit, data_of(blob), ray, for_walk);
}

}  // namespace espalier
