#include <iterator>
#include <utility>

#include "system.hpp"

namespace espalier::bench {

std::vector<Maker> all_makers(const BakeSettings& settings) {
    std::vector<Maker> all;
    const auto append = [&all](std::vector<Maker> more) {
        for (Maker& maker : more) all.push_back(std::move(maker));
    };
#if defined(ESPALIER_BENCH_EMBREE)
    append(embree_makers());
#endif
    // Right behind the reference, whose default comes first: the closer in time, the less a ratio is disturbed.
    std::vector<Maker> own = espalier_makers(settings);
    all.insert(all.empty() ? all.end() : all.begin() + 1, std::make_move_iterator(own.begin()),
               std::make_move_iterator(own.end()));
#if defined(ESPALIER_BENCH_BULLET)
    append(bullet_makers());
#endif
#if defined(ESPALIER_BENCH_ODE)
    append(ode_makers());
#endif
#if defined(ESPALIER_BENCH_FCL)
    append(fcl_makers());
#endif
    return all;
}

bool is_reference(const Maker& maker) { return maker.name == "embree" && maker.profile == "default"; }

}  // namespace espalier::bench
