#include "measure.hpp"

#include <algorithm>
#include <cmath>

#include <espalier/espalier.hpp>

#include <import/base/placement.hpp>

#include "base/exit_code.hpp"
#include "base/vectors.hpp"

namespace espalier::tools {

namespace {

Vec3d difference(Vec3 to, Vec3 from) { return to_float64(to) - to_float64(from); }

double distance_to_segment(const Vec3d& point, const Vec3d& from, const Vec3d& to) {
    const Vec3d way = to - from, offset = point - from;
    const double square = dot(way, way);
    const double t = square > 0.0 ? std::clamp(dot(offset, way) / square, 0.0, 1.0) : 0.0;
    return length_of(offset - t * way);
}

/// In float64, which has the products of a lattice's coordinates without rounding.
double distance_to_triangle(const Vec3d& point, const Triangle& triangle) {
    const Vec3d corners[] = {to_float64(triangle.a), to_float64(triangle.b), to_float64(triangle.c)};
    const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    double nearest = std::numeric_limits<double>::infinity();
    bool is_beside = !(length_of(normal) > 0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& from = corners[i];
        const Vec3d& to = corners[(i + 1) % 3];
        nearest = std::min(nearest, distance_to_segment(point, from, to));
        is_beside |= dot(cross(to - from, point - from), normal) < 0.0;
    }
    return is_beside ? nearest : std::min(nearest, std::abs(dot(normal, point - corners[0])) / length_of(normal));
}

}  // namespace

/// How far the measured distance may lie above the true one. closest_point answers for the point as it rounds it:
/// relative to the lattice's origin in float32, then onto a grid that is finer than the lattice as far as float32 can
/// carry it. Its distance from there is within 4 ulp (nearest.hpp).
double measuring_error_at(const Blob& blob, Vec3 point, double distance) {
    const float* origin = detail::data_of(blob).origin;
    const Vec3d offset = difference(point, {origin[0], origin[1], origin[2]});
    const double reach = std::max({std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
    const int finer_by = std::clamp(23 - static_cast<int>(detail::data_of(blob).bits), 0, 6);
    const double on_each_axis = std::ldexp(1.0, blob.lattice().step_exponent - finer_by - 1) + std::ldexp(reach, -24);
    return std::sqrt(3.0) * on_each_axis + std::ldexp(distance, -21);
}

/// The same for an instance. Its transform and its vertices were rounded to float32 when it was baked, and the point
/// when it was placed; to_local() rounds that, the blob again, and the result when it returns to the world.
double measuring_error_at(const BakedScene& scene, const Instance& instance, Vec3 point, double distance) {
    const Transform& transform = instance.transform;
    const auto scale = static_cast<double>(transform.scale);
    const double reach = length_of(difference(point, transform.translation));
    const double translation = length_of(to_float64(transform.translation));
    const Vec3 local = to_local(transform, point);
    const std::size_t meshes = scene.meshes().size();
    const double in_mesh = instance.mesh < meshes
                               ? measuring_error_at(scene.meshes()[instance.mesh], local, distance / scale)
                               : measuring_error_at(scene.tiles()[instance.mesh - meshes], local, distance / scale);
    return std::sqrt(3.0) * std::ldexp(reach, -19) + std::ldexp(reach, -20) + std::ldexp(translation, -23) +
           scale * in_mesh + std::ldexp(distance, -22);
}

/// The instance that is nearest may not be the one with the least measured distance: the error is the largest of all
/// that the surface near the point may belong to.
double measuring_error_at(const BakedScene& scene, Vec3 point, double distance) {
    const float around = std::nextafter(static_cast<float>(std::max(distance, static_cast<double>(scene.max_error()))),
                                        std::numeric_limits<float>::infinity());
    const Box box{{point.x - around, point.y - around, point.z - around},
                  {point.x + around, point.y + around, point.z + around}};
    double error = 0.0;
    static_cast<void>(for_each_candidate(scene, box, [&](InstanceId id) {
        error = std::max(error, measuring_error_at(scene, *instance_at(scene, {id.index}), point, distance));
    }));
    return error;
}

/// The query finds the triangle, for the place as it rounds it; the distance is that of the place in float64.
Measured measure(const Blob& blob, const Vec3d& place) {
    const Vec3d point = place - blob.source_origin();
    const Vec3 in_blob = to_float32(point);
    const ClosestPoint nearest = closest_point(blob, in_blob);
    if (!nearest) return {};
    const auto distance_to = [&](TriangleId triangle) {
        return distance_to_triangle(point, triangle_at(blob, triangle).value);
    };
    const double rounded_by = length_of(point - to_float64(in_blob));
    const auto allowed = static_cast<double>(blob.max_error());
    Measured measured;
    measured.distance = distance_to(nearest.triangle);
    if (measured.distance > allowed) {  // another triangle may be nearer to the place than to where it was rounded
        const double radius = allowed + rounded_by + measuring_error_at(blob, in_blob, allowed);
        static_cast<void>(for_each_overlap(blob, Sphere{in_blob, to_float32(radius)}, [&](TriangleId triangle) {
            measured.distance = std::min(measured.distance, distance_to(triangle));
        }));
    }
    measured.error = std::ldexp(length_of(point) + measured.distance, -48);
    return measured;
}

Measured measure(const BakedScene& scene, const Vec3d& place) {
    const Vec3 point = to_float32(place - scene.source_origin());
    const auto distance = double(closest_point(scene, point)->distance);
    return {distance, measuring_error_at(scene, point, distance)};
}

}  // namespace espalier::tools
