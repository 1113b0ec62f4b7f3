#include "drop.hpp"

namespace espalier::bench {

#if defined(ESPALIER_BENCH_BULLET)
Drop drop_in_bullet(const tests::Mesh& mesh, const Blob& blob);
#endif
#if defined(ESPALIER_BENCH_ODE)
Drop drop_in_ode(const tests::Mesh& mesh, const Blob& blob);
#endif
#if defined(ESPALIER_BENCH_JOLT)
Drop drop_in_jolt(const tests::Mesh& mesh, const Blob& blob);
#endif

std::vector<Engine> engines() {
    return {
#if defined(ESPALIER_BENCH_BULLET)
        {"Bullet", drop_in_bullet},
#endif
#if defined(ESPALIER_BENCH_ODE)
            {"ODE", drop_in_ode},
#endif
#if defined(ESPALIER_BENCH_JOLT)
            {"Jolt", drop_in_jolt},
#endif
    };
}

}  // namespace espalier::bench
