#include "frames.hpp"

#include <cmath>
#include <stdexcept>

#include "../../tests/runtime/moving_scenes/made_scene.hpp"
#include "../../tests/support/meshes/makers.hpp"

namespace espalier::bench {
namespace {

constexpr std::size_t most_pairs_of_object = 16;

void check(QueryStatus status) {
    if (status != QueryStatus::ok) throw std::runtime_error(describe(status));
}

/// Returns the smallest step with which no coordinate has more than 2^23 of them.
int finest_step_exponent(const Motion& motion) {
    int exponent = 0;
    std::frexp(2.0f * motion.side(), &exponent);
    return exponent - 23;
}

}  // namespace

void PairSum::add(const InstancePair& pair) {
    std::uint64_t z = (std::uint64_t{pair.a} << 32 | pair.b) * 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    sum += z ^ (z >> 31);
    ++count;
}

PairSum sum_of(std::span<const InstancePair> pairs) {
    PairSum sum;
    for (const InstancePair& pair : pairs) sum.add(pair.a < pair.b ? pair : InstancePair{pair.b, pair.a});
    return sum;
}

struct Frames::State {
    State(const Scenario& the_scenario, const BakeResult& mesh)
        : scenario(the_scenario),
          motion(the_scenario),
          blob{open(mesh.bytes)},
          made(static_cast<std::uint32_t>(the_scenario.objects), finest_step_exponent(motion), blob),
          moves(the_scenario.objects, false),
          pairs(most_pairs_of_object * the_scenario.objects) {
        if (!blob[0]) throw std::runtime_error(describe(blob[0].status()));
        for (std::uint32_t i = 0; i < scenario.objects; ++i) {
            instances.push_back({motion.place(i)});
            const Result<InstanceHandle> handle = insert(made.scene, instances.back());
            check(handle.status);
            handles.push_back(handle.value);
        }
        for (const std::uint32_t mover : motion.movers()) moves[mover] = true;
        read_boxes(boxes);
    }
    void read_boxes(std::vector<Box>& into) const {
        into.clear();
        for (const InstanceHandle& handle : handles) into.push_back(box_of(made.scene, handle).value);
    }

    const Scenario& scenario;
    Motion motion;
    Blob blob[1];
    tests::MadeScene made;
    std::vector<Instance> instances;
    std::vector<InstanceHandle> handles;
    std::vector<bool> moves;
    std::vector<Box> boxes;
    std::vector<InstancePair> pairs;
    std::size_t number = 0;
};

Frames::Frames(const Scenario& scenario, const BakeResult& mesh) : state_(std::make_unique<State>(scenario, mesh)) {}
Frames::~Frames() = default;

Start Frames::start() const {
    const State& s = *state_;
    return {s.scenario, s.motion, s.blob, s.instances, s.boxes, s.made.scene.step_exponent(), s.pairs.size()};
}

void Frames::next(Frame& frame) {
    State& s = *state_;
    s.motion.step();
    frame.number = s.number++;
    frame.movements.clear();
    for (const std::uint32_t mover : s.motion.movers())
        frame.movements.push_back({s.handles[mover], s.motion.place(mover)});
    check(move(s.made.scene, frame.movements).status);
    if (s.scenario.repacks_in(frame.number)) repack(s.made.scene);
    else refit(s.made.scene);
    s.read_boxes(frame.boxes);
    const FilledPairs<InstancePair> found = colliding_
                                                ? collect_colliding_pairs(s.made.scene, s.pairs, WorkLimit::unlimited())
                                                : collect_candidate_pairs(s.made.scene, s.pairs);
    check(found.status);
    frame.pairs.assign(s.pairs.begin(), s.pairs.begin() + static_cast<std::ptrdiff_t>(found.count));
    frame.all = frame.of_movers = {};
    for (const InstancePair& pair : frame.pairs) {
        frame.all.add(pair);
        if (s.moves[pair.a] || s.moves[pair.b]) frame.of_movers.add(pair);
    }
}

BakeResult baked_cube() {
    const tests::Mesh cube = tests::make_cube(-0.5f, 0.5f);
    BakeResult baked = bake(std::array{cube.view()}, {});
    if (!baked) throw std::runtime_error(baked.message);
    return baked;
}

}  // namespace espalier::bench
