// Both sides answer the same questions in turns, some tenths of a millisecond each.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "instance.hpp"
#include "questions.hpp"
#include "ratio.hpp"
#include "slow_cases.hpp"

namespace espalier::bench {

struct Turns {
    double seconds = 1.0;             ///< of processor time for each row, about
    double slice_milliseconds = 0.2;  ///< of one turn, about; a turn is at least one question
};

struct Comparison {
    Ratio ratio;
    std::size_t questions = 0;
    std::size_t found = 0;      ///< of the base: answers other than no or nothing
    std::size_t differing = 0;  ///< answers; what depends on the order of stored triangles is left out (side.h)
    std::optional<SlowCases> slow_cases = std::nullopt;  ///< of the other side, where they are measured
};

/// Nothing where a commit has no such kind of query. At least one pair.
std::optional<Comparison> take_turns(std::vector<PairOfInstances>& pairs, const QuestionSet& set, const Turns& turns);

}  // namespace espalier::bench
