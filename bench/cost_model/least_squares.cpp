#include "model.hpp"

namespace espalier::bench {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Gaussian elimination with the largest pivot. The rows are scaled to a diagonal of 1 first, so that the smallest
/// pivot says how well the unknowns can be told apart.
std::optional<std::vector<double>> solve(Rows rows) {
    const std::size_t unknowns = rows.size();
    std::vector<double> scale(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) {
        if (!(rows[i][i] > 0.0)) return std::nullopt;
        scale[i] = 1.0 / std::sqrt(rows[i][i]);
    }
    for (std::size_t i = 0; i < unknowns; ++i) {
        for (std::size_t j = 0; j < unknowns; ++j) rows[i][j] *= scale[i] * scale[j];
        rows[i][unknowns] *= scale[i];
    }
    for (std::size_t column = 0; column < unknowns; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < unknowns; ++row)
            if (std::abs(rows[row][column]) > std::abs(rows[pivot][column])) pivot = row;
        if (std::abs(rows[pivot][column]) < 1e-9) return std::nullopt;
        std::swap(rows[pivot], rows[column]);
        for (std::size_t row = 0; row < unknowns; ++row) {
            if (row == column) continue;
            const double factor = rows[row][column] / rows[column][column];
            for (std::size_t j = column; j <= unknowns; ++j) rows[row][j] -= factor * rows[column][j];
        }
    }
    std::vector<double> result(unknowns);
    for (std::size_t i = 0; i < unknowns; ++i) result[i] = scale[i] * rows[i][unknowns] / rows[i][i];
    return result;
}

double value_of(const std::vector<double>& coefficients, const Observation& observation) {
    double sum = 0.0;
    for (std::size_t i = 0; i < coefficients.size(); ++i) sum += coefficients[i] * observation.terms[i];
    return sum;
}

double mean_of(std::span<const Observation> observations) {
    double sum = 0.0;
    for (const Observation& observation : observations) sum += observation.value;
    return sum / static_cast<double>(observations.size());
}

/// Returns how much of the variance is left between the values and the predicted ones.
double share_left(std::span<const Observation> observations, const std::vector<double>& predicted) {
    const double mean = mean_of(observations);
    double left = 0.0, all = 0.0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
        const double value = observations[i].value;
        left += (value - predicted[i]) * (value - predicted[i]);
        all += (value - mean) * (value - mean);
    }
    return all > 0.0 ? left / all : 0.0;
}

}  // namespace

std::optional<Fit> fit(std::span<const Observation> observations, Differences differences) {
    if (observations.empty()) return std::nullopt;
    const std::size_t unknowns = observations.front().terms.size();
    Rows rows(unknowns, std::vector<double>(unknowns + 1));
    for (const auto& [terms, value] : observations) {
        const double weight = differences == Differences::relative ? 1.0 / (value * value) : 1.0;
        for (std::size_t i = 0; i < unknowns; ++i) {
            for (std::size_t j = 0; j < unknowns; ++j) rows[i][j] += weight * terms[i] * terms[j];
            rows[i][unknowns] += weight * terms[i] * value;
        }
    }
    const auto coefficients = solve(rows);
    if (!coefficients) return std::nullopt;
    std::vector<double> fitted;
    double left = 0.0;
    for (const Observation& observation : observations) {
        fitted.push_back(value_of(*coefficients, observation));
        left += (observation.value - fitted.back()) * (observation.value - fitted.back());
    }
    return Fit{*coefficients, std::sqrt(left / static_cast<double>(observations.size())), mean_of(observations),
               1.0 - share_left(observations, fitted)};
}

std::optional<Prediction> predict_held_out(std::span<const Observation> observations, Differences differences) {
    constexpr std::size_t parts = 2;
    std::vector<double> predicted(observations.size()), errors;
    for (std::size_t part = 0; part < parts; ++part) {
        std::vector<Observation> others;
        for (std::size_t i = 0; i < observations.size(); ++i)
            if (i % parts != part) others.push_back(observations[i]);
        const auto fitted = fit(others, differences);
        if (!fitted) return std::nullopt;
        for (std::size_t i = part; i < observations.size(); i += parts) {
            predicted[i] = value_of(fitted->coefficients, observations[i]);
            errors.push_back(std::abs(predicted[i] / observations[i].value - 1.0));
        }
    }
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    const double worst = *std::max_element(errors.begin(), errors.end());
    const double explained = 1.0 - share_left(observations, predicted);
    return Prediction{std::move(predicted), explained, *middle, worst};
}

}  // namespace espalier::bench
