#include "drop.hpp"

namespace espalier::bench {

#if defined(ESPALIER_BENCH_BULLET)
Drop drop_in_bullet(const tests::Mesh& mesh, const Blob& blob);
#endif
#if defined(ESPALIER_BENCH_ODE)
Drop drop_in_ode(const tests::Mesh& mesh, const Blob& blob);
#endif

std::vector<Engine> engines() {
    return {
#if defined(ESPALIER_BENCH_BULLET)
        {"Bullet", drop_in_bullet},
#endif
#if defined(ESPALIER_BENCH_ODE)
            {"ODE", drop_in_ode},
#endif
    };
}

}  // namespace espalier::bench
