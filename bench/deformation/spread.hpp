// The median of a few measurements, with the least and the greatest.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "../json_object.hpp"

namespace espalier::bench {

inline double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Adds a field `name` with the median, and one `name`_spread with the least and the greatest.
inline void add_spread(JsonObject& row, const std::string& name, const std::vector<double>& values, int digits) {
    row.add(name, median_of(values), digits);
    row.add_raw(name + "_spread", '[' + decimal(*std::min_element(values.begin(), values.end()), digits) + ',' +
                                      decimal(*std::max_element(values.begin(), values.end()), digits) + ']');
}

}  // namespace espalier::bench
