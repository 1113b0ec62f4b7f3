#include "model.hpp"

#include <atomic>
#include <ctime>

namespace espalier::bench {
namespace {

constexpr std::size_t shares_by_first = 16;
constexpr std::size_t shares_by_second = 8;

/// The part of a list that belongs to one of several equal shares.
template <class Value>
std::span<Value> share_of(std::span<Value> all, std::size_t number, std::size_t shares) {
    const std::size_t begin = all.size() * number / shares, end = all.size() * (number + 1) / shares;
    return all.subspan(begin, end - begin);
}

}  // namespace

std::vector<Members> group_by_work(std::span<const std::uint64_t> first, std::span<const std::uint64_t> second) {
    Members order(first.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto by = [](std::span<const std::uint64_t> counts) {
        return [counts](std::uint32_t a, std::uint32_t b) { return counts[a] < counts[b]; };
    };
    std::stable_sort(order.begin(), order.end(), by(first));
    std::vector<Members> groups;
    for (std::size_t i = 0; i < shares_by_first; ++i) {
        const auto slice = share_of(std::span(order), i, shares_by_first);
        std::stable_sort(slice.begin(), slice.end(), by(second));
        for (std::size_t j = 0; j < shares_by_second; ++j) {
            const auto members = share_of(slice, j, shares_by_second);
            if (members.empty()) continue;
            std::sort(members.begin(), members.end());
            groups.emplace_back(members.begin(), members.end());
        }
    }
    return groups;
}

std::vector<double> time_in_turns(std::span<const std::size_t> calls, unsigned rounds, bool is_warm,
                                  const std::function<unsigned(std::size_t group)>& run) {
    std::vector<std::vector<double>> ratios(calls.size());
    std::vector<double> medians;
    unsigned found = 0;
    for (unsigned round = 0; round <= rounds; ++round) {
        std::vector<double> times;
        for (std::size_t group = 0; group < calls.size(); ++group) {
            if (is_warm) found += run(group);
            const ProcessorTime time;
            found += run(group);
            times.push_back(1e9 * time.seconds() / static_cast<double>(calls[group]));
        }
        if (round == 0) continue;  // it only warmed the caches
        medians.push_back(median_of(times));
        for (std::size_t i = 0; i < calls.size(); ++i) ratios[i].push_back(times[i] / medians.back());
    }
    static std::atomic<unsigned> sink;  // so that no compiler drops the calls
    sink = found;
    const double typical = median_of(medians);
    std::vector<double> nanoseconds;
    for (const std::vector<double>& of_group : ratios) nanoseconds.push_back(typical * median_of(of_group));
    return nanoseconds;
}

namespace {

/// Returns a JSON array of the groups: the counts of each, the measured and the predicted time.
std::string groups_of(const Model& model) {
    std::vector<std::string> groups;
    for (std::size_t i = 0; i < model.observations.size(); ++i) {
        std::vector<std::string> numbers;
        for (std::size_t k = 0; k < model.terms.size(); ++k)
            numbers.push_back(decimal(model.observations[i].terms[k], 1));
        numbers.push_back(decimal(model.observations[i].value, 1));
        numbers.push_back(decimal(model.held_out.values[i], 1));
        groups.push_back(json_list(numbers));
    }
    return json_list(groups);
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

void print_rows(const std::vector<Model>& models, const RowOf& row_of) {
    for (const Model& model : models) {
        const bool is_first = &model == &models.front();
        JsonObject row = row_of(is_first ? "cost" : "cost by other counts");
        JsonObject costs;
        for (std::size_t i = 0; i < model.terms.size(); ++i) costs.add(model.terms[i], model.fit.coefficients[i], 4);
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
