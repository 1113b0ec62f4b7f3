#include "point.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <numeric>
#include <utility>

#include <espalier/distance.hpp>

#include "bake/baking.hpp"
#include "bake/policy.hpp"
#include "base/choices.hpp"
#include "base/exit_code.hpp"

namespace espalier::tools {

namespace {

constexpr std::size_t slice_size = 5'000;  ///< questions that a blob answers in its turn

using Done = std::function<void(const char* stage, double done)>;

double mean_error(const Blob& blob, std::span<const Vec3> surface_points) {
    double sum = 0.0;
    for (const Vec3& point : surface_points) {
        const ClosestPoint nearest = closest_point(blob, point);
        if (nearest) sum += static_cast<double>(nearest.distance);
    }
    return sum / static_cast<double>(surface_points.size());
}

/// A blob under measurement. The bytes stay where they are while it is moved.
struct Contestant {
    BakeResult baked;
    Blob blob;
};

/// Returns the number of queries that found something, so that the compiler can drop none.
std::size_t run_queries(const Blob& blob, const SampleQueries& queries, std::size_t query, std::size_t first,
                        std::size_t count) {
    const auto count_found = [&](const auto& questions, const auto& finds) {
        const auto part = std::span(questions).subspan(first, count);
        return static_cast<std::size_t>(std::count_if(part.begin(), part.end(), finds));
    };
    if (query == 0) return count_found(queries.rays, [&](const Ray& ray) { return bool(raycast(blob, ray)); });
    if (query == 1) return count_found(queries.rays, [&](const Ray& ray) { return occluded(blob, ray).yes(); });
    return count_found(queries.spheres, [&](const Sphere& sphere) { return overlaps(blob, sphere).yes(); });
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The times of one query: of every round, and in it of every contestant.
using Rounds = std::vector<std::vector<double>>;

/// One time for each contestant: the median over the rounds of its ratio to the round's mean, times the median of these
/// means. Rounds are short, so that a machine that is busy elsewhere for a while slows whole rounds down, and a ratio
/// keeps out of that.
std::vector<double> typical_times(const Rounds& rounds) {
    std::vector<double> means;
    for (const std::vector<double>& round : rounds) {
        means.push_back(std::accumulate(round.begin(), round.end(), 0.0) / static_cast<double>(round.size()));
    }
    std::vector<double> result;
    for (std::size_t contestant = 0; contestant < rounds.front().size(); ++contestant) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < rounds.size(); ++i) ratios.push_back(rounds[i][contestant] / means[i]);
        result.push_back(median(means) * median(std::move(ratios)));
    }
    return result;
}

/// Returns the sizes of leaves that were chosen, each limited to what the profile can hold, each once.
std::vector<unsigned> leaf_sizes_of(Profile profile, const std::vector<unsigned>& chosen) {
    std::vector<unsigned> sizes;
    for (const unsigned size : chosen) {
        const unsigned held = std::min(size, most_leaf_triangles(profile));
        if (std::find(sizes.begin(), sizes.end(), held) == sizes.end()) sizes.push_back(held);
    }
    return sizes;
}

/// Returns whether any profile goes with any builder. If none does, the baker reports why.
bool some_go_together(const TradeSpace& space) {
    return std::any_of(space.profiles.begin(), space.profiles.end(), [&](Profile profile) {
        return std::any_of(space.builders.begin(), space.builders.end(),
                           [&](Builder builder) { return go_together(profile, builder); });
    });
}

std::vector<TradePoint> combinations(const TradeSpace& space) {
    const bool may_skip = some_go_together(space);
    std::vector<TradePoint> points;
    TradePoint point;
    for (const Profile profile : space.profiles) {
        point.profile = profile;
        for (const Builder builder : space.builders) {
            if (may_skip && !go_together(profile, builder)) continue;
            point.builder = builder;
            for (const unsigned bits : space.bits) {
                point.bits = bits;
                for (const unsigned leaf_size : leaf_sizes_of(profile, space.leaf_sizes)) {
                    point.leaf_size = leaf_size;
                    for (const float byte_price : space.byte_prices) {
                        point.byte_price = byte_price;
                        points.push_back(point);
                    }
                }
            }
        }
    }
    return points;
}

Contestant bake_point(const ImportResult& imported, BakeOptions options, const SampleQueries& queries,
                      TradePoint& point) {
    options.resolution = Resolution::bits(point.bits);
    Contestant contestant{bake_or_throw(imported, point.applied_to(options)), {}};
    contestant.blob = opened(contestant.baked);
    point.take(contestant.baked.report, count_work(contestant.blob, queries.rays));
    point.mean_error = mean_error(contestant.blob, queries.surface_points);
    return contestant;
}

/// Some of the questions.
struct Slice {
    std::size_t first;
    std::size_t count;
};

/// Nanoseconds of one question of the slice. Other questions come first, as many, so that the blob is in the caches as
/// far as they hold it, and not the answers in the branch predictor.
double time_slice(const Blob& blob, const SampleQueries& queries, std::size_t query, Slice others, Slice slice,
                  std::size_t& found) {
    found += run_queries(blob, queries, query, others.first, others.count);
    const auto start = std::chrono::steady_clock::now();
    found += run_queries(blob, queries, query, slice.first, slice.count);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / static_cast<double>(slice.count);
}

std::array<Rounds, std::size(timed_queries)> time_all(const std::vector<Contestant>& contestants,
                                                      const SampleQueries& queries, unsigned repetitions,
                                                      const Done& done) {
    const std::size_t questions = queries.rays.size();
    const std::size_t slices = (questions + slice_size - 1) / slice_size;
    const auto slice = [&](std::size_t number) {
        const std::size_t first = questions * (number % slices) / slices;
        return Slice{first, questions * (number % slices + 1) / slices - first};
    };
    std::array<Rounds, std::size(timed_queries)> rounds;
    std::size_t found = 0;
    for (std::size_t turn = 0; turn < repetitions * slices; ++turn) {
        for (std::size_t query = 0; query < std::size(timed_queries); ++query) {
            std::vector<double>& round = rounds[query].emplace_back();
            for (const Contestant& contestant : contestants) {
                round.push_back(time_slice(contestant.blob, queries, query, slice(turn + 1), slice(turn), found));
            }
        }
        done("measure", (static_cast<double>(turn) + 1.0) / static_cast<double>(repetitions * slices));
    }
    static std::atomic<std::size_t> sink;
    sink = found;
    return rounds;
}

}  // namespace

std::vector<TradePoint> measure_trade(const ImportResult& imported, const BakeOptions& common, const TradeSpace& space,
                                      const Done& done) {
    BakeOptions options = common;
    options.resolution = Resolution::bits(*std::max_element(space.bits.begin(), space.bits.end()));
    options.origin = origin_of(imported, options);  // of the finest one, for all
    const SampleQueries queries = make_sample_queries(imported, *options.origin, space.rays);
    if (queries.rays.empty()) {
        throw CommandError(
            ExitCode::invalid_input,
            text(names_of_inputs(imported), ": there is no triangle with an area, and nothing to measure."),
            {.file = only_input(imported), .kind = "empty"});
    }
    std::vector<TradePoint> points = combinations(space);
    std::vector<Contestant> contestants;
    for (TradePoint& point : points) {
        contestants.push_back(bake_point(imported, options, queries, point));
        done("bake", static_cast<double>(contestants.size()) / static_cast<double>(points.size()));
    }
    const auto rounds = time_all(contestants, queries, space.repetitions, done);
    for (std::size_t query = 0; query < std::size(timed_queries); ++query) {
        const std::vector<double> times = typical_times(rounds[query]);
        for (std::size_t i = 0; i < points.size(); ++i) points[i].*timed_queries[query].nanoseconds = times[i];
    }
    return points;
}

}  // namespace espalier::tools
