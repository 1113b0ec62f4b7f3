// What bounds of all moving shapes have in common, in lanes: the boxes around them, and where on the way they begin.
#ifndef ESPALIER_SWEEPS_SWEPT_BOX_HPP
#define ESPALIER_SWEEPS_SWEPT_BOX_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/shapes_in_lanes.hpp>
#include <runtime/sweeps/time_bounds.hpp>

ESPALIER_BEGIN_SET

/// When the boxes around triangles are met by the one around a shape.
class SweptBox {
public:
    explicit SweptBox(const SweepInLanes& sweep) {
        for (unsigned k = 0; k < 3; ++k) {
            const float way = sweep.way[k];
            inverse_[k] = splat(1.0f / (absolute(way) < still ? still : way));
            low_[k] = splat(sweep.low[k]);
            high_[k] = splat(sweep.high[k]);
        }
    }
    /// Stores the times, and returns the lanes whose boxes are met up to the limit.
    ESPALIER_ALWAYS_INLINE unsigned meet(const CornersFromPoint& t, float limit, float* times) const {
        const BoxesFromPoint boxes(t);
        Floats enter = splat(0.0f), leave = splat(limit);
        for (int k = 0; k < 3; ++k) {
            const Floats one = multiply(subtract(boxes.low[k], high_[k]), inverse_[k]);
            const Floats other = multiply(subtract(boxes.high[k], low_[k]), inverse_[k]);
            enter = larger(smaller(one, other), enter);
            leave = smaller(larger(one, other), leave);
        }
        store(times, enter);
        return at_most(enter, leave);
    }

private:
    static constexpr float still = 0x1p-40f;
    Floats inverse_[3], low_[3], high_[3];
};

/// The bounds of a shape, once it has gone a part of its way: nearer to the triangles, numbers round less.
template <class Bounds>
class LaterBounds {
public:
    LaterBounds(const Bounds& bounds, const SweepInLanes& sweep, float begin)
        : bounds_(bounds), begin_(splat(begin * (1.0f - 0x1p-22f))) {
        gone_ = {splat(begin * sweep.way[0]), splat(begin * sweep.way[1]), splat(begin * sweep.way[2])};
    }
    [[nodiscard]] Floats operator()(const CornersFromPoint& t) const {
        const Floats3 corners[3] = {subtract(t.a, gone_), subtract(t.b, gone_), subtract(t.c, gone_)};
        return add(bounds_(corners), begin_);
    }

private:
    const Bounds& bounds_;
    Floats begin_;
    Floats3 gone_;
};

ESPALIER_END_SET

#endif
