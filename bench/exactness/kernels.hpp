// Tests of a ray against a triangle, from its three corners, without culling: each as its source writes it.
//
// A kernel prepares a ray once and then tests triangles. test() returns t of a hit from 0 on, or infinity. Each has a
// copy of the triangles, of 36 bytes a triangle, so that none profits from the cache misses of another.
#pragma once

#include <runtime/kernels/ray_triangle.hpp>

#include "../study/walks.hpp"
#include "edge_rays.hpp"

namespace espalier::bench {

/// "Fast, minimum storage ray/triangle intersection" (Möller, Trumbore 1997), divided at a hit only, as its branch with
/// culling is, and without the tolerance of its listing, which rejects small triangles.
template <class Number>
class MollerTrumbore {
public:
    struct Prepared {
        Number origin[3];
        Number direction[3];
    };

    MollerTrumbore(const AabbTree& tree, const Blob&) : triangles_(tree.triangles) {}

    static bool prepare(const Ray& ray, Prepared& to) {
        to = {{Number(ray.origin.x), Number(ray.origin.y), Number(ray.origin.z)},
              {Number(ray.direction.x), Number(ray.direction.y), Number(ray.direction.z)}};
        return true;
    }
    [[nodiscard]] float test(const Prepared& ray, std::size_t index) const {
        constexpr float miss = std::numeric_limits<float>::infinity();
        const auto& [a, b, c] = triangles_[index];
        const Number ab[3] = {Number(b.x) - Number(a.x), Number(b.y) - Number(a.y), Number(b.z) - Number(a.z)};
        const Number ac[3] = {Number(c.x) - Number(a.x), Number(c.y) - Number(a.y), Number(c.z) - Number(a.z)};
        Number p[3], q[3];
        cross(ray.direction, ac, p);
        const Number volume = dot(ab, p);
        if (volume == Number(0)) return miss;
        const Number side = std::copysign(Number(1), volume), size = std::abs(volume);
        const Number s[3] = {ray.origin[0] - Number(a.x), ray.origin[1] - Number(a.y), ray.origin[2] - Number(a.z)};
        const Number u = side * dot(s, p);
        if (u < Number(0) || u > size) return miss;
        cross(s, ab, q);
        const Number v = side * dot(ray.direction, q);
        if (v < Number(0) || u + v > size) return miss;
        const Number t = side * dot(ac, q) / size;
        return t >= Number(0) ? static_cast<float>(t) : miss;
    }

private:
    static void cross(const Number* a, const Number* b, Number* to) {
        to[0] = a[1] * b[2] - a[2] * b[1];
        to[1] = a[2] * b[0] - a[0] * b[2];
        to[2] = a[0] * b[1] - a[1] * b[0];
    }
    static Number dot(const Number* a, const Number* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

    std::vector<FloatTriangle> triangles_;
};

/// "Watertight ray/triangle intersection" (Woop, Benthin, Wald 2013): corners are sheared so that the ray becomes an
/// axis, and what is 0 in float is computed again in double.
class Watertight {
public:
    struct Prepared {
        float origin[3];
        float shear[3];
        int axis[3];
    };

    Watertight(const AabbTree& tree, const Blob&) : triangles_(tree.triangles) {}

    static bool prepare(const Ray& ray, Prepared& to) {
        const float direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
        int longest = 0;
        for (int k = 1; k < 3; ++k)
            if (std::abs(direction[k]) > std::abs(direction[longest])) longest = k;
        int next = (longest + 1) % 3, last = (longest + 2) % 3;
        if (direction[longest] < 0.0f) std::swap(next, last);
        to = {{ray.origin.x, ray.origin.y, ray.origin.z},
              {direction[next] / direction[longest], direction[last] / direction[longest], 1.0f / direction[longest]},
              {next, last, longest}};
        return true;
    }
    [[nodiscard]] float test(const Prepared& ray, std::size_t index) const {
        constexpr float miss = std::numeric_limits<float>::infinity();
        float x[3], y[3], z[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& corner = triangles_[index][i];
            const float from[3] = {corner.x - ray.origin[0], corner.y - ray.origin[1], corner.z - ray.origin[2]};
            z[i] = from[ray.axis[2]];
            x[i] = from[ray.axis[0]] - ray.shear[0] * z[i];
            y[i] = from[ray.axis[1]] - ray.shear[1] * z[i];
        }
        float u = x[2] * y[1] - y[2] * x[1];
        float v = x[0] * y[2] - y[0] * x[2];
        float w = x[1] * y[0] - y[1] * x[0];
        if (u == 0.0f || v == 0.0f || w == 0.0f) {
            u = in_double(x[2], y[1], y[2], x[1]);
            v = in_double(x[0], y[2], y[0], x[2]);
            w = in_double(x[1], y[0], y[1], x[0]);
        }
        if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) return miss;
        const float volume = u + v + w;
        if (volume == 0.0f) return miss;
        const float scaled = ray.shear[2] * (u * z[0] + v * z[1] + w * z[2]);
        const float t = scaled / volume;
        return t >= 0.0f ? t : miss;
    }

private:
    static float in_double(float a, float b, float c, float d) {
        return static_cast<float>(static_cast<double>(a) * static_cast<double>(b) -
                                  static_cast<double>(c) * static_cast<double>(d));
    }

    std::vector<FloatTriangle> triangles_;
};

/// Espalier's own: integers on the blob's lattice, of which every corner of the tree is a point.
class Integers {
public:
    struct Prepared {
        detail::IntegerRay ray;
        float t_of_tau;
    };

    Integers(const AabbTree& tree, const Blob& blob) : blob_(&blob) {
        const espalier::Lattice lattice = blob.lattice();
        const double steps_per_unit = std::ldexp(1.0, -lattice.step_exponent);
        const auto steps = [&](float coordinate, float origin) {
            return static_cast<std::int32_t>((double(coordinate) - double(origin)) * steps_per_unit);
        };
        for (const FloatTriangle& triangle : tree.triangles) {
            detail::LatticeTriangle& to = triangles_.emplace_back();
            for (std::size_t i = 0; i < 3; ++i) {
                to.corner[i][0] = steps(triangle[i].x, lattice.origin.x);
                to.corner[i][1] = steps(triangle[i].y, lattice.origin.y);
                to.corner[i][2] = steps(triangle[i].z, lattice.origin.z);
            }
        }
    }

    bool prepare(const Ray& ray, Prepared& to) const {
        float reach = 0.0f;
        if (!detail::round_ray(detail::data_of(*blob_), ray, to.ray, reach)) return false;
        to.t_of_tau = std::ldexp(1.0f, to.ray.t_exponent);
        return true;
    }
    [[nodiscard]] float test(const Prepared& ray, std::size_t index) const {
        detail::TriangleHit hit;
        if (!detail::intersect(ray.ray, triangles_[index], hit)) return std::numeric_limits<float>::infinity();
        return hit.whole_tau * ray.t_of_tau;
    }

private:
    const Blob* blob_;
    std::vector<detail::LatticeTriangle> triangles_;
};

// One tree, walked by one function, with any kernel in its leaves: only the kernel can lose a hit.

/// Returns t of the closest hit, or infinity.
template <class Kernel>
float closest_hit(RayWalk& walk, const Kernel& kernel, const Ray& ray) {
    typename Kernel::Prepared prepared;
    if (!kernel.prepare(ray, prepared)) return std::numeric_limits<float>::infinity();
    RayWork work;
    const auto test_leaf = [&](const AabbNode& leaf, double& nearest) {
        for (std::size_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            nearest = std::min(nearest, static_cast<double>(kernel.test(prepared, i)));
    };
    return static_cast<float>(walk.walk(ray, work, test_leaf, [](std::uint32_t) {}));
}

/// The same by a test of every triangle.
template <class Kernel>
float closest_of_all(const AabbTree& tree, const Kernel& kernel, const Ray& ray) {
    float nearest = std::numeric_limits<float>::infinity();
    typename Kernel::Prepared prepared;
    if (kernel.prepare(ray, prepared))
        for (std::size_t i = 0; i < tree.triangles.size(); ++i) nearest = std::min(nearest, kernel.test(prepared, i));
    return nearest;
}

struct ExactnessOptions {
    std::size_t aimed = 50'000;  ///< rays at each kind of place
    std::size_t rays = 20'000;   ///< of which times are measured
    std::size_t rounds = 5;
    unsigned leaf_triangles = 4;
};

/// Prints a row for each kernel: the time of a test alone, and of a ray through one and the same tree.
void print_kernel_times(const SnappedMesh& snapped, const ExactnessOptions& options);

}  // namespace espalier::bench
