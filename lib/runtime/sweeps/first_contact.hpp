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

/// Returns the last step that is not after a time.
inline SweepStep step_before(float time) {
    return static_cast<SweepStep>(static_cast<std::int32_t>(time * static_cast<float>(whole_way)));
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
    explicit NoFrame(const SweepInLanes&) {}
};

// The shapes. `Memory` is what the decision on one triangle leaves for the next: it saves time and changes no answer.

struct BoxMover {
    using Sweep = BoxSweep;
    using InLanes = BoxInLanes;
    using Bounds = BoxBounds;
    struct Memory {};
    using Frame = NoFrame;

    static SweepStep contact(const BoxSweep& sweep, const BoxInLanes&, Memory&, const LatticeTriangle& triangle,
                             SweepStep, SweepStep most) {
        return first_contact(sweep, triangle, most);
    }
};

struct HullMover {
    using Sweep = HullSweep;
    using InLanes = HullInLanes;
    using Bounds = HullBounds;
    using Memory = PlaneAhead;
    using Frame = NoFrame;

    static SweepStep contact(const HullSweep& sweep, const HullInLanes&, PlaneAhead& plane,
                             const LatticeTriangle& triangle, SweepStep, SweepStep most) {
        return first_contact(sweep, triangle, most, plane);
    }
};

struct CapsuleMover {
    using Sweep = CapsuleSweep;
    using InLanes = CapsuleInLanes;
    using Bounds = CapsuleBounds;
    struct Memory {};
    using Frame = std::conditional_t<is_bounded_one_by_one, SeparatingDirections, NoFrame>;

    static SweepStep contact(const CapsuleSweep& sweep, const CapsuleInLanes& in_lanes, Memory&,
                             const LatticeTriangle& triangle, SweepStep least, SweepStep most) {
        if (in_lanes.is_sphere)
            return first_contact(sweep.moving.sphere, sweep.seen_from(sweep.from, triangle), most, least);
        if (least == 0 && touches_at_start(sweep, triangle)) return 0;
        if (most == 0) return no_contact;
        if (!has_bounds<CapsuleSweep> || in_lanes.is_far) return first_contact_after_start(sweep, triangle, most);
        return contact_of_prism(sweep, in_lanes, triangle, least, most);
    }

private:
    static constexpr unsigned faces = 8;
    /// When the sphere may first touch each face of the prism.
    struct FaceTimes {
        static constexpr unsigned room = faces > lanes ? faces : lanes;
        float first[room];

        /// Returns the faces that it may touch up to the limit, and not before `begin`.
        ESPALIER_NOINLINE unsigned fill(const CapsuleInLanes& capsule, const LatticeTriangle& triangle, float begin,
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
            CapsuleInLanes sphere = capsule;
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
    ESPALIER_NOINLINE static SweepStep contact_of_prism(const CapsuleSweep& sweep, const CapsuleInLanes& in_lanes,
                                                        const LatticeTriangle& triangle, SweepStep least,
                                                        SweepStep most) {
        FaceTimes times;
        const unsigned near = times.fill(in_lanes, triangle, share_of_way(least), share_of_way(most));
        const IntegerTriangle seen = sweep.seen_from(sweep.from, triangle);
        SweepStep best = no_contact;
        decide_earliest_first(times.first, near, share_of_way(most), [&](unsigned face) {
            const SweepStep step = first_contact(sweep.moving.sphere, face_of_prism(sweep.moving, seen, face), most,
                                                 step_before(times.first[face]));
            if (step != no_contact) {
                best = step;
                most = step - 1;
            }
            return share_of_way(most);
        });
        return best;
    }
};

/// A shape on its way.
template <class Mover, class Node>
struct MovingShape {
    struct CostlyLeaves {};
    using Sweep = typename Mover::Sweep;
    using InLanes = typename Mover::InLanes;

    const RayLanesOf<Node>& ray_lanes;
    const Sweep& sweep;
    const InLanes& in_lanes;
    typename Mover::Memory& memory;
    const typename Mover::Frame& frame;
    const SweepOptions& options;

    ESPALIER_ALWAYS_INLINE unsigned cull(const Node& node, float limit, Keys keys) const {
        return slab_test(node, ray_lanes, limit, keys);
    }
    template <class Leaf>
    Visit scan(const Leaf& leaf, Closest<FoundContact>& answer) const {
        LeafTimes<Leaf> times;
        const auto near = times.template fill<typename Mover::Bounds>(leaf, in_lanes, answer.limit);
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
        if constexpr (std::is_same_v<typename Mover::Frame, NoFrame>) return time_of(triangle, limit);
        else return frame.first_contact(triangle, limit);
    }
    [[nodiscard]] float tighten(const LatticeTriangle& triangle, float time,
                                float) const requires is_bounded_one_by_one {
        if constexpr (has_bounds<Sweep>)
            if (!in_lanes.is_far) return maximum(tighter(triangle, time), time);
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
            if (!in_lanes.is_far) return tighter(triangle, enter);
        return enter;
    }
    [[nodiscard]] float tighter(const LatticeTriangle& triangle, float enter) const {
        Floats at[3][3];
        for (unsigned i = 0; i < 3; ++i)
            for (unsigned k = 0; k < 3; ++k)
                at[i][k] = static_cast<float>(triangle.corner[i][k]) * in_lanes.scale - in_lanes.from[k];
        const CornersFromPoint t = {
            {at[0][0], at[0][1], at[0][2]}, {at[1][0], at[1][1], at[1][2]}, {at[2][0], at[2][1], at[2][2]}};
        using Bounds = typename Mover::Bounds;
        const Bounds bounds(in_lanes);
        return LaterBounds<Bounds>(bounds, in_lanes, earliest(&enter, 1u))(t);
    }
    template <class Leaf>
    void offer(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, float time,
               Closest<FoundContact>& answer) const {
        const std::uint32_t index = owner_index(leaf, slot);
        // On a tie the lower index wins; at the start the deepest triangle does.
        const SweepStep most = !answer.found()                                      ? whole_way
                               : index < answer.best.index || answer.best.step == 0 ? answer.best.step
                                                                                    : answer.best.step - 1;
        const SweepStep step =
            Mover::contact(sweep, in_lanes, memory, triangle, has_bounds<Sweep> ? step_before(time) : 0, most);
        if (step == no_contact || is_left_out(sweep, triangle, step, options)) return;
        answer.take(found_contact(sweep, triangle, index, step));
    }
};

template <class Mover>
inline FoundContact find_first_contact(const BlobData& blob, const typename Mover::Sweep& sweep,
                                       const SweepOptions& options) {
    FoundContact best;
    Closest<FoundContact> answer(best, options.filter ? &options.filter : nullptr);
    answer.limit = 1.0f;
    const auto shape_in_lanes = in_lanes(blob, sweep);
    typename Mover::Memory memory;
    const typename Mover::Frame frame(shape_in_lanes);
    with_leaves_of(blob, [&]<class Leaf>() {
        using Node = typename Leaf::Node;
        const auto box_in_lanes = spread_sweep<RayLanesOf<Node>>(blob, sweep);
        MovingShape<Mover, Node> shape = {box_in_lanes, sweep, shape_in_lanes, memory, frame, options};
        find_nearest_first_in<Leaf>(blob, shape, answer);
    });
    return best;
}

ESPALIER_QUERY_OF_SET FoundContact first_contact(const BlobData& blob, const CapsuleSweep& sweep,
                                                 const SweepOptions& options) {
    return find_first_contact<CapsuleMover>(blob, sweep, options);
}
ESPALIER_QUERY_OF_SET FoundContact first_contact(const BlobData& blob, const BoxSweep& sweep,
                                                 const SweepOptions& options) {
    return find_first_contact<BoxMover>(blob, sweep, options);
}
ESPALIER_QUERY_OF_SET FoundContact first_contact(const BlobData& blob, const HullSweep& sweep,
                                                 const SweepOptions& options) {
    return find_first_contact<HullMover>(blob, sweep, options);
}

ESPALIER_END_SET

#endif
