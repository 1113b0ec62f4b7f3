#include "least_squares.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace espalier::bench {
namespace {

constexpr std::size_t unknowns = 3;
using Rows = std::array<std::array<double, unknowns + 1>, unknowns>;

/// Gaussian elimination with the largest pivot. The rows are scaled to a diagonal of 1 first, so that the smallest
/// pivot says how well the unknowns can be told apart.
std::optional<std::array<double, unknowns>> solve(Rows rows) {
    std::array<double, unknowns> scale;
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
    std::array<double, unknowns> result;
    for (std::size_t i = 0; i < unknowns; ++i) result[i] = scale[i] * rows[i][unknowns] / rows[i][i];
    return result;
}

double value_of(const std::array<double, unknowns>& coefficients, const Observation& observation) {
    double sum = 0.0;
    for (std::size_t i = 0; i < unknowns; ++i) sum += coefficients[i] * observation.terms[i];
    return sum;
}

}  // namespace

std::optional<Fit> fit(std::span<const Observation> observations) {
    Rows rows{};
    double sum = 0.0;
    for (const Observation& observation : observations) {
        for (std::size_t i = 0; i < unknowns; ++i) {
            for (std::size_t j = 0; j < unknowns; ++j) rows[i][j] += observation.terms[i] * observation.terms[j];
            rows[i][unknowns] += observation.terms[i] * observation.value;
        }
        sum += observation.value;
    }
    const auto coefficients = solve(rows);
    if (!coefficients) return std::nullopt;
    const double count = static_cast<double>(observations.size());
    const double mean = sum / count;
    double left = 0.0, all = 0.0;
    for (const Observation& observation : observations) {
        const double difference = observation.value - value_of(*coefficients, observation);
        left += difference * difference;
        all += (observation.value - mean) * (observation.value - mean);
    }
    return Fit{*coefficients, std::sqrt(left / count), mean, all > 0.0 ? 1.0 - left / all : 1.0};
}

}  // namespace espalier::bench
