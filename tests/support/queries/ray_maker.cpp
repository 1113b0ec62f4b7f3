#include "ray_maker.hpp"

#include <algorithm>
#include <cmath>

#include "support/base/vectors.hpp"

namespace espalier::tests {

Vec3 QueryMaker::some_edge_middle() {
    const GridTriangle& t = some_triangle();
    const GridPoint corners[3] = {t.a, t.b, t.c};
    const std::uint32_t first = random_.below(3);
    const GridPoint& p = corners[first];
    const GridPoint& q = corners[(first + 1) % 3];
    return to_world(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2]));
}

Vec3 QueryMaker::some_target() { return random_.coin() ? vertex() : some_edge_middle(); }

/// On a sphere around the middle of the asset.
Vec3 QueryMaker::around(double sizes) {
    double x = 0, y = 0, z = 0, length = 0;
    do {
        x = static_cast<double>(random_.signed_unit());
        y = static_cast<double>(random_.signed_unit());
        z = static_cast<double>(random_.signed_unit());
        length = std::sqrt(x * x + y * y + z * z);
    } while (length > 1.0 || length < 0.01);
    const double scale = sizes * static_cast<double>(size_) / std::ldexp(1.0, decoded_.step_exponent) / length;
    return to_world(0.5 * decoded_.extent[0] + x * scale, 0.5 * decoded_.extent[1] + y * scale,
                    0.5 * decoded_.extent[2] + z * scale);
}

/// Two ulp to either side in half of the calls.
float QueryMaker::nudged(float value) {
    if (random_.coin()) return value;
    const std::int32_t by = random_.between(-2, 2);
    for (std::int32_t i = 0; i < std::abs(by); ++i) value = std::nextafter(value, by < 0 ? -INFINITY : INFINITY);
    return value;
}

Ray QueryMaker::ray(RayKind kind) {
    Ray ray;
    Vec3 target = some_target();
    ray.origin = around(1.2);
    switch (kind) {
        case RayKind::incoherent: {
            const double x = static_cast<double>(random_.unit());
            const double y = static_cast<double>(random_.unit());
            const double z = static_cast<double>(random_.unit());
            target = to_world(x * decoded_.extent[0], y * decoded_.extent[1], z * decoded_.extent[2]);
            break;
        }
        case RayKind::through_vertex:
            target = vertex();
            // From another lattice point the aim is exact where the asset lies near the world's origin.
            if (random_.coin()) ray.origin = vertex();
            break;
        case RayKind::through_edge:
            target = some_edge_middle();
            break;
        case RayKind::axis_parallel: {
            const std::uint32_t axis = random_.below(3);
            const float length = std::ldexp(random_.coin() ? 1.0f : -0.7f, random_.between(-20, 20));
            ray.direction = {axis == 0 ? length : 0.0f,
                             axis == 1        ? length
                             : random_.coin() ? -0.0f
                                              : 0.0f,
                             axis == 2 ? length : 0.0f};
            ray.origin = {axis == 0 ? ray.origin.x : nudged(target.x), axis == 1 ? ray.origin.y : nudged(target.y),
                          axis == 2 ? ray.origin.z : nudged(target.z)};
            return ray;
        }
        case RayKind::diagonal: {
            const auto away = size_ * (0.25f + random_.unit());
            ray.direction = {random_.coin() ? away : -away, random_.coin() ? away : -away,
                             random_.below(3) == 0 ? 0.0f : away};
            ray.origin = difference(target, ray.direction);
            return ray;
        }
        case RayKind::in_plane: {
            const GridTriangle& t = some_triangle();
            const Vec3 a = to_world(t.a);
            target = random_.coin() ? to_world(t.b) : middle(to_world(t.b), to_world(t.c));
            const Vec3 along = difference(target, a);
            ray.origin = random_.coin() ? a : difference(a, along);
            ray.direction = {nudged(along.x), nudged(along.y), nudged(along.z)};
            if (is_zero(ray.direction)) ray.direction.z = 1.0f;
            return ray;
        }
        case RayKind::from_face: {
            ray.origin = random_.coin() ? target : middle(target, to_world(some_triangle().a));
            const Vec3 anywhere = random_.in_cube(size_);
            ray.direction = {nudged(anywhere.x), nudged(anywhere.y), anywhere.z};
            return ray;
        }
        case RayKind::far_ten_thousand:
            ray.origin = around(1e4);
            break;
        case RayKind::far_million:
            ray.origin = around(1e6);
            break;
    }
    ray.direction = difference(target, ray.origin);
    ray.direction = {nudged(ray.direction.x), nudged(ray.direction.y), nudged(ray.direction.z)};
    if (random_.below(4) == 0) {
        ray.direction = times(ray.direction, std::ldexp(1.0f, random_.between(-20, 20)));
    }
    if (is_zero(ray.direction)) ray.direction = {1.0f, 0.0f, 0.0f};
    return ray;
}

Ray QueryMaker::any_ray() { return ray(all_ray_kinds[random_.below(all_ray_kinds.size())]); }

void QueryMaker::restrict(Ray& ray) {
    const auto longest = largest(ray.direction);
    const auto sizes = [&] { return size_ / longest * random_.unit(); };
    const auto kind = random_.below(4);
    if (kind == 0) ray.t_min = sizes();
    else if (kind == 1) ray.t_max = sizes() * 2.0f;
    else if (kind == 2) {
        ray.t_min = sizes();
        ray.t_max = ray.t_min + sizes();
    } else {
        ray.t_min = -1.0f;
    }
    ray.culling = static_cast<FaceCulling>(random_.below(3));
}

Sphere QueryMaker::sphere() {
    Sphere sphere;
    const Vec3 target = some_target();
    switch (random_.below(8)) {
        case 0:
            sphere.center = target;
            break;
        case 1:
            sphere.center = middle(target, to_world(some_triangle().a));
            break;
        case 2:
            sphere.center = around(1e4);
            break;
        case 3:
            sphere.center = around(random_.coin() ? 1e6 : 10.0);
            break;
        case 4:
            sphere.center = to_world(0.5 * decoded_.extent[0], 0.5 * decoded_.extent[1], 0.5 * decoded_.extent[2]);
            break;
        default: {
            sphere.center = sum(target, random_.in_cube(size_ * (random_.coin() ? 0.02f : 0.7f)));
        }
    }
    const Vec3 gap = difference(vertex(), sphere.center);
    const double distance = std::sqrt(static_cast<double>(gap.x) * static_cast<double>(gap.x) +
                                      static_cast<double>(gap.y) * static_cast<double>(gap.y) +
                                      static_cast<double>(gap.z) * static_cast<double>(gap.z));
    const auto kind = random_.below(6);
    if (kind == 0) sphere.radius = 0.0f;
    else if (kind == 1) sphere.radius = INFINITY;
    else if (kind == 2) sphere.radius = std::abs(nudged(static_cast<float>(distance)));
    else if (kind == 3) sphere.radius = size_ * 0.01f * random_.unit();
    else sphere.radius = static_cast<float>(distance) * random_.unit();
    return sphere;
}

Sphere QueryMaker::random_sphere() {
    const Vec3 center = some_place();
    const float size = size_ * random_.unit();
    return {center, std::ldexp(size, -random_.between(0, 8))};
}

}  // namespace espalier::tests
