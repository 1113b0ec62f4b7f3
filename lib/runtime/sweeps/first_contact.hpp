// Sweeps: lanes reject triangles and put the others in order, integers decide.
#ifndef ESPALIER_SWEEPS_FIRST_CONTACT_HPP
#define ESPALIER_SWEEPS_FIRST_CONTACT_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/slab_test.hpp>
#include <runtime/rays/prepare_ray.hpp>
#include <runtime/sweeps/capsule_bounds.hpp>
#include <runtime/sweeps/hull_bounds.hpp>
#include <runtime/sweeps/queries.hpp>
#include <runtime/traversal/find.hpp>

ESPALIER_BEGIN_SET

/// Whether float bounds of the time of contact are cheaper than the exact test. They are not without a float unit, nor
/// for an axis-aligned box on a small core.
template <class Sweep>
inline constexpr bool has_bounds = has_square_root && !(small_code && std::is_same_v<Sweep, BoxSweep>);

/// Returns the last tick that is not after a time.
inline SweepTick last_tick_until(float time) {
    return static_cast<SweepTick>(static_cast<std::int32_t>(time * static_cast<float>(whole_way)));
}

/// Calls `decide(slot)` for the slots that are set, the earliest first; `decide` returns the time from which on others
/// do not matter.
template <class Slots, class Decide>
ESPALIER_ALWAYS_INLINE inline void decide_earliest_first(const float* times, Slots slots, float limit, Decide decide) {
    while (slots != 0) {
        auto first = static_cast<unsigned>(std::countr_zero(slots));
        for (Slots others = slots & (slots - 1); others != 0; others &= others - 1) {
            const auto other = static_cast<unsigned>(std::countr_zero(others));
            if (times[other] < times[first]) first = other;
        }
        if (times[first] > limit) return;
        slots &= ~(Slots{1} << first);
        limit = decide(first);
    }
}

/// Whether triangles come in the order of bounds, one by one: in small code with a float unit.
inline constexpr bool is_bounded_one_by_one = small_code && has_square_root;

/// In place of a frame where there is none.
struct NoFrame {
    explicit NoFrame(const FloatSweep&) {}
};

// The shapes. `Memory` is what the decision on one triangle leaves for the next: it saves time and changes no answer.

struct BoxSweepKernel {
    using Sweep = BoxSweep;
    using FloatShape = FloatBox;
    using Bounds = BoxBounds;
    struct Memory {};
    using Frame = NoFrame;

    static SweepTick contact(const BoxSweep& sweep, const FloatBox&, Memory&, const LatticeTriangle& triangle,
                             SweepTick, SweepTick most) {
        return first_contact_tick(sweep, triangle, most);
    }
};

struct HullSweepKernel {
    using Sweep = HullSweep;
    using FloatShape = FloatHull;
    using Bounds = HullBounds;
    using Memory = PlaneAhead;
    using Frame = NoFrame;

    static SweepTick contact(const HullSweep& sweep, const FloatHull&, PlaneAhead& plane,
                             const LatticeTriangle& triangle, SweepTick, SweepTick most) {
        return first_contact_tick(sweep, triangle, most, plane);
    }
};

struct CapsuleSweepKernel {
    using Sweep = CapsuleSweep;
    using FloatShape = FloatCapsule;
    using Bounds = CapsuleBounds;
    struct Memory {};
    using Frame = std::conditional_t<is_bounded_one_by_one, SeparatingDirections, NoFrame>;

    static SweepTick contact(const CapsuleSweep& sweep, const FloatCapsule& float_shape, Memory&,
                             const LatticeTriangle& triangle, SweepTick least, SweepTick most) {
        if (float_shape.is_sphere)
            return first_contact_tick(sweep.moving.sphere, sweep.seen_from(sweep.from, triangle), most, least);
        if (least == 0 && touches_at_start(sweep, triangle)) return 0;
        if (most == 0) return no_contact;
        if (!has_bounds<CapsuleSweep> || float_shape.is_far) return first_contact_after_start(sweep, triangle, most);
        return contact_of_prism(sweep, float_shape, triangle, least, most);
    }

private:
    static constexpr unsigned faces = 8;
    /// When the sphere may first touch each face of the prism.
    struct FaceTimes {
        static constexpr unsigned room = faces > lanes ? faces : lanes;
        float first[room];

        /// Returns the faces that it may touch up to the limit, and not before `begin`.
        ESPALIER_NOINLINE unsigned fill(const FloatCapsule& capsule, const LatticeTriangle& triangle, float begin,
                                        float limit) {
            float corners[3][3][room];
            for (unsigned face = 0; face < room; ++face)
                for (unsigned i = 0; i < 3; ++i) {
                    const unsigned corner = faces_of_prism[face % faces][i];
                    for (unsigned k = 0; k < 3; ++k) {
                        const float at =
                            static_cast<float>(triangle.corner[corner & 3u][k]) * capsule.scale - capsule.from[k];
                        corners[i][k][face] = corner < 4 ? at : at - capsule.axis[k];
                    }
                }
            FloatCapsule sphere = capsule;
            sphere.is_sphere = true;
            const CapsuleBounds bounds(sphere);
            const LaterBounds<CapsuleBounds> later(bounds, sphere, begin);
            unsigned near = 0;
            for (unsigned start = 0; start < faces; start += lanes) {
                const auto load = [&](unsigned i) {
                    return Floats3{load_as<Floats>(corners[i][0] + start), load_as<Floats>(corners[i][1] + start),
                                   load_as<Floats>(corners[i][2] + start)};
                };
                const Floats times = later({load(0), load(1), load(2)});
                store(first + start, times);
                near |= at_most(times, splat(limit)) << start;
            }
            return near & ((1u << faces) - 1);
        }
    };
    /// For a capsule that does not touch at the start.
    ESPALIER_NOINLINE static SweepTick contact_of_prism(const CapsuleSweep& sweep, const FloatCapsule& float_shape,
                                                        const LatticeTriangle& triangle, SweepTick least,
                                                        SweepTick most) {
        FaceTimes times;
        const unsigned near = times.fill(float_shape, triangle, share_of_way(least), share_of_way(most));
        const IntegerTriangle seen = sweep.seen_from(sweep.from, triangle);
        SweepTick best = no_contact;
        decide_earliest_first(times.first, near, share_of_way(most), [&](unsigned face) {
            const SweepTick tick = first_contact_tick(sweep.moving.sphere, face_of_prism(sweep.moving, seen, face),
                                                      most, last_tick_until(times.first[face]));
            if (tick != no_contact) {
                best = tick;
                most = tick - 1;
            }
            return share_of_way(most);
        });
        return best;
    }
};

/// A shape on its way.
template <class Kernel, class Node>
struct MovingShape {
    struct CostlyLeaves {};
    using Sweep = typename Kernel::Sweep;
    using FloatShape = typename Kernel::FloatShape;

    const RayLanesOf<Node>& ray_lanes;
    const Sweep& sweep;
    const FloatShape& float_shape;
    typename Kernel::Memory& memory;
    const typename Kernel::Frame& frame;
    const SweepOptions& options;

    ESPALIER_ALWAYS_INLINE unsigned cull(const Node& node, float limit, Keys keys) const {
        return slab_test(node, ray_lanes, limit, keys);
    }
    template <class Leaf>
    Visit scan(const Leaf& leaf, Closest<FoundContact>& answer) const {
        LeafTimes<Leaf> times;
        const auto near = times.template fill<typename Kernel::Bounds>(leaf, float_shape, answer.limit);
        decide_earliest_first(times.first, near, answer.limit, [&](unsigned slot) {
            offer(leaf, slot, leaf.triangle(slot), times.first[slot], answer);
            return answer.limit;
        });
        return Visit::next;
    }
    /// For cores without lanes.
    template <class Leaf>
    requires(lanes == 1) Visit
        decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Closest<FoundContact>& answer)
    const {
        const float time = time_of(triangle, answer.limit);
        if (time <= answer.limit) offer(leaf, slot, triangle, time, answer);
        return Visit::next;
    }

    /// For those of them with a float unit.
    [[nodiscard]] float bound(const LatticeTriangle& triangle, float limit) const requires is_bounded_one_by_one {
        if constexpr (std::is_same_v<typename Kernel::Frame, NoFrame>) return time_of(triangle, limit);
        else return frame.bound(triangle, limit);
    }
    [[nodiscard]] float tighten(const LatticeTriangle& triangle, float time,
                                float) const requires is_bounded_one_by_one {
        if constexpr (has_bounds<Sweep>)
            if (!float_shape.is_far) return maximum(tighter(triangle, time), time);
        return time;
    }
    template <class Leaf>
    requires is_bounded_one_by_one Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle,
                                                float time, Closest<FoundContact>& answer)
    const {
        offer(leaf, slot, triangle, time, answer);
        return Visit::next;
    }

private:
    /// Returns a bound for one triangle. Out of line, so that its stack is free again when a kernel is called.
    [[nodiscard]] ESPALIER_NOINLINE float time_of(const LatticeTriangle& triangle, float limit) const {
        float enter = ray_lanes.tau_min, leave = limit;
        for (unsigned k = 0; k < 3; ++k) {
            const auto at = [&](unsigned i) {
                return static_cast<float>(triangle.corner[i][k]) * ray_lanes.inverse[k];
            };
            const float a = at(0), b = at(1), c = at(2);
            enter = maximum(minimum(a, minimum(b, c)) + ray_lanes.near_offset[k], enter);
            leave = minimum(maximum(a, maximum(b, c)) + ray_lanes.far_offset[k], leave);
        }
        if (enter > leave) return time_bounds::never;
        if constexpr (has_bounds<Sweep>)
            if (!float_shape.is_far) return tighter(triangle, enter);
        return enter;
    }
    [[nodiscard]] float tighter(const LatticeTriangle& triangle, float enter) const {
        Floats at[3][3];
        for (unsigned i = 0; i < 3; ++i)
            for (unsigned k = 0; k < 3; ++k)
                at[i][k] = static_cast<float>(triangle.corner[i][k]) * float_shape.scale - float_shape.from[k];
        const CornersFromPoint t = {
            {at[0][0], at[0][1], at[0][2]}, {at[1][0], at[1][1], at[1][2]}, {at[2][0], at[2][1], at[2][2]}};
        using Bounds = typename Kernel::Bounds;
        const Bounds bounds(float_shape);
        return LaterBounds<Bounds>(bounds, float_shape, earliest(&enter, 1u))(t);
    }
    template <class Leaf>
    void offer(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, float time,
               Closest<FoundContact>& answer) const {
        const std::uint32_t index = owner_index(leaf, slot);
        // On a tie the lower index wins; at the start the deepest triangle does.
        const SweepTick most = !answer.found()                                      ? whole_way
                               : index < answer.best.index || answer.best.tick == 0 ? answer.best.tick
                                                                                    : answer.best.tick - 1;
        const SweepTick tick =
            Kernel::contact(sweep, float_shape, memory, triangle, has_bounds<Sweep> ? last_tick_until(time) : 0, most);
        if (tick == no_contact || is_left_out(sweep, triangle, tick, options)) return;
        answer.take(found_contact(sweep, triangle, index, tick));
    }
};

template <class Kernel>
inline FoundContact find_first_contact(const BlobData& blob, const typename Kernel::Sweep& sweep,
                                       const SweepOptions& options) {
    FoundContact best;
    Closest<FoundContact> answer(best, options.filter);
    answer.limit = 1.0f;
    const auto shape_in_floats = float_shape(blob, sweep);
    typename Kernel::Memory memory;
    const typename Kernel::Frame frame(shape_in_floats);
    with_leaves_of(blob, [&]<class Leaf>() {
        using Node = typename Leaf::Node;
        const auto ray_lanes = spread_sweep<RayLanesOf<Node>>(blob, sweep);
        MovingShape<Kernel, Node> shape = {ray_lanes, sweep, shape_in_floats, memory, frame, options};
        find_nearest_first_in<Leaf>(blob, shape, answer);
    });
    return best;
}

ESPALIER_QUERY_OF_SET FoundContact first_contact(const BlobData& blob, const CapsuleSweep& sweep,
                                                 const SweepOptions& options) {
    return find_first_contact<CapsuleSweepKernel>(blob, sweep, options);
}
ESPALIER_QUERY_OF_SET FoundContact first_contact(const BlobData& blob, const BoxSweep& sweep,
                                                 const SweepOptions& options) {
    return find_first_contact<BoxSweepKernel>(blob, sweep, options);
}
ESPALIER_QUERY_OF_SET FoundContact first_contact(const BlobData& blob, const HullSweep& sweep,
                                                 const SweepOptions& options) {
    return find_first_contact<HullSweepKernel>(blob, sweep, options);
}

ESPALIER_END_SET

#endif
