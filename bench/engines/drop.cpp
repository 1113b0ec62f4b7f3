#include "drop.hpp"

#include "support/base/random.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::bench {

std::vector<Body> make_bodies(const tests::Mesh& mesh) {
    tests::Random random(8);
    const auto [low, high] = box_around(mesh.positions);
    const auto between = [&](float from, float to) { return from + random.unit() * (to - from); };
    const BakedBlob ground = bake_blob(mesh);
    std::vector<Body> bodies;
    while (bodies.size() < body_count) {
        const auto number = static_cast<float>(bodies.size());
        const Vec3 place = {between(low.x, high.x), between(low.y, high.y), high.z + 1.0f + 0.05f * number};
        const Ray down = {.origin = place, .direction = {0.0f, 0.0f, -1.0f}};
        if (raycast(ground.blob, down))
            bodies.push_back({static_cast<Body::Kind>(bodies.size() % 3), between(0.15f, 0.4f), place});
    }
    return bodies;
}

void add_rest(Drop& drop, const std::array<double, 3>& place, double speed) {
    drop.rest.push_back(place);
    if (place[2] < lost_below) {
        ++drop.lost;
        return;
    }
    drop.moving += speed > 0.05 ? 1u : 0u;
    drop.energy += 0.5 * speed * speed;
}

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
