// How much longer than usual the slow questions of a row take.
#pragma once

#include "instance.hpp"
#include "questions.hpp"
#include "ratio.hpp"

namespace espalier::bench {

/// Wall-clock time of single questions, each the least of several passes over all of them.
struct SlowCases {
    double median_seconds = 0.0;
    double percentile_99_seconds = 0.0;
    std::size_t questions = 0;
};

/// Measures at most `count` questions of the set, spread evenly. Nothing where the commit has no such kind of query.
std::optional<SlowCases> slow_cases(const Instance& instance, const QuestionSet& set, std::size_t count);

// Both sides answer the same questions in turns, some tenths of a millisecond each.

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

// What bench/ab prints: a JSON object for each row.

/// What is compared, the same for all rows.
struct Heading {
    std::string base, other;  ///< commits
    std::string base_compiler, other_compiler;
    unsigned bits = 16;
};

/// The rows of one mesh in one profile have this in common.
struct Baking {
    std::string mesh, profile, set;
    std::size_t triangles = 0;
    std::size_t base_bytes = 0, other_bytes = 0;
    bool same_bytes = false;
};

void print_row(const Heading& heading, const Baking& baking, const std::string& questions,
               const std::optional<Comparison>& comparison);

}  // namespace espalier::bench
