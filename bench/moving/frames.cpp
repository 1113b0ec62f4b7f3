#include "../../tests/runtime/moving_scenes/made_scene.hpp"
#include "broad_phase.hpp"

namespace espalier::bench::moving {
namespace {

/// Returns the world's volume for an object: cubes fill 10 % of it, which gives 0.41 pairs an object. Mixed sizes have
/// one pair an object: half of the mean of (a + b)^3 for two edges a and b.
double volume_of_object(Sizes sizes) {
    if (sizes == Sizes::cubes) return 10.0;
    // The moments of 1 + 99 u^10.
    const double first = 1.0 + 99.0 / 11.0;
    const double second = 1.0 + 2.0 * 99.0 / 11.0 + 99.0 * 99.0 / 21.0;
    const double third = 1.0 + 3.0 * 99.0 / 11.0 + 3.0 * 99.0 * 99.0 / 21.0 + 99.0 * 99.0 * 99.0 / 31.0;
    return (2.0 * third + 6.0 * second * first) / 2.0;
}

float length_of(const Quaternion& q) { return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w); }

Quaternion normalized(const Quaternion& q) {
    const float length = length_of(q);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// Moves a coordinate and reflects it at the walls.
void fly(float& at, float& velocity, float low, float high) {
    at += velocity;
    if (at >= low && at <= high) return;
    const float wall = at < low ? low : high;
    at = 2.0f * wall - at;
    velocity = -velocity;
}

}  // namespace

Motion::Motion(const Scenario& scenario)
    : random_(seed), speed_(static_cast<float>(scenario.speed)), turning_(scenario.turning) {
    side_ = static_cast<float>(std::cbrt(static_cast<double>(scenario.objects) * volume_of_object(scenario.sizes)));
    for (std::uint32_t object = 0; object < scenario.objects; ++object) {
        const auto u = static_cast<double>(random_.unit());
        const float edge = scenario.sizes == Sizes::cubes ? 1.0f : static_cast<float>(1.0 + 99.0 * std::pow(u, 10.0));
        const Vec3 from_middle = random_.in_cube(0.5f * (side_ - edge));
        edges_.push_back(edge);
        middles_.push_back({0.5f * side_ + from_middle.x, 0.5f * side_ + from_middle.y, 0.5f * side_ + from_middle.z});
        rotations_.push_back(turning_ ? any_rotation() : Quaternion{});
        if (static_cast<double>(random_.unit()) >= scenario.moving) continue;
        movers_.push_back(object);
        velocities_.push_back(in_ball(speed_ * edge));
        // Up to a tenth of a radian for a speed of 0.1: corners then move as far as the middle.
        const Vec3 spin = in_ball(0.5f * speed_);
        spins_.push_back(normalized({spin.x, spin.y, spin.z, 1.0f}));
    }
}

void Motion::step() {
    const auto movers = static_cast<std::uint32_t>(movers_.size());
    for (std::uint32_t redrawn = (movers + 99) / 100; redrawn > 0; --redrawn) draw_velocity(random_.below(movers));
    for (std::uint32_t i = 0; i < movers; ++i) {
        const std::uint32_t object = movers_[i];
        const float low = 0.5f * edges_[object], high = side_ - low;
        Vec3 &at = middles_[object], &velocity = velocities_[i];
        fly(at.x, velocity.x, low, high);
        fly(at.y, velocity.y, low, high);
        fly(at.z, velocity.z, low, high);
        if (turning_) rotations_[object] = normalized(product(spins_[i], rotations_[object]));
    }
}

void Motion::draw_velocity(std::uint32_t mover) { velocities_[mover] = in_ball(speed_ * edges_[movers_[mover]]); }

Vec3 Motion::in_ball(float radius) {
    for (;;) {
        const Vec3 v = random_.in_cube(1.0f);
        if (v.x * v.x + v.y * v.y + v.z * v.z <= 1.0f) return {v.x * radius, v.y * radius, v.z * radius};
    }
}

Quaternion Motion::any_rotation() {
    for (;;) {
        const Quaternion q = {random_.signed_unit(), random_.signed_unit(), random_.signed_unit(),
                              random_.signed_unit()};
        if (const float length = length_of(q); length <= 1.0f && length > 0.1f) return normalized(q);
    }
}

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

BakeResult baked_cube() { return bake_blob(tests::make_cube(-0.5f, 0.5f)).baked; }

}  // namespace espalier::bench::moving
