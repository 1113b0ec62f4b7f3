// A k-DOP that is turned is no k-DOP of the same directions: it is enclosed in a new one ("Rapid collision detection by
// dynamically aligned DOP-trees", Zachmann 1998).
#pragma once

#include "../study/shapes.hpp"

namespace espalier::bench {

/// Computes how far a placed k-DOP reaches along each normal from how far it reaches along three of its own normals.
/// Which three depends on the pose alone: the normal, turned back, is a sum of them with weights that are not negative.
template <std::size_t k>
class DopTurn {
public:
    explicit DopTurn(const Pose& pose);

    /// Encloses `from`, placed, in `to`. Both are as in StoredDop.
    void enclose(const float (&from)[k], float (&to)[k]) const {
        for (std::size_t i = 0; i < k / 2; ++i) {
            const Sum& s = sums_[i];
            to[i] = s.weights[0] * from[s.normals[0]] + s.weights[1] * from[s.normals[1]] +
                    s.weights[2] * from[s.normals[2]] + s.shift;
            to[i + k / 2] = s.weights[0] * from[s.opposites[0]] + s.weights[1] * from[s.opposites[1]] +
                            s.weights[2] * from[s.opposites[2]] - s.shift;
        }
    }

private:
    struct Sum {
        std::uint8_t normals[3];
        std::uint8_t opposites[3];
        float weights[3];
        float shift;  ///< of the pose, along the normal
    };
    std::array<Sum, k / 2> sums_;
};

extern template class DopTurn<14>;
extern template class DopTurn<18>;
extern template class DopTurn<26>;

// A ray against each kind of volume. What is the same for all volumes is computed once for a ray.

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

// A ball against each kind of volume.

/// A ball that is tested against volumes of one kind.
template <class Stored>
class PreparedBall {
public:
    explicit PreparedBall(const Ball& ball) : radius_(static_cast<float>(ball.radius)) { store(ball.center, center_); }
    [[nodiscard]] bool touches(const StoredSphere& sphere) const {
        float out[3];
        for (int i = 0; i < 3; ++i) out[i] = center_[i] - sphere.center[i];
        const float reach = sphere.radius + radius_;
        return dot3(out, out) <= reach * reach;
    }
    [[nodiscard]] bool touches(const StoredAabb& box) const {
        float out[3];
        for (int i = 0; i < 3; ++i) out[i] = center_[i] - box.center[i];
        return is_near(out, box.half);
    }
    [[nodiscard]] bool touches(const StoredObb& box) const {
        float out[3], along[3];
        for (int i = 0; i < 3; ++i) out[i] = center_[i] - box.center[i];
        for (int i = 0; i < 3; ++i) along[i] = dot3(box.axes[i], out);
        return is_near(along, box.half);
    }

private:
    /// Tests the distance of a box whose middle is `out` away, along the axes of the box.
    [[nodiscard]] bool is_near(const float (&out)[3], const float (&half)[3]) const {
        float beyond[3];
        for (int i = 0; i < 3; ++i) beyond[i] = std::max(std::abs(out[i]) - half[i], 0.0f);
        return dot3(beyond, beyond) <= radius_ * radius_;
    }
    float center_[3], radius_;
};

/// Tests k / 2 intervals: in those of a k-DOP, a ball is a k-DOP.
template <std::size_t k>
class PreparedBall<StoredDop<k>> {
public:
    explicit PreparedBall(const Ball& ball) {
        for (std::size_t i = 0; i < k / 2; ++i) {
            const Point& normal = slab_directions[StoredDop<k>::slabs[i]];
            const double along = dot(normal, ball.center), radius = ball.radius * std::sqrt(dot(normal, normal));
            reach_[i] = static_cast<float>(along + radius);
            reach_[i + k / 2] = static_cast<float>(radius - along);
        }
    }
    [[nodiscard]] bool touches(const StoredDop<k>& dop) const {
        for (std::size_t i = 0; i < k / 2; ++i)
            if (dop.reach[i] + reach_[i + k / 2] < 0.0f || reach_[i] + dop.reach[i + k / 2] < 0.0f) return false;
        return true;
    }

private:
    float reach_[k];
};

}  // namespace espalier::bench
