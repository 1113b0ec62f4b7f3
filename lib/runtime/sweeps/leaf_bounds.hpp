// The triangles of a leaf that a moving shape may touch, each with a lower bound of the time: of the boxes around both
// first, and of the shapes where those meet.
#ifndef ESPALIER_SWEEPS_LEAF_BOUNDS_HPP
#define ESPALIER_SWEEPS_LEAF_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/float_shapes.hpp>
#include <runtime/sweeps/time_bounds.hpp>

ESPALIER_BEGIN_SET

/// When the boxes around triangles are met by the one around a shape.
class SweptBox {
public:
    explicit SweptBox(const FloatSweep& sweep) {
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

/// The test in place of BesideWay where bounds take no longer. It rejects nothing.
struct AnyPlace {
    using Shape = FloatSweep;
    AnyPlace(const FloatSweep&, float) {}
    [[nodiscard]] unsigned meet(const CornersFromPoint&) const { return ~0u; }
};

/// The test that rejects triangles beside the way, by one direction each. It takes less time than a bound. A direction
/// leads from the nearest point of the way of the capsule's middle to the mean of the corners.
class BesideWay {
public:
    using Shape = FloatCapsule;

    BesideWay(const FloatCapsule& capsule, float limit)
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

/// The bounds of a shape, once it has gone a part of its way: nearer to the triangles, numbers round less.
template <class Bounds>
class LaterBounds {
public:
    LaterBounds(const Bounds& bounds, const FloatSweep& sweep, float begin)
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

/// Returns a time that is not after any of those in lanes that are set; below all times where boxes are met.
template <class Slots>
inline float earliest(const float* times, Slots slots) {
    float first = infinity;
    for (; slots != 0; slots &= slots - 1) first = minimum(times[std::countr_zero(slots)], first);
    return maximum(first - 0x1p-20f, 0.0f);
}

/// The vertices of a leaf, relative to where a moving shape starts.
template <class Leaf, unsigned groups>
class VerticesFromShape {
    using Slots = typename Leaf::Slots;

public:
    VerticesFromShape(const Leaf& leaf, const FloatSweep& sweep) : leaf_(leaf) {
        for (unsigned k = 0; k < 3; ++k) {
            const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
            const Floats from = splat(sweep.from[k]), scale = splat(sweep.scale);
            for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
                const Floats steps = to_floats(add(offsets_of(leaf, k, group), anchor));
                coordinates_[k].set(group, subtract(multiply(steps, scale), from));
            }
        }
    }
    /// Calls `function(start, corners)` with the first slot and the triangles of each group of lanes, of which one is
    /// wanted. The function returns a bit for each lane. Returns all of them.
    template <class Function>
    ESPALIER_ALWAYS_INLINE Slots for_each_group(Slots wanted, Function function) const {
        constexpr Slots all = (Slots{1} << lanes) - 1;
        auto corners = corners_of(leaf_);
        Slots slots = 0;
        for (unsigned start = 0; start < leaf_.slot_count; start += lanes) {
            const auto numbers = corners.next();
            if ((wanted >> start & all) == 0) continue;
            const auto look_up = [&](const Numbers& number) ESPALIER_ALWAYS_INLINE_LAMBDA {
                return Floats3{coordinates_[0].look_up(number), coordinates_[1].look_up(number),
                               coordinates_[2].look_up(number)};
            };
            const CornersFromPoint seen = {look_up(numbers.a), look_up(numbers.b), look_up(numbers.c)};
            slots |= Slots{function(start, seen)} << start;
        }
        return slots;
    }

private:
    const Leaf& leaf_;
    Table<groups> coordinates_[3];
};

/// The bounds of the triangles of a leaf.
template <class Leaf>
struct LeafTimes {
    using Slots = typename Leaf::Slots;
    static constexpr unsigned room = (Leaf::max_slots + lanes - 1) / lanes * lanes;
    float first[room];  ///< of the triangles that fill() returns

    /// Returns the triangles that the shape may touch up to the limit.
    template <class Bounds, class Sweep>
    Slots fill(const Leaf& leaf, const Sweep& sweep, float limit) {
        // Tables in memory are looked up as fast whatever their size: with four lanes a bound has its code once, not
        // once for each number of groups.
        const unsigned vertex_count = lanes > 4 ? leaf.vertex_count : Leaf::max_vertices;
        return with_table_groups<Leaf::max_vertices>(
            vertex_count, [&](auto groups) { return fill_in<groups, Bounds>(leaf, sweep, limit); });
    }

private:
    // Out of line: in one function, compilers give each step a place on the stack of its own.

    template <unsigned groups, class Bounds, class Sweep>
    ESPALIER_NOINLINE Slots fill_in(const Leaf& leaf, const Sweep& sweep, float limit) {
        const VerticesFromShape<Leaf, groups> vertices(leaf, sweep);
        const Slots met = meet<typename Bounds::Beside>(leaf, vertices, sweep, limit);
        // Of so few triangles bounds take longer than the decisions that they may save.
        const bool are_few = lanes > 1 && std::popcount(met) <= Bounds::few(sweep);
        return are_few || sweep.is_far ? met : tighten<Bounds>(vertices, sweep, limit, met);
    }
    /// Returns the triangles that are not beside the way, and whose boxes the box of the shape meets.
    template <class Beside, class SomeVertices>
    ESPALIER_NOINLINE Slots meet(const Leaf& leaf, const SomeVertices& vertices, const typename Beside::Shape& sweep,
                                 float limit) {
        const SweptBox box(sweep);
        const Beside beside(sweep, limit);
        const Slots met = vertices.for_each_group(
            ~Slots{0}, [&](unsigned start, const CornersFromPoint& t) ESPALIER_ALWAYS_INLINE_LAMBDA {
                const unsigned here = box.meet(t, limit, first + start);
                return here != 0 ? here & beside.meet(t) : here;
            });
        return met & leaf.used_slots();
    }
    /// Returns those of them that the shape may touch by its own bounds.
    template <class Bounds, class SomeVertices, class Sweep>
    ESPALIER_NOINLINE Slots tighten(const SomeVertices& vertices, const Sweep& sweep, float limit, Slots met) {
        const Bounds bounds(sweep);
        const LaterBounds<Bounds> later(bounds, sweep, earliest(first, met));
        return met & vertices.for_each_group(
                         met, [&](unsigned start, const CornersFromPoint& t) ESPALIER_ALWAYS_INLINE_LAMBDA {
                             const Floats times = later(t);
                             store(first + start, times);
                             return at_most(times, splat(limit));
                         });
    }
};

ESPALIER_END_SET

#endif
