#include "model.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace espalier::bench {

namespace {

/// Returns a JSON array of the groups: the counts of each, the measured and the predicted time.
std::string groups_of(const Model& model) {
    std::string text;
    for (std::size_t i = 0; i < model.observations.size(); ++i) {
        const Observation& group = model.observations[i];
        text += text.empty() ? "[" : ",";
        // GCC 12 warns of a sum that begins with a character, without cause.
        for (std::size_t k = 0; k < model.terms.size(); ++k) {
            text += k == 0 ? '[' : ',';
            text += decimal(group.terms[k], 1);
        }
        text += ',';
        text += decimal(group.value, 1);
        text += ',';
        text += decimal(model.held_out.values[i], 1);
        text += ']';
    }
    return text + ']';
}

}  // namespace

Model fit_model(const std::string& subject, std::vector<Term> terms, std::vector<Observation> observations,
                Differences differences) {
    auto fitted = fit(observations, differences);
    auto held_out = predict_held_out(observations, differences);
    if (!fitted || !held_out)
        throw std::runtime_error(subject + ": all calls do the same work, so that nothing can be fitted");
    return {std::move(terms), std::move(observations), std::move(*fitted), std::move(*held_out)};
}

void print_text(const Model& model, const char* call) {
    const std::vector<double>& costs = model.fit.coefficients;
    std::printf("  T =");
    for (std::size_t i = 0; i < model.terms.size(); ++i)
        std::printf("%s %s * %.2f", i == 0 ? "" : " +", model.terms[i].symbol, costs[i]);
    std::printf(
        " %c %.1f ns, residual %.1f of %.1f ns %s, %.1f %% explained; held out %.1f %%, median error %.1f %%, worst "
        "%.0f %%\n",
        costs.back() < 0.0 ? '-' : '+', std::abs(costs.back()), model.fit.residual, model.fit.mean, call,
        100.0 * model.fit.explained, 100.0 * model.held_out.explained, 100.0 * model.held_out.median_error,
        100.0 * model.held_out.worst_error);
}

void print_json(const std::vector<Model>& models, const RowOf& row_of) {
    for (const Model& model : models) {
        const bool is_first = &model == &models.front();
        JsonObject row = row_of(is_first ? "cost" : "cost by other counts");
        JsonObject costs;
        for (std::size_t i = 0; i < model.terms.size(); ++i)
            costs.add(model.terms[i].symbol, model.fit.coefficients[i], 4);
        costs.add("constant", model.fit.coefficients.back(), 4);
        row.add_raw("costs_ns", costs.text());
        row.add("mean_ns", model.fit.mean, 4);
        row.add("residual_ns", model.fit.residual, 4);
        row.add("explained", model.fit.explained, 5);
        row.add("held_out_explained", model.held_out.explained, 5);
        row.add("held_out_median_error", model.held_out.median_error, 5);
        row.add("held_out_worst_error", model.held_out.worst_error, 5);
        row.add("group_count", model.observations.size());
        if (is_first) row.add_raw("groups", groups_of(model));
        row.print();
    }
}

}  // namespace espalier::bench
