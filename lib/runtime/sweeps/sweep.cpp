// Sweeps in the caller's units: rounded, answered in lattice units, translated back.
#include <bit>
#include <type_traits>

#include <espalier/sweep.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/sweeps/candidates.hpp>
#include <runtime/sweeps/queries.hpp>
#include <runtime/traversal/scalar_walk.hpp>

namespace espalier {
namespace detail {
namespace {

namespace scalar_sweep {
using namespace scalar;
#include <runtime/rays/slab_test.inl>
#include <runtime/rays/plain_slab_test.inl>
}  // namespace scalar_sweep

/// A shape on its way, by the box around it and a function.
template <class Lanes>
struct MovingShape {
    Lanes lanes_;
    FirstContactOf contact_of;

    template <class Node>
    unsigned cull(const Node& node, float limit, float* keys) const {
        return scalar_sweep::slab_test(node, lanes_, limit, keys);
    }
    template <class Leaf>
    Visit scan(const Leaf& leaf, Closest<FoundContact>& answer) const {
        auto candidates = sweep_candidates(leaf, lanes_, answer.limit);
        for (; candidates != 0; candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            offer(leaf, slot, leaf.triangle(slot), answer);
        }
        return Visit::next;
    }
    template <class Leaf>
    Visit decide(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle,
                 Closest<FoundContact>& answer) const {
        return may_touch(triangle, lanes_, answer.limit) ? offer(leaf, slot, triangle, answer) : Visit::next;
    }

private:
    template <class Leaf>
    Visit offer(const Leaf& leaf, unsigned slot, const LatticeTriangle& triangle, Closest<FoundContact>& answer) const {
        const std::uint32_t index = scalar::owner_index(leaf, slot);
        if (answer.rules_out(0.0f, index)) return Visit::next;
        const SweepStep step = contact_of(triangle, answer.found() ? answer.best.step : whole_way);
        return step == no_contact ? Visit::next : answer.take({{index}, step, triangle});
    }
};

}  // namespace

FoundContact first_contact(const BlobData& blob, const LatticeSweep& sweep, FirstContactOf contact_of,
                           const TriangleFilter* filter) {
    FoundContact best;
    Closest<FoundContact> answer(best, filter);
    answer.limit = 1.0f;
    scalar_walk::with_leaves_of(blob, [&]<class Leaf>() {
        using Lanes = typename RayLanesFor<typename Leaf::Node>::Type;
        MovingShape<Lanes> shape = {spread_sweep<Lanes>(blob, sweep), contact_of};
        scalar_walk::find_nearest_first_in<Leaf>(blob, shape, answer);
    });
    return best;
}

}  // namespace detail

using namespace detail;

namespace {

template <class Sweep, class Shape>
SweepHit sweep_shape(const Blob& blob, const Shape& shape, const Vec3& displacement, const TriangleFilter& filter) {
    SweepHit hit;
    if (!blob) return hit;
    Sweep rounded;
    hit.status = round_sweep(data_of(blob), shape, displacement, rounded);
    if (hit.status != QueryStatus::ok) return hit;
    hit.t = 1.0f;
    hit.status = QueryStatus::not_found;
    if constexpr (std::is_same_v<Shape, Box>)
        if (is_empty(shape)) return hit;
    if (blob.triangle_count() == 0) return hit;
    const auto contact_of = [&](const LatticeTriangle& triangle, SweepStep most) {
        return first_contact(rounded, triangle, most);
    };
    const FoundContact found = first_contact(data_of(blob), rounded, contact_of, filter ? &filter : nullptr);
    if (found.step != no_contact) hit = to_sweep_hit(data_of(blob), rounded, found);
    return hit;
}

}  // namespace

SweepHit sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, TriangleFilter filter) noexcept {
    return sweep_shape<CapsuleSweep>(blob, sphere, displacement, filter);
}
SweepHit sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, TriangleFilter filter) noexcept {
    return sweep_shape<CapsuleSweep>(blob, capsule, displacement, filter);
}
SweepHit sweep(const Blob& blob, const Box& box, Vec3 displacement, TriangleFilter filter) noexcept {
    return sweep_shape<BoxSweep>(blob, box, displacement, filter);
}

}  // namespace espalier
