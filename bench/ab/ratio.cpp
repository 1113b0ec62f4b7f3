#include "ratio.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::bench {

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Ratio ratio_of(const std::vector<TimesOfLoad>& times) {
    Ratio result;
    // What a part takes, over all loads: its weight is the same for each of them.
    std::vector<double> weights;
    double sum_of_weights = 0.0;
    for (std::size_t part = 0; part < times.front()[0].size(); ++part) {
        std::vector<double> of_base, of_both;
        for (const TimesOfLoad& load : times)
            for (const auto& placement : load)
                for (const PairOfTimes& pair : placement[part]) {
                    of_base.push_back(pair.base);
                    of_both.push_back(pair.base + pair.other);
                }
        result.base_seconds += median(of_base);
        weights.push_back(median(of_both));
        sum_of_weights += weights.back();
    }
    // In logarithms, so that noise does not favour a side: the mean of x / y is above 1 where both only scatter
    // about 1.
    std::vector<double> of_loads;
    for (const TimesOfLoad& load : times) {
        double sum = 0.0;
        for (const auto& placement : load)
            for (std::size_t part = 0; part < weights.size(); ++part) {
                std::vector<double> logarithms;
                for (const PairOfTimes& pair : placement[part]) logarithms.push_back(std::log(pair.other / pair.base));
                sum += weights[part] * median(logarithms);
            }
        of_loads.push_back(std::exp(0.5 * sum / sum_of_weights));
    }
    result.median = median(of_loads);
    result.low = *std::min_element(of_loads.begin(), of_loads.end());
    result.high = *std::max_element(of_loads.begin(), of_loads.end());
    return result;
}

}  // namespace espalier::bench
