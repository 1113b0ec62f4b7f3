// From many short measurements to one ratio with its spread.
#pragma once

#include <array>
#include <vector>

namespace espalier::bench {

/// Seconds that both sides took for the same questions at about the same time.
struct PairOfTimes {
    double base = 0.0;
    double other = 0.0;
};

/// The other side's time by the base's: below 1 the other is faster.
struct Ratio {
    double median = 1.0;  ///< of all pairs of loads
    double low = 1.0;     ///< the smallest and the largest of a pair of loads
    double high = 1.0;
    double base_seconds = 0.0;  ///< the base's time for all questions once
};

/// Of one pair of loads, `times[placement][part]`: the measurements of one part of the questions, at least one each.
using TimesOfLoad = std::array<std::vector<std::vector<PairOfTimes>>, 2>;

/// Each part counts by the median of its ratios, so that what disturbs fewer than half of its measurements has no
/// effect, and as much as it takes time. Of the two placements it takes the geometric mean, so that a place that is
/// slower than the other has no effect either.
Ratio ratio_of(const std::vector<TimesOfLoad>& times);

/// The middle value, or the mean of the two in the middle; of at least one value.
double median(std::vector<double> values);

}  // namespace espalier::bench
