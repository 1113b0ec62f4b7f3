// Models of time: counts of work, each with a cost that is fitted, and how they are printed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../json_object.hpp"
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

/// Prints a line. `call` is what takes the time: "a ray".
void print_text(const Model& model, const char* call);
/// Completes a row for each model and prints it. The first model's has the groups too, each as
/// [counts..., measured, predicted], as which it measures "cost"; the others measure "cost by other counts".
void print_json(const std::vector<Model>& models, const RowOf& row_of);

}  // namespace espalier::bench
