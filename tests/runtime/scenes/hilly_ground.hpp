// A hilly ground of equal tiles, and rays aimed at the borders between them.
#pragma once

#include "maker.hpp"

namespace espalier::tests {

inline constexpr int tile_cells = 4;           ///< along a side of a tile, each 1 wide
inline constexpr int tile_step_exponent = -8;  ///< of a lattice that holds every vertex exactly

/// The height of the ground at a vertex: equal on opposite borders of a tile.
inline float height_at(int x, int z) {
    return static_cast<float>((7 * (x % tile_cells) + 13 * (z % tile_cells)) % 16) / 16.0f;
}

inline Mesh make_tile() {
    Mesh mesh;
    for (int z = 0; z <= tile_cells; ++z)
        for (int x = 0; x <= tile_cells; ++x)
            mesh.positions.push_back({static_cast<float>(x), height_at(x, z), static_cast<float>(z)});
    for (int z = 0; z < tile_cells; ++z)
        for (int x = 0; x < tile_cells; ++x) {
            const auto a = static_cast<std::uint32_t>(z * (tile_cells + 1) + x), b = a + tile_cells + 1;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    return mesh;
}

inline std::vector<OpenedBlob> opened_tile() {
    return opened_blobs({make_tile()},
                        {.resolution = Resolution::step(tile_step_exponent), .profile = Profile::balanced});
}

/// A ray from above onto so many tiles along each side, aimed at a vertex on a border between two of them, or at a
/// point of an edge there.
inline Ray aimed_at_border(Random& random, int side, const Vec3& from) {
    const auto below = [&](int limit) { return static_cast<int>(random.below(static_cast<std::uint32_t>(limit))); };
    const int border = tile_cells * (1 + below(side - 1)), along = 1 + below(tile_cells * side - 2);
    const float part = random.coin() ? 0.0f : random.unit();
    const bool is_along_x = random.coin();
    const auto vertex = [&](int place) {
        const int x = is_along_x ? place : border, z = is_along_x ? border : place;
        return Vec3{static_cast<float>(x), height_at(x, z), static_cast<float>(z)};
    };
    const Vec3 a = vertex(along), b = vertex(along + 1);
    const Vec3 to = sum(sum(from, a), times(difference(b, a), part));
    const float height = std::ldexp(1.0f + random.unit(), random.between(1, 9));
    const float slope = random.below(4) == 0 ? 0.0f : 0.3f;
    const Vec3 eye = {to.x + slope * height * random.signed_unit(), to.y + height,
                      to.z + slope * height * random.signed_unit()};
    Ray ray = Ray::between(eye, to);
    ray.t_max = infinity;
    return ray;
}

}  // namespace espalier::tests
