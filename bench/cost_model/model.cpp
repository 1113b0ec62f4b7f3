#include "model.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace espalier::bench {

Model fit_model(const std::string& subject, std::vector<Term> terms, const std::vector<Observation>& observations,
                Differences differences) {
    auto fitted = fit(observations, differences);
    const auto held_out = predict_held_out(observations, differences);
    if (!fitted || !held_out)
        throw std::runtime_error(subject + ": all calls do the same work, so that nothing can be fitted");
    return {std::move(terms), std::move(*fitted), *held_out};
}

void print_text(const Model& model, const char* call) {
    const std::vector<double>& costs = model.fit.coefficients;
    std::printf("  T =");
    for (std::size_t i = 0; i < model.terms.size(); ++i)
        std::printf("%s %s * %.2f", i == 0 ? "" : " +", model.terms[i].symbol, costs[i]);
    std::printf(" %c %.1f ns, residual %.1f of %.1f ns %s, %.1f %% explained; held out %.1f %%, median error %.1f %%\n",
                costs.back() < 0.0 ? '-' : '+', std::abs(costs.back()), model.fit.residual, model.fit.mean, call,
                100.0 * model.fit.explained, 100.0 * model.held_out.explained, 100.0 * model.held_out.median_error);
}

void print_json(const std::vector<Model>& models) {
    std::printf("[");
    for (const Model& model : models) {
        std::printf("%s{\"costs_ns\":{", &model == &models.front() ? "" : ",");
        for (std::size_t i = 0; i < model.terms.size(); ++i)
            std::printf("\"%s\":%.4f,", model.terms[i].name, model.fit.coefficients[i]);
        std::printf(
            "\"constant\":%.4f},\"residual_ns\":%.4f,\"explained\":%.5f,\"held_out_explained\":%.5f,"
            "\"held_out_median_error\":%.5f}",
            model.fit.coefficients.back(), model.fit.residual, model.fit.explained, model.held_out.explained,
            model.held_out.median_error);
    }
    std::printf("]");
}

}  // namespace espalier::bench
