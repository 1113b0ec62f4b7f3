#include "counted_cost.hpp"

namespace espalier::tools {

namespace {

/// How much dearer a visit is than one of the fast profile.
double decoding_factor(format::Profile profile) {
    switch (profile) {
        case format::Profile::fast:
            return 1.0;
        case format::Profile::balanced:
        case format::Profile::small:
            return 1.1;
    }
    return 1.0;
}

}  // namespace

CountedWork count_work(const Blob& blob, std::span<const Ray> rays) {
    QueryCounters counters;
    for (const Ray& ray : rays) {
        RayHit hit;
        raycast_counted(blob, ray, hit, counters);
    }
    if (rays.empty()) return {};
    const auto mean = [&](std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(rays.size()); };
    return {mean(counters.nodes), mean(counters.leaves), mean(counters.groups), mean(counters.triangles),
            mean(counters.candidates)};
}

double counted_cost(const CountedWork& work, const CostModel& model, format::Profile profile) {
    const double visits = work.nodes * double(model.node_visit) + work.leaves * double(model.leaf_visit) +
                          work.groups * double(model.leaf_group) + work.triangles * double(model.triangle);
    return decoding_factor(profile) * visits;
}

}  // namespace espalier::tools
