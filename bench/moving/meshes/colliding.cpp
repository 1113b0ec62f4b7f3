#include "colliding.hpp"

#include <algorithm>
#include <stdexcept>

#include "../table.hpp"

namespace espalier::bench {
namespace {

/// Brings the mesh into a unit cube around the origin.
void fit_into_unit_cube(tests::Mesh& mesh) {
    if (mesh.positions.empty()) throw std::runtime_error(mesh.name + ": has no vertices");
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3& p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const float longest = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    const Vec3 middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), 0.5f * (low.z + high.z)};
    for (Vec3& p : mesh.positions)
        p = {(p.x - middle.x) / longest, (p.y - middle.y) / longest, (p.z - middle.z) / longest};
}

}  // namespace

void print_bunnies(const Scenario& scenario, tests::Mesh mesh) {
    fit_into_unit_cube(mesh);
    BroadPhaseMakers makers = espalier_colliding_makers();
#ifdef ESPALIER_BENCH_FCL
    for (BroadPhaseMaker& maker : fcl_colliding_makers(mesh)) makers.push_back(std::move(maker));
#endif
    BakeOptions options;
    options.profile = Profile::fast;
    const BakeResult baked = bake(std::array{mesh.view()}, options);
    if (!baked) throw std::runtime_error(baked.message);
    print_steps(measure(selected(std::move(makers), scenario), scenario, baked, true), scenario,
                "collisions of " + mesh.name);
}

}  // namespace espalier::bench
