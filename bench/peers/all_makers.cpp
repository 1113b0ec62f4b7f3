#include <iterator>

#include "system.hpp"

namespace espalier::bench {

std::vector<Maker> all_makers(const BakeSettings& settings) {
    std::vector<Maker> all;
    const auto insert = [&all](std::size_t place, std::vector<Maker> more) {
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(place), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
    };
#if defined(ESPALIER_BENCH_EMBREE)
    insert(0, embree_makers());
#endif
    // Right behind the reference, whose default comes first: the closer in time, the less a ratio is disturbed.
    insert(all.empty() ? 0 : 1, espalier_makers(settings));
#if defined(ESPALIER_BENCH_BULLET)
    insert(all.size(), bullet_makers());
#endif
#if defined(ESPALIER_BENCH_ODE)
    insert(all.size(), ode_makers());
#endif
#if defined(ESPALIER_BENCH_FCL)
    insert(all.size(), fcl_makers());
#endif
#if defined(ESPALIER_BENCH_EMBREE4)
    insert(all.size(), embree4_makers());
#endif
#if defined(ESPALIER_BENCH_TINYBVH)
    insert(all.size(), tinybvh_makers());
#endif
#if defined(ESPALIER_BENCH_JOLT)
    insert(all.size(), jolt_makers());
#endif
#if defined(ESPALIER_BENCH_BOX3D)
    insert(all.size(), box3d_makers());
#endif
    return all;
}

bool is_reference(const Maker& maker) { return maker.name == "embree" && maker.profile == "default"; }

}  // namespace espalier::bench
