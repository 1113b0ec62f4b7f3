// The interface of a system that receives new boxes or places in each step and finds all pairs.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "frames.hpp"

namespace espalier::bench {

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

BroadPhaseMakers espalier_box_makers(const Scenario& scenario);
BroadPhaseMakers espalier_placement_makers(const Scenario& scenario);
/// Makes no pairs: the float loop that makes boxes from placements, for those that take only boxes.
BroadPhaseMakers placement_loop_makers();
BroadPhaseMakers grid_makers();
BroadPhaseMakers sort_and_sweep_makers();
BroadPhaseMakers bullet_box_makers();
BroadPhaseMakers ode_box_makers();
BroadPhaseMakers fcl_box_makers();

}  // namespace espalier::bench
