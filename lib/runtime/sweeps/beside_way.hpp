// Triangles beside the way of a shape, in lanes: a direction separates both on all of the way.
#ifndef ESPALIER_SWEEPS_BESIDE_WAY_HPP
#define ESPALIER_SWEEPS_BESIDE_WAY_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/shapes_in_lanes.hpp>
#include <runtime/sweeps/time_bounds.hpp>

ESPALIER_BEGIN_SET

/// The test in place of BesideWay where bounds take no longer. It rejects nothing.
struct AnyPlace {
    using Shape = SweepInLanes;
    AnyPlace(const SweepInLanes&, float) {}
    [[nodiscard]] unsigned meet(const CornersFromPoint&) const { return ~0u; }
};

/// The test that rejects triangles beside the way, by one direction each. It takes less time than a bound. A direction
/// leads from the nearest point of the way of the capsule's middle to the mean of the corners.
class BesideWay {
public:
    using Shape = CapsuleInLanes;

    BesideWay(const CapsuleInLanes& capsule, float limit)
        : axis_(splat_each(capsule.axis)), thick_(splat(capsule.radius + rounding)) {
        float way[3], squared = 0.0f;
        for (unsigned k = 0; k < 3; ++k) {
            way[k] = capsule.way[k] * limit;
            squared += way[k] * way[k];
        }
        way_ = splat_each(way);
        inverse_ = splat(1.0f / maximum(squared, 0x1p-100f));
        middle_ = {multiply(axis_.x, splat(0.5f)), multiply(axis_.y, splat(0.5f)), multiply(axis_.z, splat(0.5f))};
    }
    /// Returns the lanes whose triangles may be touched up to the limit.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE unsigned meet(const CornersFromPoint& t) const {
        const auto mean = [](Floats a, Floats b, Floats c, Floats middle) {
            return multiply_subtract(add(a, add(b, c)), splat(1.0f / 3.0f), middle);
        };
        const Floats3 to_mean = {mean(t.a.x, t.b.x, t.c.x, middle_.x), mean(t.a.y, t.b.y, t.c.y, middle_.y),
                                 mean(t.a.z, t.b.z, t.c.z, middle_.z)};
        const Floats zero = splat(0.0f);
        const Floats share = larger(smaller(multiply(dot(to_mean, way_), inverse_), splat(1.0f)), zero);
        const Floats3 along = {subtract(to_mean.x, multiply(share, way_.x)),
                               subtract(to_mean.y, multiply(share, way_.y)),
                               subtract(to_mean.z, multiply(share, way_.z))};
        // At least the length, also where squares would be subnormal.
        const Floats length = square_roots(add(dot(along, along), splat(0x1p-100f)));
        const Floats ends = add(larger(dot(along, way_), zero), larger(dot(along, axis_), zero));
        const Floats nearest = smaller(dot(along, t.a), smaller(dot(along, t.b), dot(along, t.c)));
        return at_most(nearest, multiply_add(length, thick_, ends));
    }

private:
    static constexpr float rounding = 0x1p-18f;
    Floats3 way_, axis_, middle_;
    Floats thick_, inverse_;
};

ESPALIER_END_SET

#endif
