#include "../peers/box3d.hpp"
#include "sweeps.hpp"

namespace espalier::bench {

// A shape that starts in a contact has none there, by its documentation.
Sweeps box3d_sweeps(const Mesh& mesh, std::span<const Moving>) {
    const auto own = std::make_shared<Box3dMesh>(mesh);
    return [own](std::span<const Moving> all, std::span<float> contacts) {
        const b3Mesh shape = own->get();
        std::array<b3Vec3, max_hull_vertices> vertices;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Moving& moving = all[i];
            std::transform(moving.vertices.begin(), moving.vertices.end(), vertices.begin(), to_box3d);
            const b3ShapeCastInput query = {
                {vertices.data(), static_cast<int>(moving.vertices.size()), 0.0f}, to_box3d(moving.way), 1.0f, false};
            contacts[i] = b3ShapeCastMesh(&shape, &query).fraction;
        }
    };
}

}  // namespace espalier::bench
