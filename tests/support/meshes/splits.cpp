#include "splits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "makers.hpp"
#include "support/base/profiles.hpp"
#include "support/base/random.hpp"
#include "support/base/vectors.hpp"

namespace espalier::tests {

namespace {

void make_whole(Split& split, Random& random) {
    if (!split.closed) {
        split.whole = make_terrain(8 + random.below(12), random.next());
        return;
    }
    const std::uint32_t kind = random.below(3);
    for (int i = 0; i < 32; ++i) {
        const float turn = 6.28f * random.unit();
        const Vec3 off = random.in_cube(0.15f);
        split.inside.push_back(kind == 2 ? Vec3{2.0f * std::cos(turn), 2.0f * std::sin(turn), off.z} : off);
    }
    if (kind == 0) split.whole = make_icosphere(2, 1.0, {});
    if (kind == 1) split.whole = make_uv_sphere(6 + random.below(6), 9 + random.below(9), 1.0, {});
    if (kind == 2) split.whole = make_torus(12 + random.below(12), 8 + random.below(6), 2.0, 0.7);
}

/// Any size, up to a hundred sizes from the world's origin.
void place_anywhere(Split& split, Random& random) {
    const float size = std::ldexp(1.0f + random.unit(), random.between(-20, 20));
    const float away = random.below(3) == 0 ? 0.0f : 100.0f * random.unit();
    const Vec3 offset = random.in_cube(size * away);
    for (std::vector<Vec3>* points : {&split.whole.positions, &split.inside})
        for (Vec3& p : *points) p = sum(times(p, size), offset);
}

double largest_side(const Mesh& mesh) {
    std::array<float, 3> low{}, high{};
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float at[3] = {mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z};
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = i == 0 ? at[k] : std::min(low[k], at[k]);
            high[k] = i == 0 ? at[k] : std::max(high[k], at[k]);
        }
    }
    double side = 0.0;
    for (std::size_t k = 0; k < 3; ++k) side = std::max(side, double(high[k]) - double(low[k]));
    return side;
}

/// Near the middle of all positions, so that a cut leaves a good part on either side.
Vec3 near_middle(const Mesh& mesh, Random& random) {
    double x = 0.0, y = 0.0, z = 0.0;
    for (const Vec3& p : mesh.positions) {
        x += double(p.x);
        y += double(p.y);
        z += double(p.z);
    }
    const auto count = static_cast<double>(mesh.positions.size());
    const Vec3 off = random.in_cube(0.2f * static_cast<float>(largest_side(mesh)));
    return {static_cast<float>(x / count) + off.x, static_cast<float>(y / count) + off.y,
            static_cast<float>(z / count) + off.z};
}

Vec3 middle_of(const Mesh& mesh, const TriangleVertices& triangle) {
    const Vec3 &a = mesh.positions[triangle[0]], &b = mesh.positions[triangle[1]], &c = mesh.positions[triangle[2]];
    return {(a.x + b.x + c.x) / 3.0f, (a.y + b.y + c.y) / 3.0f, (a.z + b.z + c.z) / 3.0f};
}

/// Which part each triangle belongs to; numbers may be missing.
std::vector<std::uint32_t> assign(const Mesh& mesh, Random& random) {
    const std::uint32_t kind = random.below(3);
    const std::uint32_t count = 2 + random.below(4);
    const Vec3 normal = random.in_cube(1.0f);
    const Vec3 through = near_middle(mesh, random);
    const float tile = static_cast<float>(largest_side(mesh)) / static_cast<float>(count);
    std::vector<std::uint32_t> part_of;
    for (const TriangleVertices& triangle : mesh.triangles) {
        const Vec3 at = middle_of(mesh, triangle);
        const Vec3 from = difference(at, through);
        if (kind == 0) {
            part_of.push_back(dot(normal, from) < 0.0f ? 0 : 1);
        } else if (kind == 1) {
            const auto cell = [&](float x) { return static_cast<std::uint32_t>(std::floor(x / tile) + 16.0f); };
            part_of.push_back(cell(from.x) * 64 + cell(from.y));
        } else {
            part_of.push_back(random.below(count));
        }
    }
    return part_of;
}

Split::Part make_part(const Mesh& whole, const std::vector<std::uint32_t>& part_of, std::uint32_t part) {
    Split::Part result;
    std::map<std::uint32_t, std::uint32_t> number_of;
    for (std::uint32_t i = 0; i < whole.triangles.size(); ++i) {
        if (part_of[i] != part) continue;
        TriangleVertices corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = whole.triangles[i][k];
            const auto [at, is_new] = number_of.emplace(vertex, static_cast<std::uint32_t>(number_of.size()));
            if (is_new) {
                result.mesh.positions.push_back(whole.positions[vertex]);
                result.in_whole.push_back(vertex);
            }
            corners[k] = at->second;
        }
        result.mesh.triangles.push_back(corners);
        result.of_triangle.push_back(i);
    }
    return result;
}

}  // namespace

Split make_split(std::uint32_t number) {
    Random random(number);
    Split split;
    split.closed = number % 2 == 0;
    make_whole(split, random);
    place_anywhere(split, random);
    split.name = split.whole.name + ", split " + std::to_string(number);
    const std::vector<std::uint32_t> part_of = assign(split.whole, random);
    std::vector<std::uint32_t> parts = part_of;
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    for (const std::uint32_t part : parts) split.parts.push_back(make_part(split.whole, part_of, part));
    split.options.profile = every_profile[number % every_profile.size()];
    split.options.original_ids = true;
    const int bits = random.between(10, 22);
    split.options.resolution = Resolution::step(std::ilogb(largest_side(split.whole)) + 1 - bits);
    return split;
}

}  // namespace espalier::tests
