// Equality of answers as bits: -0 is not 0, and no tolerance hides a difference.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/contact.hpp>
#include <espalier/distance.hpp>
#include <espalier/ray.hpp>
#include <espalier/sweep.hpp>

namespace espalier::tests {

inline bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

inline bool same_bits(Vec3 a, Vec3 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z); }

inline bool same_bits(const RayHit& a, const RayHit& b) {
    return same_bits(a.t, b.t) && same_bits(a.u, b.u) && same_bits(a.v, b.v) && same_bits(a.normal, b.normal) &&
           a.triangle == b.triangle && a.status == b.status && a.side == b.side && a.reserved[0] == b.reserved[0] &&
           a.reserved[1] == b.reserved[1];
}

inline bool same_bits(const ClosestPoint& a, const ClosestPoint& b) {
    return same_bits(a.point, b.point) && same_bits(a.on_shape, b.on_shape) &&
           same_bits(a.face_normal, b.face_normal) && same_bits(a.distance, b.distance) && same_bits(a.u, b.u) &&
           same_bits(a.v, b.v) && a.triangle == b.triangle && a.status == b.status && a.feature == b.feature &&
           a.side == b.side;
}

inline bool same_bits(const SweepHit& a, const SweepHit& b) {
    return same_bits(a.t, b.t) && same_bits(a.point, b.point) && same_bits(a.normal, b.normal) &&
           same_bits(a.face_normal, b.face_normal) && a.triangle == b.triangle && a.status == b.status &&
           a.feature == b.feature && a.starts_overlapping == b.starts_overlapping;
}

inline bool same_bits(const Contact& a, const Contact& b) {
    return same_bits(a.point, b.point) && same_bits(a.normal, b.normal) && same_bits(a.distance, b.distance) &&
           a.triangle == b.triangle && a.feature == b.feature && a.side == b.side;
}

inline bool same_bits(const ContactPlane& a, const ContactPlane& b) {
    return same_bits(a.normal, b.normal) && same_bits(a.distance, b.distance) && a.triangle == b.triangle;
}

}  // namespace espalier::tests
