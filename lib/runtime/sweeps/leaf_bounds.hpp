// The triangles of a leaf that a moving shape may touch, each with a lower bound of the time: of the boxes around both
// first, and of the shapes where those meet.
#ifndef ESPALIER_SWEEPS_LEAF_BOUNDS_HPP
#define ESPALIER_SWEEPS_LEAF_BOUNDS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/sweeps/beside_way.hpp>
#include <runtime/sweeps/swept_box.hpp>

ESPALIER_BEGIN_SET

/// Returns a time that is not after any of those in lanes that are set; below all times where boxes are met.
template <class Slots>
inline float earliest(const float* times, Slots slots) {
    float first = infinity;
    for (; slots != 0; slots &= slots - 1) first = minimum(times[std::countr_zero(slots)], first);
    return maximum(first - 0x1p-20f, 0.0f);
}

/// The vertices of a leaf, relative to where a moving shape starts, whatever number of groups they fill. Each
/// shape has its code once for a kind of leaf, not once for each number of groups. The call through a pointer takes
/// little of the time that a bound takes.
template <class Leaf>
class VerticesFromShape {
public:
    using Slots = typename Leaf::Slots;
    static constexpr Slots every_slot = static_cast<Slots>(~Slots{0});

    /// Calls `function(start, corners)` with the first slot and the triangles of each group of lanes, of which one is
    /// wanted. The function returns a bit for each lane. Returns all of them.
    template <class Function>
    ESPALIER_ALWAYS_INLINE Slots for_each_group(Slots wanted, Function function) const {
        return visit_groups_(*this, wanted, &function, call<Function>);
    }

protected:
    using Call = unsigned (*)(void* function, unsigned start, const CornersFromPoint& corners);
    using VisitGroups = Slots (*)(const VerticesFromShape& self, Slots wanted, void* function, Call call);

    explicit VerticesFromShape(VisitGroups visit_groups) : visit_groups_(visit_groups) {}

private:
    template <class Function>
    static unsigned call(void* function, unsigned start, const CornersFromPoint& corners) {
        return (*static_cast<Function*>(function))(start, corners);
    }
    VisitGroups visit_groups_;
};

template <class Leaf, unsigned groups>
class VerticesInTable : public VerticesFromShape<Leaf> {
    using Base = VerticesFromShape<Leaf>;
    using typename Base::Slots;

public:
    VerticesInTable(const Leaf& leaf, const SweepInLanes& sweep) : Base(visit), leaf_(leaf) {
        for (unsigned k = 0; k < 3; ++k) {
            const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
            const Floats from = splat(sweep.from[k]), scale = splat(sweep.scale);
            for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
                const Floats steps = to_floats(add(offsets_of(leaf, k, group), anchor));
                coordinates_[k].set(group, subtract(multiply(steps, scale), from));
            }
        }
    }

    /// Calls the function directly, without a pointer.
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
    ESPALIER_NOINLINE static Slots visit(const Base& base, Slots wanted, void* function, typename Base::Call call) {
        return static_cast<const VerticesInTable&>(base).for_each_group(
            wanted, [&](unsigned start, const CornersFromPoint& seen)
                        ESPALIER_ALWAYS_INLINE_LAMBDA { return call(function, start, seen); });
    }

    const Leaf& leaf_;
    Table<groups> coordinates_[3];
};

/// The bounds of the triangles of a leaf.
template <class Leaf>
struct LeafTimes {
    using Slots = typename Leaf::Slots;
    using Vertices = VerticesFromShape<Leaf>;
    static constexpr unsigned room = (Leaf::max_slots + lanes - 1) / lanes * lanes;
    float first[room];  ///< of the triangles that fill() returns

    /// Returns the triangles that the shape may touch up to the limit.
    template <class Bounds, class Sweep>
    Slots fill(const Leaf& leaf, const Sweep& sweep, float limit) {
        return with_table_groups<Leaf::max_vertices>(leaf.vertex_count, [&](auto groups) {
            // The call through a pointer costs eight lanes and more 2 to 5 %, and few groups hold every leaf there.
            if constexpr (lanes >= 8) return fill_alone<groups, Bounds>(leaf, sweep, limit);
            else return fill_with<groups>(leaf, sweep, &sweep, limit, finish<Bounds, Sweep>);
        });
    }

private:
    using Finish = Slots (*)(LeafTimes& self, const Leaf& leaf, const Vertices& vertices, const void* sweep,
                             float limit);

    template <unsigned groups>
    ESPALIER_NOINLINE Slots fill_with(const Leaf& leaf, const SweepInLanes& sweep, const void* shape, float limit,
                                      Finish finish_with) {
        const VerticesInTable<Leaf, groups> vertices(leaf, sweep);
        return finish_with(*this, leaf, vertices, shape, limit);
    }
    template <unsigned groups, class Bounds, class Sweep>
    ESPALIER_NOINLINE Slots fill_alone(const Leaf& leaf, const Sweep& sweep, float limit) {
        const VerticesInTable<Leaf, groups> vertices(leaf, sweep);
        const Slots met = meet<typename Bounds::Beside>(leaf, vertices, sweep, limit);
        return met == 0 || sweep.is_far ? met : tighten<Bounds>(vertices, sweep, limit, met);
    }
    template <class Bounds, class Sweep>
    static Slots finish(LeafTimes& self, const Leaf& leaf, const Vertices& vertices, const void* shape, float limit) {
        const Sweep& sweep = *static_cast<const Sweep*>(shape);
        const Slots met = self.template meet<typename Bounds::Beside>(leaf, vertices, sweep, limit);
        return met == 0 || sweep.is_far ? met : self.template tighten<Bounds>(vertices, sweep, limit, met);
    }

    // Out of line: in one function, compilers give either step a place on the stack of its own.

    /// Returns the triangles that are not beside the way, and whose boxes the box of the shape meets.
    template <class Beside, class SomeVertices>
    ESPALIER_NOINLINE Slots meet(const Leaf& leaf, const SomeVertices& vertices, const typename Beside::Shape& sweep,
                                 float limit) {
        const SweptBox box(sweep);
        const Beside beside(sweep, limit);
        const Slots met = vertices.for_each_group(
            Vertices::every_slot, [&](unsigned start, const CornersFromPoint& t) ESPALIER_ALWAYS_INLINE_LAMBDA {
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
