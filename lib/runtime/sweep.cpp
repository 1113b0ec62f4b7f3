// Sweeps in the caller's units: rounded, answered in lattice units, translated back.
#include <bit>

#include <espalier/sweep.hpp>
#include <runtime/lattice_round.hpp>
#include <runtime/scalar_walk.hpp>
#include <runtime/sweep_queries.hpp>

namespace espalier {
namespace detail {
namespace {

namespace scalar_sweep {
using namespace scalar;
#include <runtime/ray_nodes.inl>
#include <runtime/ray_plain_nodes.inl>
#include <runtime/sweep_candidates.inl>
}  // namespace scalar_sweep

/// The triangle that is touched first; of those that are touched in the same tick the lowest index.
template <class Lanes>
struct FirstTouched {
    Lanes lanes_;
    FirstContactOf contact_of;
    const TriangleFilter* filter;
    FoundContact best = {};
    float limit_ = 1.0f;

    [[nodiscard]] float limit() const { return limit_; }
    template <class Node>
    unsigned children(const Node& node, float* keys) const {
        return scalar_sweep::slab_test(node, lanes_, limit_, keys);
    }
    template <class Leaf>
    Visit visit_leaf(const Leaf& leaf) {
        if constexpr (small_code)
            return scalar_walk::for_each_triangle_of(leaf, [&](unsigned slot, const LatticeTriangle& triangle) {
                if (scalar_sweep::may_touch(triangle, lanes_, limit_))
                    decide(triangle, scalar::owner_index(leaf, slot));
                return keep_going;
            });
        else return visit_candidates(leaf);
    }

private:
    template <class Leaf>
    Visit visit_candidates(const Leaf& leaf) {
        auto candidates = scalar_sweep::sweep_candidates(leaf, lanes_, limit_);
        for (; candidates != 0; candidates &= candidates - 1) {
            const auto slot = static_cast<unsigned>(std::countr_zero(candidates));
            decide(leaf.triangle(slot), scalar::owner_index(leaf, slot));
        }
        return keep_going;
    }
    void decide(const LatticeTriangle& triangle, std::uint32_t index) {
        if (best.step == 0 && index >= best.index) return;
        const SweepStep step = contact_of(triangle, best.step < whole_way ? best.step : whole_way);
        if (step == no_contact || (step == best.step && index >= best.index)) return;
        if (filter != nullptr && !(*filter)(Triangle{index})) return;
        best = {step, index, triangle};
        limit_ = share_of_way(step);
    }
};

template <class Sweep>
bool sweep_rounded(const Blob& blob, const Sweep& rounded, SweepHit& hit, const TriangleFilter* filter) {
    const auto contact_of = [&](const LatticeTriangle& triangle, SweepStep most) {
        return first_contact(rounded, triangle, most);
    };
    const FoundContact found = first_contact(blob.data(), rounded, contact_of, filter);
    if (found.step == no_contact) return false;
    hit = to_sweep_hit(blob.data(), rounded, found);
    return true;
}

template <class Sweep, class Shape>
bool sweep_shape(const Blob& blob, const Shape& shape, const Vec3& displacement, SweepHit& hit,
                 const TriangleFilter* filter) {
    Sweep rounded;
    return blob.triangle_count() != 0 && round_sweep(blob.data(), shape, displacement, rounded) == QueryStatus::ok &&
           sweep_rounded(blob, rounded, hit, filter);
}

}  // namespace

FoundContact first_contact(const BlobData& blob, const LatticeSweep& sweep, FirstContactOf contact_of,
                           const TriangleFilter* filter) {
    return scalar_walk::with_leaves_of(blob, [&]<class Leaf>() {
        using Lanes = typename RayLanesFor<typename Leaf::Node>::Type;
        FirstTouched<Lanes> visitor = {spread_sweep<Lanes>(blob, sweep), contact_of, filter};
        scalar_walk::traverse_nearest_first<Leaf>(blob, visitor);
        return visitor.best;
    });
}

}  // namespace detail

using namespace detail;

namespace {

/// The same sweep by less code: a capsule whose axis has no length.
bool sweep_sphere(const Blob& blob, const Sphere& sphere, const Vec3& displacement, SweepHit& hit,
                  const TriangleFilter* filter) {
    if constexpr (small_code)
        return sweep_shape<CapsuleSweep>(blob, Capsule{sphere.center, sphere.center, sphere.radius}, displacement, hit,
                                         filter);
    else return sweep_shape<SphereSweep>(blob, sphere, displacement, hit, filter);
}

}  // namespace

bool sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, SweepHit& hit) noexcept {
    return sweep_sphere(blob, sphere, displacement, hit, nullptr);
}
bool sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, SweepHit& hit, TriangleFilter filter) {
    return sweep_sphere(blob, sphere, displacement, hit, &filter);
}
bool sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, SweepHit& hit) noexcept {
    return sweep_shape<CapsuleSweep>(blob, capsule, displacement, hit, nullptr);
}
bool sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, SweepHit& hit, TriangleFilter filter) {
    return sweep_shape<CapsuleSweep>(blob, capsule, displacement, hit, &filter);
}
bool sweep(const Blob& blob, const Box& box, Vec3 displacement, SweepHit& hit) noexcept {
    return !is_empty(box) && sweep_shape<BoxSweep>(blob, box, displacement, hit, nullptr);
}
bool sweep(const Blob& blob, const Box& box, Vec3 displacement, SweepHit& hit, TriangleFilter filter) {
    return !is_empty(box) && sweep_shape<BoxSweep>(blob, box, displacement, hit, &filter);
}

QueryStatus check_sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement) noexcept {
    if constexpr (small_code) {
        return check_sweep(blob, Capsule{sphere.center, sphere.center, sphere.radius}, displacement);
    } else {
        SphereSweep rounded;
        return round_sweep(blob.data(), sphere, displacement, rounded);
    }
}
QueryStatus check_sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement) noexcept {
    CapsuleSweep rounded;
    return round_sweep(blob.data(), capsule, displacement, rounded);
}
QueryStatus check_sweep(const Blob& blob, const Box& box, Vec3 displacement) noexcept {
    BoxSweep rounded;
    return round_sweep(blob.data(), box, displacement, rounded);
}

}  // namespace espalier
