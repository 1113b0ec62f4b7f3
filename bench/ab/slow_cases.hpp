// How much longer than usual the slow questions of a row take.
#pragma once

#include <cstddef>
#include <optional>

#include "instance.hpp"
#include "questions.hpp"

namespace espalier::bench {

/// Wall-clock time of single questions, each the least of several passes over all of them.
struct SlowCases {
    double median_seconds = 0.0;
    double percentile_99_seconds = 0.0;
    std::size_t questions = 0;
};

/// Measures at most `count` questions of the set, spread evenly. Nothing where the commit has no such kind of query.
std::optional<SlowCases> slow_cases(const Instance& instance, const QuestionSet& set, std::size_t count);

}  // namespace espalier::bench
