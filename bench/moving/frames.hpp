// The steps of a motion as every system receives them, with the pairs that it has to find.
#pragma once

#include <memory>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/scenes/pairs.hpp>

#include "motion.hpp"

namespace espalier::bench {

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

}  // namespace espalier::bench
