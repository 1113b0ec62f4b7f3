// Fits a sum of a few terms to measurements.
#pragma once

#include <optional>
#include <span>
#include <vector>

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

}  // namespace espalier::bench
