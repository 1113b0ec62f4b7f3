// A ray against each kind of volume. What is the same for all volumes is computed once for a ray.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <espalier/ray.hpp>

#include "stored.hpp"

namespace espalier::bench {

inline constexpr float no_entry = std::numeric_limits<float>::infinity();

inline float dot3(const float* a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Returns 1 / speed. A speed of 0 becomes a very small one: 1 / 0 would lead to 0 times infinity.
inline float inverse_of(float speed) { return 1.0f / std::copysign(std::max(std::abs(speed), 1e-18f), speed); }

/// A part of a ray: what lies in all the slabs so far.
struct RayPart {
    float begin = 0.0f;
    float end = no_entry;

    void cut(float first, float second) {
        begin = std::max(begin, std::min(first, second));
        end = std::min(end, std::max(first, second));
    }
    [[nodiscard]] float entry() const { return begin <= end ? begin : no_entry; }
};

/// A ray that is tested against volumes of one kind. `entry` returns t where it enters one, or infinity.
template <class Stored>
class PreparedRay;

/// Tests whether the line passes the center within the radius.
template <>
class PreparedRay<StoredSphere> {
public:
    explicit PreparedRay(const Ray& ray)
        : origin_{ray.origin.x, ray.origin.y, ray.origin.z}, along_{ray.direction.x, ray.direction.y, ray.direction.z} {
        const float length = std::sqrt(dot3(along_, along_));
        inverse_ = 1.0f / length;
        for (float& part : along_) part *= inverse_;
    }
    [[nodiscard]] float entry(const StoredSphere& sphere) const {
        float m[3];
        for (int i = 0; i < 3; ++i) m[i] = sphere.center[i] - origin_[i];
        const float along = dot3(m, along_);
        for (int i = 0; i < 3; ++i) m[i] -= along * along_[i];
        const float left = sphere.radius * sphere.radius - dot3(m, m);
        if (left < 0.0f) return no_entry;
        const float reach = std::sqrt(left);
        return along + reach < 0.0f ? no_entry : std::max(0.0f, (along - reach) * inverse_);
    }

private:
    float origin_[3], along_[3];
    float inverse_;  ///< of the direction's length
};

/// Tests three slabs (Kay, Kajiya 1986).
template <>
class PreparedRay<StoredAabb> {
public:
    explicit PreparedRay(const Ray& ray)
        : origin_{ray.origin.x, ray.origin.y, ray.origin.z},
          inverse_{inverse_of(ray.direction.x), inverse_of(ray.direction.y), inverse_of(ray.direction.z)} {}
    [[nodiscard]] float entry(const StoredAabb& box) const {
        RayPart part;
        for (int i = 0; i < 3; ++i) {
            const float middle = (box.center[i] - origin_[i]) * inverse_[i];
            const float reach = box.half[i] * std::abs(inverse_[i]);
            part.begin = std::max(part.begin, middle - reach);
            part.end = std::min(part.end, middle + reach);
        }
        return part.entry();
    }

private:
    float origin_[3], inverse_[3];
};

/// Turns the ray to the axes of the box, then tests three slabs.
template <>
class PreparedRay<StoredObb> {
public:
    explicit PreparedRay(const Ray& ray)
        : origin_{ray.origin.x, ray.origin.y, ray.origin.z},
          along_{ray.direction.x, ray.direction.y, ray.direction.z} {}
    [[nodiscard]] float entry(const StoredObb& box) const {
        float m[3];
        for (int i = 0; i < 3; ++i) m[i] = box.center[i] - origin_[i];
        RayPart part;
        for (int i = 0; i < 3; ++i) {
            const float inverse = inverse_of(dot3(box.axes[i], along_));
            const float middle = dot3(box.axes[i], m) * inverse;
            const float reach = box.half[i] * std::abs(inverse);
            part.begin = std::max(part.begin, middle - reach);
            part.end = std::min(part.end, middle + reach);
        }
        return part.entry();
    }

private:
    float origin_[3], along_[3];
};

/// Tests k / 2 slabs: the axes, and the others where the ray meets those.
template <std::size_t k>
class PreparedRay<StoredDop<k>> {
public:
    explicit PreparedRay(const Ray& ray) {
        const Point origin = {double(ray.origin.x), double(ray.origin.y), double(ray.origin.z)};
        const Point along = {double(ray.direction.x), double(ray.direction.y), double(ray.direction.z)};
        for (std::size_t i = 0; i < k / 2; ++i) {
            const Point& normal = slab_directions[StoredDop<k>::slabs[i]];
            origin_[i] = static_cast<float>(dot(normal, origin));
            inverse_[i] = inverse_of(static_cast<float>(dot(normal, along)));
        }
    }
    [[nodiscard]] float entry(const StoredDop<k>& dop) const {
        RayPart part;
        for (std::size_t i = 0; i < 3; ++i) cut(part, dop, i);
        if (part.begin > part.end) return no_entry;
        for (std::size_t i = 3; i < k / 2; ++i) cut(part, dop, i);
        return part.entry();
    }

private:
    void cut(RayPart& part, const StoredDop<k>& dop, std::size_t i) const {
        part.cut((dop.reach[i] - origin_[i]) * inverse_[i], (-dop.reach[i + k / 2] - origin_[i]) * inverse_[i]);
    }
    float origin_[k / 2], inverse_[k / 2];
};

}  // namespace espalier::bench
