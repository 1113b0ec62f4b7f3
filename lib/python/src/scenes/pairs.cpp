// The pairs of instances of a moving scene, with itself or with a baked scene.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "lists.hpp"
#include "scenes/held_moving.hpp"

#include <array>
#include <utility>

#include <pybind11/stl.h>

#include <espalier/scenes/pairs.hpp>

namespace espalier::python {

namespace {

/// A pair as Python gives and gets it: {a, b}, or {moving, index, in_tile}.
template <class Pair>
using Numbers = std::array<std::uint32_t, sizeof(Pair) / sizeof(std::uint32_t)>;

InstancePair pair_of(const Numbers<InstancePair>& numbers) { return {numbers[0], numbers[1]}; }
BakedPair pair_of(const Numbers<BakedPair>& numbers) { return {numbers[0], {numbers[1], numbers[2]}}; }
Numbers<InstancePair> numbers_of(const InstancePair& pair) { return {pair.a, pair.b}; }
Numbers<BakedPair> numbers_of(const BakedPair& pair) { return {pair.moving, pair.baked.index, pair.baked.in_tile}; }

PairFilter filter_of(bool only_moved) {
    PairFilter filter;
    filter.only_moved = only_moved;
    return filter;
}

/// All pairs from one on, and why there are no more.
template <class Pair>
struct Collected {
    Growing<Pair> pairs;
    FilledPairs<Pair> filled;

    /// Calls collect(array), and again with a larger array while that is too small.
    template <class Collect>
    static Collected of(const Collect& collect) {
        Collected all;
        for (std::size_t room = 1024;; room *= 4) {
            all.filled = collect(all.pairs.places(room));
            if (all.filled.status != QueryStatus::output_full) break;
        }
        all.pairs.add(all.filled.count);
        return all;
    }

    /// Returns (pairs, status, where to resume).
    py::tuple to_python(const char* type) {
        return py::make_tuple(pairs.to_numpy(dtype_of(type)), static_cast<int>(filled.status),
                              py::tuple(py::cast(numbers_of(filled.next))));
    }
};

py::tuple candidate_pairs(HeldMovingScene& self, bool only_moved, const Numbers<InstancePair>& from) {
    auto collected = alone(self, [&] {
        return Collected<InstancePair>::of([&](std::span<InstancePair> pairs) {
            return collect_candidate_pairs(self.scene, pairs, filter_of(only_moved), pair_of(from));
        });
    });
    return collected.to_python("instance_pair");
}

py::tuple colliding_pairs(HeldMovingScene& self, bool only_moved, const Numbers<InstancePair>& from,
                          std::uint64_t limit) {
    auto collected = alone(self, [&] {
        return Collected<InstancePair>::of([&](std::span<InstancePair> pairs) {
            return collect_colliding_pairs(self.scene, pairs, WorkLimit(limit), filter_of(only_moved), pair_of(from));
        });
    });
    return collected.to_python("instance_pair");
}

/// Calls collect(array) as Collected::of() does, while no thread changes the scene.
template <class Collect>
py::tuple collect_with_baked(const HeldMovingScene& self, const Collect& collect) {
    auto collected = shared(self, [&] { return Collected<BakedPair>::of(collect); });
    return collected.to_python("baked_pair");
}

py::tuple candidate_pairs_with_baked(const HeldMovingScene& self, const HeldScene& baked, bool only_moved,
                                     const Numbers<BakedPair>& from) {
    return collect_with_baked(self, [&](std::span<BakedPair> pairs) {
        return collect_candidate_pairs(self.scene, baked.scene, pairs, filter_of(only_moved), pair_of(from));
    });
}

py::tuple colliding_pairs_with_baked(const HeldMovingScene& self, const HeldScene& baked, bool only_moved,
                                     const Numbers<BakedPair>& from, std::uint64_t limit) {
    return collect_with_baked(self, [&](std::span<BakedPair> pairs) {
        return collect_colliding_pairs(self.scene, baked.scene, pairs, WorkLimit(limit), filter_of(only_moved),
                                       pair_of(from));
    });
}

}  // namespace

void bind_scene_pairs(py::module_& module) {
    module.def("candidate_pairs", candidate_pairs);
    module.def("colliding_pairs", colliding_pairs);
    module.def("candidate_pairs_with_baked", candidate_pairs_with_baked);
    module.def("colliding_pairs_with_baked", colliding_pairs_with_baked);
}

}  // namespace espalier::python
