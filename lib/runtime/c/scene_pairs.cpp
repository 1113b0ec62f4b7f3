// espalier/c/scenes/pairs.h: pairs of instances that may touch, or do; and those of espalier/c/advanced/statistics.h.
#include <runtime/c/abi.hpp>
#include <runtime/c/scene_arguments.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

/// The pairs that a query returns. It must outlive the call.
class PairSelection {
public:
    explicit PairSelection(const espalier_pair_filter* filter)
        : keeps_(filter != nullptr ? *filter : espalier_pair_filter{}) {}

    [[nodiscard]] PairFilter filter() const {
        if (keeps_.filter.keep == nullptr) return {.only_moved = keeps_.filter.only_moved};
        return {keeps_.filter.only_moved, keeps_};
    }

private:
    struct Keeps {
        explicit Keeps(const espalier_pair_filter& from) : filter(from) {}
        bool operator()(InstanceId a, InstanceId b) const { return filter.keep(c(a), c(b), filter.user); }
        espalier_pair_filter filter;
    };
    Keeps keeps_;
};

/// Returns what `collect` returns for a moving scene and a baked one. Refuses one that is a view.
template <class Collect>
espalier_filled_baked_pairs collect_with(const espalier_scene* baked, espalier_baked_pair from, Collect collect) {
    if (is_view(cpp(baked))) return {0, from, ESPALIER_QUERY_INVALID_ARGUMENT};
    return c(collect(cpp(baked)));
}

}  // namespace

espalier_filled_instance_pairs espalier_collect_candidate_pairs(espalier_moving_scene* scene,
                                                                espalier_instance_pair* pairs, size_t capacity,
                                                                const espalier_pair_filter* filter,
                                                                espalier_instance_pair from) {
    const PairSelection selection(filter);
    return c(collect_candidate_pairs(cpp(scene), cpp(pairs, capacity), selection.filter(), cpp(from)));
}

espalier_filled_instance_pairs espalier_collect_colliding_pairs(espalier_moving_scene* scene,
                                                                espalier_instance_pair* pairs, size_t capacity,
                                                                uint64_t work_limit, const espalier_pair_filter* filter,
                                                                espalier_instance_pair from) {
    const PairSelection selection(filter);
    return c(collect_colliding_pairs(cpp(scene), cpp(pairs, capacity), WorkLimit(work_limit), selection.filter(),
                                     cpp(from)));
}

espalier_filled_instance_pairs espalier_collect_candidate_pairs_counted(espalier_moving_scene* scene,
                                                                        espalier_instance_pair* pairs, size_t capacity,
                                                                        espalier_scene_counters* counters,
                                                                        const espalier_pair_filter* filter,
                                                                        espalier_instance_pair from) {
    const PairSelection selection(filter);
    return c(collect_candidate_pairs(cpp(scene), cpp(pairs, capacity), cpp(counters), selection.filter(), cpp(from)));
}

espalier_filled_instance_pairs espalier_collect_colliding_pairs_counted(
    espalier_moving_scene* scene, espalier_instance_pair* pairs, size_t capacity, uint64_t work_limit,
    espalier_scene_counters* counters, espalier_pair_counters* of_triangles, const espalier_pair_filter* filter,
    espalier_instance_pair from) {
    const PairSelection selection(filter);
    return c(collect_colliding_pairs(cpp(scene), cpp(pairs, capacity), WorkLimit(work_limit), cpp(counters),
                                     cpp(of_triangles), selection.filter(), cpp(from)));
}

espalier_filled_baked_pairs espalier_collect_candidate_pairs_with_baked(const espalier_moving_scene* moving,
                                                                        const espalier_scene* baked,
                                                                        espalier_baked_pair* pairs, size_t capacity,
                                                                        const espalier_pair_filter* filter,
                                                                        espalier_baked_pair from) {
    const PairSelection selection(filter);
    return collect_with(baked, from, [&](const BakedScene& scene) {
        return collect_candidate_pairs(cpp(moving), scene, cpp(pairs, capacity), selection.filter(), cpp(from));
    });
}

espalier_filled_baked_pairs espalier_collect_colliding_pairs_with_baked(
    const espalier_moving_scene* moving, const espalier_scene* baked, espalier_baked_pair* pairs, size_t capacity,
    uint64_t work_limit, const espalier_pair_filter* filter, espalier_baked_pair from) {
    const PairSelection selection(filter);
    return collect_with(baked, from, [&](const BakedScene& scene) {
        return collect_colliding_pairs(cpp(moving), scene, cpp(pairs, capacity), WorkLimit(work_limit),
                                       selection.filter(), cpp(from));
    });
}
