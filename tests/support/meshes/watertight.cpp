#include "watertight.hpp"

#include <cmath>
#include <utility>

#include "makers.hpp"

namespace espalier::tests {

namespace {

/// From 2^-`halvings` to 1, each order of magnitude as often.
float some_size(Random& random, std::uint32_t halvings) {
    return std::ldexp(1.0f + random.unit(), -1 - static_cast<int>(random.below(halvings)));
}

Mesh some_base(Random& random) {
    switch (random.below(5)) {
        case 0:
            return make_cube(0.0f, 1.0f);
        case 1:
            return make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f});
        case 2:
            return make_torus(8, 5, 1.0, 0.3);
        case 3:
            return make_uv_sphere(4, 9, 1.0, {0.25f, 0.5f, 0.0f});
        default:
            return make_sliver_pyramid();
    }
}

/// A turned, stretched, sheared copy: no axis of the lattice is special to it.
void transform(Mesh& mesh, Random& random) {
    Vec3 axes[3];
    for (Vec3& row : axes) row = random.in_cube(1.0f);
    const Vec3 stretch = {some_size(random, 3), some_size(random, 3), some_size(random, 12)};  // thin along one
    for (Vec3& p : mesh.positions) {
        const Vec3 s = {p.x * stretch.x, p.y * stretch.y, p.z * stretch.z};
        const auto along = [&](const Vec3& row) { return row.x * s.x + row.y * s.y + row.z * s.z; };
        p = {along(axes[0]), along(axes[1]), along(axes[2])};
    }
}

/// Each edge in two, at points beside their middles; triangles in four. Corners are shared by index.
void split_edges(Mesh& mesh, Random& random) {
    std::vector<std::pair<TriangleVertices, std::uint32_t>> middles;  // the ends, the lower first, and the vertex
    const auto middle = [&](std::uint32_t from, std::uint32_t to) {
        if (from > to) std::swap(from, to);
        for (const auto& [ends, vertex] : middles)
            if (ends[0] == from && ends[1] == to) return vertex;
        const Vec3 &a = mesh.positions[from], &b = mesh.positions[to];
        const float share = 0.25f + 0.5f * random.unit();
        const Vec3 off = random.in_cube(some_size(random, 16) * 0.1f);
        const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(
            {a.x + (b.x - a.x) * share + off.x, a.y + (b.y - a.y) * share + off.y, a.z + (b.z - a.z) * share + off.z});
        middles.push_back({{from, to, 0}, vertex});
        return vertex;
    };
    const std::vector<TriangleVertices> triangles = std::exchange(mesh.triangles, {});
    for (const auto& [a, b, c] : triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        mesh.triangles.insert(mesh.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
}

}  // namespace

Mesh make_sliver_pyramid() {
    Mesh mesh;
    mesh.name = "sliver pyramid";
    mesh.positions = {
        {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.5f, -1e-6f, 0.0f}};
    mesh.triangles = {{0, 1, 2}, {0, 4, 1}, {0, 3, 4}, {4, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

void add_sliver(Mesh& mesh, std::size_t index, float share, Vec3 off) {
    const auto [a, b, c] = mesh.triangles[index];
    const Vec3 &from = mesh.positions[a], &to = mesh.positions[b];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({from.x + (to.x - from.x) * share + off.x, from.y + (to.y - from.y) * share + off.y,
                              from.z + (to.z - from.z) * share + off.z});
    mesh.triangles[index] = {a, middle, c};
    mesh.triangles.push_back({middle, b, c});
    mesh.triangles.push_back({a, b, middle});
}

Mesh make_watertight(Random& random) {
    Mesh mesh = some_base(random);
    if (random.below(3) == 0) mesh = joined(mesh, some_base(random));  // shells that cross each other
    if (random.below(4) == 0) mesh = turned_inside_out(mesh);
    if (random.coin() && mesh.triangles.size() < 100) split_edges(mesh, random);
    const std::uint32_t slivers = random.below(40);
    for (std::uint32_t i = 0; i < slivers; ++i) {
        const std::uint32_t index = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
        add_sliver(mesh, index, 0.1f + 0.8f * random.unit(), random.in_cube(some_size(random, 18) * 0.1f));
    }
    if (random.below(4) == 0)
        mesh = joined(mesh, turned_inside_out(scaled_by(mesh, 1.0f - some_size(random, 12) * 0.5f)));
    transform(mesh, random);
    mesh.name = "watertight";
    return mesh;
}

}  // namespace espalier::tests
