// Fits a sum of a few terms to measurements.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

/// One measurement: how much there was of each term, and what came out. The last term is usually the constant 1.
struct Observation {
    std::vector<double> terms;
    double value;
};

/// What a fit makes least: squares of differences in units of the values, or relative to each value. Relative ones suit
/// values of different magnitudes, of which else only the largest count.
enum class Differences { absolute, relative };

struct Fit {
    std::vector<double> coefficients;
    double residual;   ///< root of the mean squared difference between fit and value
    double mean;       ///< of the values
    double explained;  ///< share of the values' variance, 0..1 (R squared)
};

/// The least sum of squared differences, by the normal equations (Gauss 1809). All observations have as many terms and
/// positive values. Nothing when the observations do not determine all coefficients.
std::optional<Fit> fit(std::span<const Observation> observations, Differences differences);

/// How well fits to some of the observations predict the others.
struct Prediction {
    std::vector<double> values;  ///< of each observation
    double explained;            ///< share of the values' variance; below 0 where their mean predicts better
    double median_error;         ///< of a predicted value, relative to the measured one
    double worst_error;
};

/// Predicts every second observation by a fit to the others, and these by a fit to the former (cross-validation, Stone
/// 1974). Nothing when one of these fits does not exist.
std::optional<Prediction> predict_held_out(std::span<const Observation> observations, Differences differences);

// Calls sorted into groups of like work, and what a call of each group costs.

/// The numbers of some calls, ascending, so that incoherent ones stay incoherent.
using Members = std::vector<std::uint32_t>;

/// Equal shares of all calls by one count, and each of these in equal shares by another one. Both have an entry for
/// each call.
std::vector<Members> group_by_work(std::span<const std::uint64_t> first, std::span<const std::uint64_t> second);

/// Runs all groups in turn, again and again, and returns the nanoseconds of a call of each, in processor time.
///
/// `calls` has the number of calls of each group, and `run` makes them; what it returns keeps compilers from dropping
/// them. A group's time is the median over the rounds of its ratio to the round's median, times the median of these: a
/// machine that is busy elsewhere for a while slows whole rounds down. With `is_warm` each group runs twice in a turn
/// and the second run is timed, for groups that share what they work on with some of the others.
std::vector<double> time_in_turns(std::span<const std::size_t> calls, unsigned rounds, bool is_warm,
                                  const std::function<unsigned(std::size_t group)>& run);

// Models of time: counts of work, each with a cost that is fitted, and how they are printed.

/// The symbol of a count of work.
using Term = const char*;

/// Costs for some counts and a constant one.
struct Model {
    std::vector<Term> terms;
    std::vector<Observation> observations;  ///< a group of calls each
    Fit fit;                                ///< the constant's coefficient is the last
    Prediction held_out;
};

/// Fits the costs. The observations are nanoseconds and end with the constant 1. Throws std::runtime_error, which
/// begins with `subject`, if the observations do not determine the costs.
Model fit_model(const std::string& subject, std::vector<Term> terms, std::vector<Observation> observations,
                Differences differences);

/// Returns a row that says what was measured: a mesh or scene, and a query.
using RowOf = std::function<JsonObject(const std::string& measures)>;

/// Completes a row for each model and prints it. The first model's has the groups too, each as
/// [counts..., measured, predicted], as which it measures "cost"; the others measure "cost by other counts".
void print_rows(const std::vector<Model>& models, const RowOf& row_of);

// The options of the command line, and the models that it chooses from.

struct CostOptions {
    std::vector<std::string> profiles;  ///< of those of blobs.hpp; none: all
    unsigned rays = 200'000;
    unsigned poses = 2'000;
    unsigned cubes = 10'000;
    unsigned repetitions = 7;
    unsigned bits = 16;
};

/// Fits the cost of a step of a scene of moving cubes, and prints it.
void model_scene(const CostOptions& options);

}  // namespace espalier::bench
