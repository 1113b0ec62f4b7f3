#include <algorithm>
#include <span>

#include <espalier/bake.hpp>
#include <espalier/ray.hpp>

#include "drop.hpp"
#include "support/meshes/mesh.hpp"
#include "support/base/random.hpp"

namespace espalier::bench {

std::vector<Body> make_bodies(const tests::Mesh& mesh) {
    tests::Random random(8);
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3& p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const auto between = [&](float from, float to) { return from + random.unit() * (to - from); };
    const MeshView view = mesh.view();
    const std::vector<std::byte> bytes = bake(std::span(&view, 1)).bytes;
    const Blob ground = open(bytes);
    std::vector<Body> bodies;
    while (bodies.size() < body_count) {
        const auto number = static_cast<float>(bodies.size());
        const Vec3 place = {between(low.x, high.x), between(low.y, high.y), high.z + 1.0f + 0.05f * number};
        const Ray down = {.origin = place, .direction = {0.0f, 0.0f, -1.0f}};
        if (raycast(ground, down))
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

}  // namespace espalier::bench
