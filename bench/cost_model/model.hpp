// Models of time: counts of work, each with a cost that is fitted, and how they are printed.
#pragma once

#include <string>
#include <vector>

#include "least_squares.hpp"

namespace espalier::bench {

/// A count of work.
struct Term {
    const char* symbol;
    const char* name;
};

/// Costs for some counts and a constant one.
struct Model {
    std::vector<Term> terms;
    Fit fit;  ///< the constant's coefficient is the last
    Prediction held_out;
};

/// Fits the costs. The observations are nanoseconds and end with the constant 1. Throws std::runtime_error, which
/// begins with `subject`, if the observations do not determine the costs.
Model fit_model(const std::string& subject, std::vector<Term> terms, const std::vector<Observation>& observations,
                Differences differences);

/// Prints a line. `call` is what takes the time: "a ray".
void print_text(const Model& model, const char* call);
/// Prints the object of a model, of several as an array.
void print_json(const std::vector<Model>& models);

}  // namespace espalier::bench
