// What some peers leave to their caller.
#pragma once

#include <algorithm>
#include <cmath>

#include "system.hpp"

namespace espalier::bench {

inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 minus(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 along(const Ray& ray, float t) {
    return {ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y, ray.origin.z + t * ray.direction.z};
}

/// A finite end for rays without one, for systems that cast segments: past the far side of `sphere`, times the length
/// of the direction. Tight, because such systems visit every box on the whole segment.
inline float reach(const Ray& ray, const BoundingSphere& sphere) {
    const Vec3 to_center = minus(sphere.center, ray.origin);
    const float length = std::sqrt(dot(ray.direction, ray.direction));
    const float distance = std::sqrt(dot(to_center, to_center)) + 1.01f * sphere.radius;
    return std::min(ray.t_max, distance / length);
}

/// Weights of the second and the third corner at `point` of the plane (Ericson, Real-Time Collision Detection, 2005,
/// section 3.4: by Cramer's rule).
inline void set_barycentric(const Mesh& mesh, std::uint32_t triangle, Vec3 point, Hit& hit) {
    const TriangleVertices& corners = mesh.triangles[triangle];
    const Vec3 a = mesh.positions[corners[0]];
    const Vec3 ab = minus(mesh.positions[corners[1]], a);
    const Vec3 ac = minus(mesh.positions[corners[2]], a);
    const Vec3 ap = minus(point, a);
    const float bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
    const float inverse = 1.0f / (bb * cc - bc * bc);
    hit.u = (cc * pb - bc * pc) * inverse;
    hit.v = (bb * pc - bc * pb) * inverse;
}

}  // namespace espalier::bench
