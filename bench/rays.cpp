#include "rays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::bench {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers with every compiler.
struct Random {
    std::uint64_t state;
    std::uint64_t next() {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    float unit() { return static_cast<float>(next() >> 40) * 0x1p-24f; }
    float symmetric() { return 2.0f * unit() - 1.0f; }
};

struct Box {
    float low[3], high[3];
    float center(int k) const { return 0.5f * (low[k] + high[k]); }
    float radius() const {
        return 0.5f * std::sqrt((high[0] - low[0]) * (high[0] - low[0]) + (high[1] - low[1]) * (high[1] - low[1]) +
                                (high[2] - low[2]) * (high[2] - low[2]));
    }
};

Box box_of(const Mesh& mesh) {
    Box box;
    std::fill_n(box.low, 3, std::numeric_limits<float>::infinity());
    std::fill_n(box.high, 3, -std::numeric_limits<float>::infinity());
    for (const TriangleVertices& t : mesh.triangles)
        for (const std::uint32_t v : t) {
            const float p[3] = {mesh.positions[v].x, mesh.positions[v].y, mesh.positions[v].z};
            for (int k = 0; k < 3; ++k) {
                box.low[k] = std::min(box.low[k], p[k]);
                box.high[k] = std::max(box.high[k], p[k]);
            }
        }
    return box;
}

Ray towards(const float* from, const float* to) {
    float d[3];
    float squared = 0.0f;
    for (int k = 0; k < 3; ++k) {
        d[k] = to[k] - from[k];
        squared += d[k] * d[k];
    }
    const float scale = 1.0f / std::sqrt(squared);
    Ray ray;
    ray.origin = {from[0], from[1], from[2]};
    ray.direction = {d[0] * scale, d[1] * scale, d[2] * scale};
    return ray;
}

}  // namespace

BoundingSphere bounding_sphere(const Mesh& mesh) {
    const Box box = box_of(mesh);
    return {{box.center(0), box.center(1), box.center(2)}, box.radius()};
}

double bring_to_common_size(Mesh& mesh) {
    const Box box = box_of(mesh);
    float extent = 0.0f;
    for (int k = 0; k < 3; ++k) extent = std::max(extent, box.high[k] - box.low[k]);
    if (!(extent > 0.0f) || std::isinf(extent)) return 1.0;
    const int exponent = 7 - std::ilogb(extent);
    for (Vec3& p : mesh.positions)
        p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
    return std::ldexp(1.0, exponent);
}

std::vector<Ray> coherent_rays(const Mesh& mesh) {
    const Box box = box_of(mesh);
    const float radius = box.radius();
    std::vector<Ray> rays;
    for (int view = 0; view < 3; ++view) {
        const int forward = 2 - view, right = (forward + 1) % 3, up = (forward + 2) % 3;
        float eye[3] = {box.center(0), box.center(1), box.center(2)};
        eye[forward] += 2.4f * radius;
        for (int row = 0; row < 512; ++row)
            for (int column = 0; column < 512; ++column) {
                float target[3] = {box.center(0), box.center(1), box.center(2)};
                target[right] += radius * (static_cast<float>(column) - 255.5f) / 256.0f;
                target[up] += radius * (static_cast<float>(row) - 255.5f) / 256.0f;
                rays.push_back(towards(eye, target));
            }
    }
    return rays;
}

std::vector<Ray> incoherent_rays(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    const Box box = box_of(mesh);
    const float radius = 1.2f * box.radius();
    Random random{seed};
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const float s[3] = {random.symmetric(), random.symmetric(), random.symmetric()};
        const float squared = s[0] * s[0] + s[1] * s[1] + s[2] * s[2];
        if (squared > 1.0f || squared < 1e-3f) continue;
        float from[3], to[3];
        for (int k = 0; k < 3; ++k) {
            from[k] = box.center(k) + s[k] * (radius / std::sqrt(squared));
            to[k] = box.low[k] + random.unit() * (box.high[k] - box.low[k]);
        }
        rays.push_back(towards(from, to));
    }
    return rays;
}

}  // namespace espalier::bench
