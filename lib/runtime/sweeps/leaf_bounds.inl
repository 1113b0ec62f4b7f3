// The triangles of a leaf that a moving shape may touch, each with a lower bound of the time: of the boxes around both
// first, and of the shapes where those meet.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/sweeps/beside_way.inl>
#include <runtime/sweeps/swept_box.inl>
#endif

/// Returns a time that is not after any of those in lanes that are set; below all times where boxes are met.
template <class Slots>
inline float earliest(const float* times, Slots slots) {
    float first = infinity;
    for (; slots != 0; slots &= slots - 1) first = minimum(times[std::countr_zero(slots)], first);
    return maximum(first - 0x1p-20f, 0.0f);
}

/// The vertices of a leaf, by number, in the coordinates of a moving shape: from where it starts.
template <class Leaf, unsigned groups>
class VerticesFromShape {
public:
    VerticesFromShape(const Leaf& leaf, const SweepInLanes& sweep) {
        for (unsigned k = 0; k < 3; ++k) {
            const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
            const Floats from = splat(sweep.from[k]), scale = splat(sweep.scale);
            for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
                const Floats steps = to_floats(add(offsets_of(leaf, k, group), anchor));
                coordinates_[k].set(group, subtract(multiply(steps, scale), from));
            }
        }
    }
    /// Calls `function(start, corners)` with the slot of the first lane and the triangles from there on.
    template <class Function>
    ESPALIER_ALWAYS_INLINE void for_each_group(const Leaf& leaf, Function function) const {
        auto corners = corners_of(leaf);
        for (unsigned start = 0; start < leaf.slot_count; start += lanes) {
            const auto numbers = corners.next();
            const auto look_up = [&](const Numbers& number) {
                return Floats3{coordinates_[0].look_up(number), coordinates_[1].look_up(number),
                               coordinates_[2].look_up(number)};
            };
            function(start, CornersFromPoint{look_up(numbers.a), look_up(numbers.b), look_up(numbers.c)});
        }
    }

private:
    Table<groups> coordinates_[3];
};

/// Of a leaf.
template <class Leaf>
struct LeafTimes {
    using Slots = typename Leaf::Slots;
    static constexpr unsigned room = (Leaf::max_slots + lanes - 1) / lanes * lanes;
    float first[room];  ///< of the triangles that fill() returns

    /// Returns the triangles that the shape may touch up to the limit.
    template <unsigned groups, class Bounds, class Sweep>
    ESPALIER_NOINLINE Slots fill(const Leaf& leaf, const Sweep& sweep, float limit) {
        const VerticesFromShape<Leaf, groups> vertices(leaf, sweep);
        const Slots met = meet<typename Bounds::Beside>(leaf, vertices, sweep, limit);
        return met == 0 || sweep.is_far ? met : tighten<Bounds>(leaf, vertices, sweep, limit, met);
    }

private:
    // Out of line: in one function, compilers give either step a place on the stack of its own.

    /// Returns the triangles that are not beside the way, and whose boxes the box of the shape meets.
    template <class Beside, class Vertices>
    ESPALIER_NOINLINE Slots meet(const Leaf& leaf, const Vertices& vertices, const typename Beside::Shape& sweep,
                                 float limit) {
        const SweptBox box(sweep);
        const Beside beside(sweep, limit);
        Slots met = 0;
        vertices.for_each_group(leaf, [&](unsigned start, const CornersFromPoint& t) {
            unsigned here = box.meet(t, limit, first + start);
            if (here != 0) here &= beside.meet(t);
            met |= Slots{here} << start;
        });
        return met & leaf.used_slots();
    }
    /// Returns those of them that the shape may touch by its own bounds.
    template <class Bounds, class Vertices, class Sweep>
    ESPALIER_NOINLINE Slots tighten(const Leaf& leaf, const Vertices& vertices, const Sweep& sweep, float limit,
                                    Slots met) {
        const Bounds bounds(sweep);
        const LaterBounds<Bounds> later(bounds, sweep, earliest(first, met));
        Slots near = 0;
        vertices.for_each_group(leaf, [&](unsigned start, const CornersFromPoint& t) {
            constexpr Slots all = (Slots{1} << lanes) - 1;
            if ((met >> start & all) == 0) return;
            const Floats times = later(t);
            store(first + start, times);
            near |= Slots{at_most(times, splat(limit))} << start;
        });
        return near & met;
    }
};
