// Fits a sum of a few terms to measurements.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace espalier::bench {

/// One measurement: how much there was of each term, and what came out. The last term is usually the constant 1.
struct Observation {
    std::array<double, 3> terms;
    double value;
};

struct Fit {
    std::array<double, 3> coefficients;
    double residual;   ///< root of the mean squared difference between fit and value
    double mean;       ///< of the values
    double explained;  ///< share of the values' variance, 0..1 (R squared)
};

/// The least sum of squared differences, by the normal equations (Gauss 1809). Nothing when the observations do not
/// determine all coefficients.
std::optional<Fit> fit(std::span<const Observation> observations);

}  // namespace espalier::bench
