#include "turns.hpp"

#include "../selected.hpp"

namespace espalier::bench::moving {
namespace {

constexpr std::size_t turn_length = 10;

/// Returns how many pairs only one of the two lists has.
std::size_t count_differing(std::span<const InstancePair> found, std::span<const InstancePair> expected) {
    std::vector<InstancePair> sorted, differing;
    for (const InstancePair& pair : found) sorted.push_back(pair.a < pair.b ? pair : InstancePair{pair.b, pair.a});
    std::sort(sorted.begin(), sorted.end());
    std::set_symmetric_difference(sorted.begin(), sorted.end(), expected.begin(), expected.end(),
                                  std::back_inserter(differing));
    return differing.size();
}

/// Returns the pairs of which one object moves.
std::vector<InstancePair> of_movers(const Frame& frame) {
    const auto moves = [&](std::uint32_t slot) {
        const auto below = [](const Movement& movement, std::uint32_t number) {
            return movement.instance.slot < number;
        };
        const auto at = std::lower_bound(frame.movements.begin(), frame.movements.end(), slot, below);
        return at != frame.movements.end() && at->instance.slot == slot;
    };
    std::vector<InstancePair> pairs;
    for (const InstancePair& pair : frame.pairs)
        if (moves(pair.a) || moves(pair.b)) pairs.push_back(pair);
    return pairs;
}

class Runner {
public:
    Runner(const BroadPhaseMakers& makers, const Scenario& scenario) : makers_(makers), scenario_(scenario), pairs_(0) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        for (const BroadPhaseMaker& maker : makers) {
            measured.push_back({maker.name, maker.from, maker.finds, Steps(scenario.steps, infinity), {}, 0, 0, 0});
            for (Steps& part : measured.back().parts) part.assign(scenario.steps, infinity);
        }
    }
    void run(Frames& frames, std::size_t repeat) {
        const Start start = frames.start();
        pairs_ = PairList(start.most_pairs);
        systems_.clear();
        for (const BroadPhaseMaker& maker : makers_) systems_.push_back(maker.make(start));
        const std::size_t end = scenario_.unmeasured + scenario_.steps;
        std::size_t length = turn_length + 3 * repeat % turn_length;
        for (std::size_t at = 0, turn = 0; at < end; ++turn) {
            length = std::min(length, end - at);
            turn_.resize(length);
            for (Frame& frame : turn_) frames.next(frame);
            const bool is_measured = at + length > scenario_.unmeasured;
            for (std::size_t i = 0; i < systems_.size(); ++i) {
                const std::size_t system = (i + turn + repeat) % systems_.size();
                if (is_measured || makers_[system].has_history) take_turn(system, repeat == 0);
            }
            at += length;
            length = turn_length;
        }
    }

    std::vector<Measured> measured;

private:
    void take_turn(std::size_t system, bool compares) {
        forget_branches();
        Measured& row = measured[system];
        for (const Frame& frame : turn_) {
            pairs_.clear();
            Parts parts;
            const double begin = thread_seconds();
            systems_[system]->step(frame, parts, pairs_);
            const double seconds = thread_seconds() - begin;
            if (pairs_.is_overflowing()) throw std::runtime_error(row.name + ": more pairs than there is room for");
            row.pairs = pairs_.found().size();
            if (compares) compare(row, frame);
            if (frame.number < scenario_.unmeasured) continue;
            const std::size_t step = frame.number - scenario_.unmeasured;
            row.steps[step] = std::min(row.steps[step], seconds);
            for (std::size_t i = 0; i < part_count; ++i)
                row.parts[i][step] = std::min(row.parts[i][step], parts.seconds[i]);
        }
    }
    void compare(Measured& row, const Frame& frame) {
        if (row.finds == Finds::none) return;
        const bool of_all = row.finds == Finds::all;
        if (sum_of(pairs_.found()) == (of_all ? frame.all : frame.of_movers)) return;
        ++row.differing_steps;
        row.differing_pairs += count_differing(pairs_.found(), of_all ? frame.pairs : of_movers(frame));
    }

    /// Sorts random numbers, so that the processor predicts no branches from a system of the same code before.
    void forget_branches() {
        std::vector<std::uint64_t> numbers(1 << 14);
        for (std::uint64_t& number : numbers) number = random_.next();
        std::sort(numbers.begin(), numbers.end());
    }

    tests::Random random_{seed};
    const BroadPhaseMakers& makers_;
    const Scenario& scenario_;
    PairList pairs_;
    std::vector<std::unique_ptr<BroadPhase>> systems_;
    std::vector<Frame> turn_;
};

}  // namespace

double mean_of(const Steps& steps) {
    return std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
}
double slowest_of(const Steps& steps) { return *std::max_element(steps.begin(), steps.end()); }

std::vector<Measured> measure(const BroadPhaseMakers& makers, const Scenario& scenario, const BakeResult& mesh,
                              bool colliding) {
    Runner runner(makers, scenario);
    for (std::size_t repeat = 0; repeat < scenario.repeats; ++repeat) {
        Frames frames(scenario, mesh);
        if (colliding) frames.find_colliding();
        runner.run(frames, repeat);
    }
    return runner.measured;
}

BroadPhaseMakers selected(BroadPhaseMakers makers, const Scenario& scenario) {
    const auto is_named = [](const BroadPhaseMaker& maker, const std::string& name) {
        return maker.name == name || (maker.by_default && maker.name.starts_with(name));
    };
    if (scenario.only.empty()) std::erase_if(makers, [](const BroadPhaseMaker& maker) { return !maker.by_default; });
    select(
        makers, scenario.only, is_named,
        [](const BroadPhaseMaker& maker) { return maker.name.starts_with("espalier") || maker.finds == Finds::none; },
        [](const BroadPhaseMaker& maker) { return maker.name; });
    return makers;
}

}  // namespace espalier::bench::moving
