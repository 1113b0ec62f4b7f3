// What was found nearest, in the caller's units.
#pragma once

#include <cstdint>

#include <espalier/distance.hpp>
#include <runtime/answers/found.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/to_local.hpp>

namespace espalier::detail {

/// The root of a squared distance in lattice steps, and `offset` of them more. That it is within max_distance was
/// decided exactly: rounding must not say otherwise.
ESPALIER_SHARED_CODE inline float to_local_distance(const BlobData& blob, float squared, float offset,
                                                    float max_distance) {
    const float distance = scale_by_power_of_two(square_root(squared) + offset, blob.step_exponent);
    return magnitude_bits(distance) > magnitude_bits(max_distance) ? max_distance : distance;
}

/// Writes a closest point in lattice steps, in the structure of the result: the distance is squared, and the three
/// points hold the corners of the triangle, whose 24 bits a float holds exactly.
ESPALIER_SHARED_CODE inline void set_unfinished(ClosestPoint& result, const FoundNearest& found) {
    result.point = to_vector(found.triangle.corner[0]);
    result.on_shape = to_vector(found.triangle.corner[1]);
    result.face_normal = to_vector(found.triangle.corner[2]);
    result.distance = found.distance.squared;
    result.u = found.distance.u;
    result.v = found.distance.v;
    result.triangle = TriangleId{found.index};
    result.feature = found.distance.feature;
}

/// Computes the result in local space for the closest point to `local`, which was rounded to `point`.
ESPALIER_SHARED_CODE inline void finish(const BlobData& blob, const RoundedPoint& point, const Vec3& local,
                                        float max_distance, ClosestPoint& nearest) {
    LatticeTriangle triangle;
    const Vec3* corners[3] = {&nearest.point, &nearest.on_shape, &nearest.face_normal};
    for (int i = 0; i < 3; ++i) {
        triangle.corner[i][0] = static_cast<std::int32_t>(corners[i]->x);
        triangle.corner[i][1] = static_cast<std::int32_t>(corners[i]->y);
        triangle.corner[i][2] = static_cast<std::int32_t>(corners[i]->z);
    }
    const Vec3 on_surface = point_of(triangle, nearest.u, nearest.v);
    nearest.point = to_local(blob, on_surface.x, on_surface.y, on_surface.z);
    nearest.on_shape = local;
    nearest.face_normal = face_normal_of(triangle);
    nearest.distance = to_local_distance(blob, nearest.distance, point.distance_offset, max_distance);
    nearest.side = is_origin_behind(relative_to(point, triangle)) ? Side::back : Side::front;
    nearest.status = QueryStatus::ok;
}

}  // namespace espalier::detail
