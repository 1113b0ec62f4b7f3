// What a run simulates and how often it repeats it.
#pragma once

#include <chrono>

#include "../base.hpp"

namespace espalier::bench::moving {

enum class Sizes {
    cubes,  ///< all edges are 1
    mixed,  ///< edges are 1 + 99 u^10 for a uniform u, those of bepuphysics' tests of its trees
};

struct Scenario {
    std::size_t objects = 10'000;
    double speed = 0.02;   ///< an object's largest step in multiples of its edge
    double moving = 1.0;   ///< the share of objects that ever moves
    bool turning = false;  ///< objects also turn
    Sizes sizes = Sizes::cubes;
    std::size_t unmeasured = 200;  ///< steps before those that are measured
    std::size_t steps = 40;
    std::size_t repeats = 5;
    std::vector<std::string> only;  ///< names of systems; all if it is empty

    /// Returns after how many steps a tree is packed anew.
    [[nodiscard]] std::size_t steps_between_repacks() const { return moving < 1.0 ? 32 : 8; }
    [[nodiscard]] bool repacks_in(std::size_t step) const {
        return step % steps_between_repacks() == steps_between_repacks() - 1;
    }
};

// Objects that fly through a cubic world, as in Broadmark (Serpa and Rodrigues 2019).

/// Middles are uniform in the world, velocities in a ball. Each step draws the velocity of one moving object in a
/// hundred anew; walls reflect. The same scenario gives the same motion.
class Motion {
public:
    explicit Motion(const Scenario& scenario);
    void step();

    [[nodiscard]] float side() const { return side_; }  ///< of the world, which begins at the origin
    [[nodiscard]] const std::vector<float>& edges() const { return edges_; }
    /// Returns the numbers of the objects that move, in ascending order.
    [[nodiscard]] const std::vector<std::uint32_t>& movers() const { return movers_; }
    /// Returns the place of a cube of edge 1 around the origin.
    [[nodiscard]] Transform place(std::uint32_t object) const {
        return {rotations_[object], middles_[object], edges_[object]};
    }

private:
    void draw_velocity(std::uint32_t mover);
    Vec3 in_ball(float radius);
    Quaternion any_rotation();

    tests::Random random_;
    float speed_;
    float side_ = 0.0f;
    bool turning_;
    std::vector<float> edges_;
    std::vector<std::uint32_t> movers_;
    std::vector<Vec3> middles_;
    std::vector<Quaternion> rotations_;
    std::vector<Vec3> velocities_;   ///< of the movers
    std::vector<Quaternion> spins_;  ///< of the movers, a step's rotation
};

// The steps of a motion as every system receives them, with the pairs that it has to find.

/// Pairs as a number that no order of them changes.
struct PairSum {
    std::size_t count = 0;
    std::uint64_t sum = 0;
    void add(const InstancePair& pair);
    friend bool operator==(const PairSum&, const PairSum&) = default;
};
PairSum sum_of(std::span<const InstancePair> pairs);

/// One step.
struct Frame {
    std::size_t number = 0;
    std::vector<Movement> movements;  ///< of the objects that move, in ascending order of slots
    std::vector<Box> boxes;           ///< of all objects, by slot
    std::vector<InstancePair> pairs;  ///< all, in ascending order
    PairSum all, of_movers;
};

/// What a system begins with.
struct Start {
    const Scenario& scenario;
    const Motion& motion;
    std::span<const Blob> meshes;
    std::span<const Instance> instances;  ///< by slot
    std::span<const Box> boxes;           ///< by slot
    int step_exponent;
    std::size_t most_pairs;  ///< room for so many
};

/// Moves a scene of its own, outside of any measurement. The boxes are those of that scene: whole steps of the world,
/// below 2^24, so that float and integer boxes are the same and systems must find the same pairs.
class Frames {
public:
    /// All objects are of one mesh, whose box is that of a cube of edge 1 around the origin, or less.
    Frames(const Scenario& scenario, const BakeResult& mesh);
    ~Frames();
    [[nodiscard]] Start start() const;
    /// Finds the pairs of triangles that touch in place of those of boxes.
    void find_colliding() { colliding_ = true; }
    void next(Frame& frame);

private:
    struct State;
    std::unique_ptr<State> state_;
    bool colliding_ = false;
};

BakeResult baked_cube();

// The interface of a system that receives new boxes or places in each step and finds all pairs.

enum class Part { update, refit, repack, pairs };
inline constexpr std::size_t part_count = 4;

/// The seconds of the parts of a step, which follow one another.
class Parts {
public:
    void begin() {
        seconds = {};
        last_ = Clock::now();
    }
    /// Adds the time since the last call.
    void end(Part part) {
        const Clock::time_point now = Clock::now();
        seconds[static_cast<std::size_t>(part)] += std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }
    std::array<double, part_count> seconds{};

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_;
};

/// A flat array of the pairs that a system found.
class PairList {
public:
    explicit PairList(std::size_t room) : pairs_(room) {}
    void clear() { count_ = 0; }
    void add(std::uint32_t a, std::uint32_t b) {
        if (count_ < pairs_.size()) pairs_[count_] = {a, b};
        ++count_;
    }
    [[nodiscard]] std::span<InstancePair> room() { return pairs_; }
    void set_count(std::size_t count) { count_ = count; }
    [[nodiscard]] bool is_overflowing() const { return count_ > pairs_.size(); }
    [[nodiscard]] std::span<const InstancePair> found() const { return std::span(pairs_).first(count_); }

private:
    std::vector<InstancePair> pairs_;
    std::size_t count_ = 0;
};

/// Which pairs a system finds.
enum class Finds {
    all,
    of_movers,  ///< those of which one object moves
    none,       ///< it only makes boxes
};

class BroadPhase {
public:
    virtual ~BroadPhase() = default;
    /// Takes the new places and finds the pairs, in any order; each pair once, its slots in any order.
    virtual void step(const Frame& frame, Parts& parts, PairList& pairs) = 0;
};

struct BroadPhaseMaker {
    std::string name;
    std::string from;  ///< what it receives: boxes or placements
    Finds finds = Finds::all;
    std::function<std::unique_ptr<BroadPhase>(const Start&)> make;
    bool by_default = true;   ///< false: only if its whole name is given
    bool has_history = true;  ///< false: a step costs the same whatever came before
};
using BroadPhaseMakers = std::vector<BroadPhaseMaker>;

/// Returns a maker of a system whose constructor takes a Start and further arguments.
template <class System, class... Arguments>
BroadPhaseMaker maker_of(const std::string& name, const std::string& from, Arguments... arguments) {
    return {name, from, Finds::all, [arguments...](const Start& start) -> std::unique_ptr<BroadPhase> {
                return std::make_unique<System>(start, arguments...);
            }};
}

/// Returns Espalier's: of the pairs of movers and of all pairs, or of all where everything moves.
template <class System, class... Arguments>
BroadPhaseMakers espalier_makers_of(const Scenario& scenario, const std::string& from, Arguments... arguments) {
    if (scenario.moving >= 1.0) return {maker_of<System>("espalier", from, false, arguments...)};
    BroadPhaseMakers makers = {maker_of<System>("espalier", from, true, arguments...),
                               maker_of<System>("espalier, all pairs", from, false, arguments...)};
    makers[0].finds = Finds::of_movers;
    return makers;
}

BroadPhaseMakers espalier_box_makers(const Scenario& scenario);
BroadPhaseMakers espalier_placement_makers(const Scenario& scenario);
/// Makes no pairs: the float loop that makes boxes from placements, for those that take only boxes.
BroadPhaseMakers placement_loop_makers();
BroadPhaseMakers grid_makers();
BroadPhaseMakers sort_and_sweep_makers();
BroadPhaseMakers bullet_box_makers();
BroadPhaseMakers ode_box_makers();
BroadPhaseMakers fcl_box_makers();
BroadPhaseMakers espalier_colliding_makers();
BroadPhaseMakers fcl_colliding_makers(const Mesh& mesh);

}  // namespace espalier::bench::moving
