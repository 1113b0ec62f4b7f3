#include "point.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include <baker/policy.hpp>

#include "bake/baking.hpp"
#include "base/choices.hpp"
#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t counted_rays = 20'000;
/// The others hardly ever count best (docs/log/builders.md). Neither repeats triangles: what is picked answers
/// every query.
constexpr std::array<Builder, 2> builders = {Builder::binned_sah, Builder::sweep_sah};
/// A higher price of a byte gives a smaller blob and more visits.
constexpr float high_byte_price = 16.0f;
constexpr std::array<float, 3> byte_price_factors = {1.0f, 0.2f, 0.0f};
/// Bytes are planned by estimates, so that another configuration may turn out a little smaller than the smallest one.
constexpr double near_miss = 1.1;

unsigned largest_leaf(const PickGoal& goal, Profile profile) {
    return std::min(goal.leaf_size.value_or(format::max_leaf_triangles), most_leaf_triangles(profile));
}

/// The smallest blob that is tried: the last profile of the list is the most compact one.
TradePoint smallest_configuration(const PickGoal& goal, float byte_price) {
    const Profile profile = goal.profile.value_or(profile_choices.back().second);
    return {.profile = profile,
            .builder = goal.builder.value_or(builders.front()),
            .leaf_size = largest_leaf(goal, profile),
            .byte_price = high_byte_price * byte_price};
}

std::vector<TradePoint> other_configurations(const PickGoal& goal, float byte_price) {
    std::vector<TradePoint> result;
    const auto add_sizes = [&](Profile profile, Builder builder) {
        const unsigned most = largest_leaf(goal, profile);
        for (const unsigned size : {most, most / 2}) {
            if (goal.leaf_size && size != most) continue;
            for (const float factor : byte_price_factors)
                result.push_back({profile, builder, 0, size, factor * byte_price});
        }
    };
    for (const auto& choice : profile_choices) {
        if (goal.profile && *goal.profile != choice.second) continue;
        for (const Builder builder : builders) {
            if (goal.builder && builder != builders.front()) continue;
            // If the user chose both, the bake reports why they exclude each other.
            if (!goal.profile && !go_together(choice.second, goal.builder.value_or(builder))) continue;
            add_sizes(choice.second, goal.builder.value_or(builder));
        }
    }
    return result;
}

/// The search. TradePoints are tried in a fixed order, and of equally good ones the first is taken.
class Search {
public:
    Search(const ImportResult& imported, const BakeOptions& options, const PickGoal& goal)
        : imported_(imported),
          options_(with_origin(imported, options)),
          rays_(make_sample_queries(imported, *options_.origin, counted_rays).rays),
          goal_(goal) {}

    Picked run() {
        do {
            try_one(smallest_configuration(goal_, options_.build.byte_price));
            if (!loss_.empty()) break;
            if (some_fit_ || nearly_fits(tried_.back()) || !goal_.may_coarsen) {
                for (const TradePoint& other : other_configurations(goal_, options_.build.byte_price)) try_one(other);
            }
        } while (!some_fit_ && goal_.may_coarsen && coarsen());
        if (!some_fit_) refuse();
        const TradePoint chosen = best();
        return {bake_or_throw(imported_, options_for(chosen)), chosen, std::move(tried_)};
    }

private:
    /// Coarser lattices keep the origin of the first one, so that the rays are the same.
    static BakeOptions with_origin(const ImportResult& imported, BakeOptions options) {
        options.origin = origin_of(imported, options);
        return options;
    }

    /// Takes one bit off the lattice, which is chosen by bits. Returns whether there was one to take.
    bool coarsen() {
        const auto bits = static_cast<unsigned>(options_.resolution.value());
        if (bits <= 1) return false;
        options_.resolution = Resolution::bits(bits - 1);
        return true;
    }

    [[nodiscard]] BakeOptions options_for(const TradePoint& configuration) const {
        BakeOptions options = configuration.applied_to(options_);
        if (options_.progress) {
            options.progress = [this](const char* stage, double done) {
                options_.progress(text("bake ", tried_.size() + 1, ", ", stage).c_str(), done);
            };
        }
        return options;
    }

    void try_one(const TradePoint& configuration) {
        const BakeResult baked = bake_trial_or_throw(imported_, options_for(configuration));
        const BakeReport& report = baked.report;
        // A lattice so coarse that no triangle is left fits everywhere and answers nothing.
        if (report.findings.collapsed.count > 0 && !tried_.empty()) {
            if (report.tree.triangles == 0) {
                loss_ = "leaves no triangle";
                return;
            }
            if (baker::lost_triangles(report).are_more_than(goal_.max_dropped)) {
                loss_ = "drops more triangles than --max-dropped allows";
                return;
            }
        }
        tried_.push_back(configuration);
        tried_.back().bits = report.lattice.bits;
        tried_.back().take(report, count_work(opened(baked), rays_));
        some_fit_ = some_fit_ || fits(tried_.back());
    }

    [[nodiscard]] bool fits(const TradePoint& candidate) const {
        return !goal_.max_bytes || candidate.bytes <= *goal_.max_bytes;
    }

    [[nodiscard]] bool nearly_fits(const TradePoint& candidate) const {
        return !goal_.max_bytes || double(candidate.bytes) <= near_miss * double(*goal_.max_bytes);
    }

    /// The least work; of equal ones the fewest bytes.
    [[nodiscard]] const TradePoint& best() const {
        const TradePoint* best = nullptr;
        for (const TradePoint& candidate : tried_) {
            if (!fits(candidate)) continue;
            const auto order = [](const TradePoint& c) { return std::tuple(c.cost, c.bytes); };
            if (best == nullptr || order(candidate) < order(*best)) best = &candidate;
        }
        return *best;
    }

    [[noreturn]] void refuse() const {
        const auto has_fewer_bytes = [](const TradePoint& a, const TradePoint& b) { return a.bytes < b.bytes; };
        const TradePoint& smallest = *std::min_element(tried_.begin(), tried_.end(), has_fewer_bytes);
        throw_error(
            ExitCode::unsupported, goal_.limit_name, ": nothing fits. The smallest of ", counted(tried_.size(), "bake"),
            " has ", counted(smallest.bytes, "byte"), ", with ", describe(smallest), ", max error ",
            rounded(smallest.max_error),
            !loss_.empty() ? text(". A coarser lattice ", loss_, ": allow more bytes, or bake a simpler mesh.")
            : goal_.may_coarsen
                ? std::string(". There is no coarser lattice: allow more bytes, or bake a simpler mesh.")
                : std::string(". Allow more bytes, a larger error or fewer bits, or bake a simpler mesh; --max-bytes "
                              "without --tolerance, --step and --lattice-of gives up bits until it fits."));
    }

    const ImportResult& imported_;
    BakeOptions options_;
    std::vector<Ray> rays_;
    const PickGoal& goal_;
    std::vector<TradePoint> tried_;
    bool some_fit_ = false;
    std::string loss_;  // what a lattice coarser than the tried ones does
};

/// "12 % more"; the divisor may be 0 for a mesh without triangles.
std::string more_than(double value, double least) {
    return text(rounded(least > 0.0 ? 100.0 * (value / least - 1.0) : 0.0, 3), " % more");
}

/// Of the candidates on the chosen lattice the one with the least of something.
template <class Measure>
const TradePoint& least(const Picked& picked, const Measure& measure) {
    const TradePoint* best = &picked.chosen;
    for (const TradePoint& candidate : picked.tried) {
        if (candidate.bits == picked.chosen.bits && measure(candidate) < measure(*best)) best = &candidate;
    }
    return *best;
}

const TradePoint& fastest(const Picked& picked) {
    return least(picked, [](const TradePoint& candidate) { return candidate.cost; });
}
const TradePoint& smallest(const Picked& picked) {
    return least(picked, [](const TradePoint& candidate) { return candidate.bytes; });
}

Json candidate_json(const TradePoint& candidate) {
    return {{"profile", name_in(profile_choices, candidate.profile)},
            {"builder", name_in(builder_choices, candidate.builder)},
            {"leaf_size", candidate.leaf_size},
            {"byte_price", json_number(candidate.byte_price)},
            {"bits", candidate.bits},
            {"bytes", candidate.bytes},
            {"max_error", candidate.max_error},
            {"counted_cost", candidate.cost},
            {"nodes_per_ray", candidate.work.nodes},
            {"leaves_per_ray", candidate.work.leaves},
            {"triangles_per_ray", candidate.work.triangles}};
}

}  // namespace

std::string describe(const TradePoint& candidate) {
    return text("profile ", name_in(profile_choices, candidate.profile), ", builder ",
                name_in(builder_choices, candidate.builder), ", leaves of up to ",
                counted(candidate.leaf_size, "triangle"), ", byte price ", candidate.byte_price, ", ",
                counted(candidate.bits, "bit"));
}

Picked pick(const ImportResult& imported, const BakeOptions& options, const PickGoal& goal) {
    return Search(imported, options, goal).run();
}

void say_pick(const Console& console, const Picked& picked, const BakeOptions& options) {
    const TradePoint& chosen = picked.chosen;
    const TradePoint& first = picked.tried.front();
    console.say("picked: ", describe(chosen), ", out of ", counted(picked.tried.size(), "bake"));
    if (options.resolution.kind() == Resolution::Kind::tolerance) {
        console.say("  error: ", rounded(chosen.max_error), " of ", rounded(options.resolution.value()), " allowed");
    } else if (first.bits != chosen.bits) {
        console.say("  error: ", rounded(chosen.max_error), "; given up: ", rounded(first.max_error), " at ",
                    counted(first.bits, "bit"), ", which takes ", counted(first.bytes, "byte"));
    } else {
        console.say("  error: ", rounded(chosen.max_error), ", nothing given up");
    }
    const TradePoint& small = smallest(picked);
    console.say("  bytes: ", chosen.bytes,
                small.bytes == chosen.bytes ? std::string(", the fewest at this lattice")
                                            : text(", ", more_than(double(chosen.bytes), double(small.bytes)), " than ",
                                                   small.bytes, " with ", describe(small)));
    const TradePoint& fast = fastest(picked);
    console.say("  counted work: ", rounded(chosen.cost, 4), " visits a ray",
                fast.cost == chosen.cost
                    ? std::string(", the least at this lattice")
                    : text(", ", more_than(chosen.cost, fast.cost), "; given up: ", rounded(fast.cost, 4), " with ",
                           describe(fast), ", which takes ", counted(fast.bytes, "byte")));
}

Json pick_json(const Picked& picked) {
    Json tried = Json::array();
    for (const TradePoint& candidate : picked.tried) tried.push_back(candidate_json(candidate));
    return {{"chosen", candidate_json(picked.chosen)},
            {"fastest", candidate_json(fastest(picked))},
            {"smallest", candidate_json(smallest(picked))},
            {"tried", std::move(tried)}};
}

}  // namespace espalier::tools
