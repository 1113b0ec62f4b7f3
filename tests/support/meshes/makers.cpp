#include "makers.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "support/base/random.hpp"
#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

Vec3 on_sphere(double x, double y, double z, double radius, Vec3 center) {
    const double scale = radius / std::sqrt(x * x + y * y + z * z);
    return {static_cast<float>(static_cast<double>(center.x) + x * scale),
            static_cast<float>(static_cast<double>(center.y) + y * scale),
            static_cast<float>(static_cast<double>(center.z) + z * scale)};
}

std::uint32_t size_of(const std::vector<Vec3>& positions) { return static_cast<std::uint32_t>(positions.size()); }

/// Vertices on a lattice, row by row, at the height that `height_at(column, row)` returns, and two triangles for each
/// of its cells.
template <class HeightAt>
Mesh make_grid(const char* name, unsigned side, HeightAt height_at) {
    Mesh mesh = {.name = name};
    for (std::uint32_t row = 0; row <= side; ++row) {
        for (std::uint32_t column = 0; column <= side; ++column) {
            const std::uint32_t corner = size_of(mesh.positions);
            mesh.positions.push_back({static_cast<float>(column), static_cast<float>(row), height_at(column, row)});
            if (row == side || column == side) continue;
            mesh.triangles.push_back({corner, corner + 1, corner + side + 2});
            mesh.triangles.push_back({corner, corner + side + 2, corner + side + 1});
        }
    }
    return mesh;
}

}  // namespace

Mesh make_cube(float low, float high) {
    Mesh mesh = {.name = "cube"};
    for (unsigned corner = 0; corner < 8; ++corner) {
        mesh.positions.push_back(
            {(corner & 1u) != 0 ? high : low, (corner & 2u) != 0 ? high : low, (corner & 4u) != 0 ? high : low});
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

Mesh make_icosphere(unsigned level, double radius, Vec3 center) {
    struct Direction {
        double x, y, z;
    };
    const double g = std::numbers::phi;
    std::vector<Direction> directions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    Mesh mesh = {.name = "icosphere"};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (unsigned i = 0; i < level; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
        const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] =
                midpoints.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(directions.size()));
            if (is_new) {
                // On the unit sphere before halving again, or the corners of the icosahedron stay crowded.
                const Direction p = directions[a];
                const Direction q = directions[b];
                const double lp = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
                const double lq = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
                directions.push_back({p.x / lp + q.x / lq, p.y / lp + q.y / lq, p.z / lp + q.z / lq});
            }
            return place->second;
        };
        std::vector<TriangleVertices> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = midpoint(a, b);
            const std::uint32_t bc = midpoint(b, c);
            const std::uint32_t ca = midpoint(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    for (const Direction& d : directions) mesh.positions.push_back(on_sphere(d.x, d.y, d.z, radius, center));
    return mesh;
}

Mesh make_uv_sphere(unsigned rings, unsigned segments, double radius, Vec3 center) {
    Mesh mesh = {.name = "uv sphere"};
    mesh.positions.push_back(on_sphere(0, 0, 1, radius, center));
    for (unsigned ring = 1; ring < rings; ++ring) {
        const double polar = std::numbers::pi * ring / rings;
        for (unsigned segment = 0; segment < segments; ++segment) {
            const double turn = 2.0 * std::numbers::pi * segment / segments;
            mesh.positions.push_back(on_sphere(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                               std::cos(polar), radius, center));
        }
    }
    mesh.positions.push_back(on_sphere(0, 0, -1, radius, center));
    const std::uint32_t south = size_of(mesh.positions) - 1;
    for (std::uint32_t segment = 0; segment < segments; ++segment) {
        const std::uint32_t after = (segment + 1) % segments;
        mesh.triangles.push_back({0, 1 + segment, 1 + after});
        for (std::uint32_t ring = 0; ring + 2 < rings; ++ring) {
            const std::uint32_t upper = 1 + ring * segments;
            const std::uint32_t lower = upper + segments;
            mesh.triangles.push_back({upper + segment, lower + segment, lower + after});
            mesh.triangles.push_back({upper + segment, lower + after, upper + after});
        }
        const std::uint32_t last = 1 + (rings - 2) * segments;
        mesh.triangles.push_back({last + segment, south, last + after});
    }
    return mesh;
}

Mesh make_torus(unsigned around, unsigned across, double major_radius, double minor_radius) {
    Mesh mesh = {.name = "torus"};
    for (unsigned i = 0; i < around; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / around;
        for (unsigned j = 0; j < across; ++j) {
            const double roll = 2.0 * std::numbers::pi * j / across;
            const double reach = major_radius + minor_radius * std::cos(roll);
            mesh.positions.push_back({static_cast<float>(reach * std::cos(turn)),
                                      static_cast<float>(reach * std::sin(turn)),
                                      static_cast<float>(minor_radius * std::sin(roll))});
        }
    }
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t here = i * across;
            const std::uint32_t there = (i + 1) % around * across;
            const std::uint32_t up = (j + 1) % across;
            mesh.triangles.push_back({here + j, there + j, there + up});
            mesh.triangles.push_back({here + j, there + up, here + up});
        }
    }
    return mesh;
}

Mesh make_far_sphere() {
    Mesh mesh = make_icosphere(3, 2.0, {148376.0f, 1234.0f, -223423.0f});
    mesh.name = "far sphere";
    return mesh;
}

Mesh make_plane_grid(unsigned side) {
    return make_grid("plane grid", side, [](double, double) { return 0.25f; });
}

Mesh make_terrain(unsigned side, std::uint64_t seed) {
    Random random(seed);
    return make_grid("terrain", side, [&](double x, double y) {
        const double height = std::sin(0.31 * x) * 3.0 + std::cos(0.17 * y + 0.05 * x) * 4.0;
        return static_cast<float>(height + 0.4 * static_cast<double>(random.signed_unit()));
    });
}

Mesh make_needle_fan(unsigned count) {
    Mesh mesh = {.name = "needle fan"};
    mesh.positions.push_back({0.0f, 0.0f, 0.0f});
    for (unsigned i = 0; i < count; ++i) {
        const double turn = 2.399963229728653 * i;  // the golden angle: no two needles alike
        const double rise = 2.0 * (i + 0.5) / count - 1.0;
        const double flat = std::sqrt(1.0 - rise * rise);
        const Vec3 tip{static_cast<float>(flat * std::cos(turn)), static_cast<float>(flat * std::sin(turn)),
                       static_cast<float>(rise)};
        const Vec3 beside{tip.x + 0.001f, tip.y - 0.0005f, tip.z + 0.00075f};
        mesh.positions.insert(mesh.positions.end(), {tip, beside});
        mesh.triangles.push_back({0, 2 * i + 1, 2 * i + 2});
    }
    return mesh;
}

Mesh make_slivers(unsigned count, std::uint64_t seed) {
    Random random(seed);
    Mesh mesh = {.name = "slivers"};
    for (unsigned i = 0; i < count; ++i) {
        const Vec3 a = random.in_cube(1.0f);
        const Vec3 b = random.in_cube(1.0f);
        const float along = random.unit();
        const Vec3 off = random.in_cube(0.0005f);
        append_triangle(mesh, a, b, sum(sum(a, times(difference(b, a), along)), off));
    }
    return mesh;
}

Mesh make_coplanar_stacks(unsigned count, std::uint64_t seed) {
    Random random(seed);
    Mesh mesh = {.name = "coplanar stacks"};
    for (unsigned i = 0; i < count; ++i) {
        // A coarse grid of corners in four tilted planes z = x * k / 4 + k: overlaps and shared corners are the rule.
        const auto level = static_cast<float>(i % 4);
        const auto corner = [&] {
            const auto x = static_cast<float>(random.below(9));
            const auto y = static_cast<float>(random.below(9));
            return Vec3{x, y, x * level * 0.25f + level};
        };
        const Vec3 a = corner();
        const Vec3 b = corner();
        const Vec3 c = corner();
        append_triangle(mesh, a, b, c);
        if (random.below(4) == 0) append_triangle(mesh, a, c, b);
    }
    return mesh;
}

Mesh make_soup(unsigned count, std::uint64_t seed) {
    Random random(seed);
    Mesh mesh = {.name = "soup"};
    for (unsigned i = 0; i < count; ++i) {
        const float reach = std::ldexp(1.0f, -static_cast<int>(random.below(9)));
        const Vec3 center = random.in_cube(1.0f);
        const auto corner = [&] { return sum(center, random.in_cube(reach)); };
        const Vec3 a = corner();
        const Vec3 b = corner();
        const Vec3 c = corner();
        append_triangle(mesh, a, b, c);
    }
    return mesh;
}

Mesh crossed_by_beams(unsigned beams, unsigned small, std::uint64_t seed) {
    Mesh mesh = {.name = "beams"};
    Random random(seed);
    const auto unit = [&] { return static_cast<float>(random.below(1'000'000)) * 1e-6f; };
    for (unsigned i = 0; i < beams; ++i) {
        const Vec3 a = {unit(), 0.0f, unit()};
        const Vec3 b = {unit(), 1.0f, unit()};
        append_triangle(mesh, a, b, {b.x + 0.01f * unit(), b.y, b.z + 0.01f * unit()});
    }
    for (unsigned i = 0; i < small; ++i) {
        const Vec3 a = {unit(), unit(), unit()};
        append_triangle(mesh, a, {a.x + 0.02f * unit(), a.y, a.z + 0.01f}, {a.x, a.y + 0.02f * unit(), a.z});
    }
    return mesh;
}

Mesh scaled_by(Mesh mesh, float factor) {
    for (Vec3& p : mesh.positions) p = times(p, factor);
    return mesh;
}

Mesh moved_by(Mesh mesh, Vec3 way) {
    for (Vec3& p : mesh.positions) p = sum(p, way);
    return mesh;
}

Mesh make_triangle(Vec3 a, Vec3 b, Vec3 c) {
    return {.name = "triangle", .positions = {a, b, c}, .triangles = {{0, 1, 2}}};
}

void append_triangle(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c) { append(mesh, make_triangle(a, b, c)); }

void append(Mesh& mesh, const Mesh& other) {
    const std::uint32_t first = size_of(mesh.positions);
    mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
    for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

Mesh joined(Mesh mesh, const Mesh& other) {
    append(mesh, other);
    mesh.name += " and " + other.name;
    return mesh;
}

Mesh turned_inside_out(Mesh mesh) {
    for (TriangleVertices& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    mesh.name += " inside out";
    return mesh;
}

}  // namespace espalier::tests
