// What a moving scene must hold after the calls so far: a map of instances, and what follows from the contracts.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include <espalier/scenes/moving_scene.hpp>

namespace espalier::fuzz {

/// What becomes of a place that insert() or move() is given.
enum class Fate { invalid, outside, inside, near_the_border };

/// Returns the fate of a mesh or tile that can be placed. The border of the world is that of its box, which only the
/// library computes.
Fate fate_of(std::uint32_t mesh, const Transform& transform, int step_exponent);

class Model {
public:
    /// Nothing is inserted yet.
    explicit Model(std::uint32_t capacity) : capacity_(capacity), knows_past_(true) {}
    /// What a scene returns of itself, which comes from elsewhere.
    explicit Model(const MovingScene& scene);

    [[nodiscard]] const std::map<std::uint32_t, Instance>& live() const { return live_; }
    [[nodiscard]] const std::vector<InstanceHandle>& stale() const { return stale_; }
    [[nodiscard]] InstanceHandle handle_of(std::uint32_t slot) const { return {slot, generations_.at(slot)}; }
    [[nodiscard]] bool is_live(InstanceHandle handle) const {
        return live_.contains(handle.slot) && generations_.at(handle.slot) == handle.generation;
    }
    [[nodiscard]] bool must_refit() const { return must_refit_; }
    /// Returns whether an instance has been moved or inserted in this step, or `unknown` if that is not known: slots
    /// that come from elsewhere may have moved in steps that are yet to come.
    [[nodiscard]] bool has_moved(std::uint32_t slot, bool unknown) const {
        return moved_.contains(slot) || (!knows_moved_ && unknown);
    }

    /// Checks a status of insert() of an instance, and takes it in.
    void inserted(const Instance& instance, int step_exponent, const Result<InstanceHandle>& result);
    void removed(InstanceHandle handle);
    void moved(InstanceHandle handle, const Transform& transform, bool by_batch);
    void set_mask(InstanceHandle handle, std::uint32_t mask) { live_.at(handle.slot).mask = mask; }
    void set_user(InstanceHandle handle, std::uint32_t user) { live_.at(handle.slot).user = user; }
    void refitted() { must_refit_ = false; }
    void step_ended() { moved_.clear(); }

    /// Checks every fact that the scene returns of itself.
    void check(const MovingScene& scene) const;

private:
    [[nodiscard]] bool has_room() const { return live_.size() < capacity_; }

    std::uint32_t capacity_;
    /// Whether the model knows which slots are free, in their order: a scene from elsewhere may have worn ones.
    bool knows_past_;
    bool knows_moved_ = true;
    bool must_refit_ = false;
    std::uint32_t slot_end_ = 0;
    std::map<std::uint32_t, Instance> live_;
    std::map<std::uint32_t, std::uint32_t> generations_;
    std::vector<std::uint32_t> free_;
    std::vector<InstanceHandle> stale_;
    std::set<std::uint32_t> moved_;
};

/// Checks the status of a call that places an instance; `otherwise` is what it returns for a place in the world.
void check_status(Fate fate, QueryStatus status, QueryStatus otherwise);

/// Checks that the box of an instance in the tree holds its mesh or tile.
void check_box(const MovingScene& scene, InstanceHandle handle);

}  // namespace espalier::fuzz
