#include "range.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::tools {

bool holds(Range range, std::span<const double> values) {
    const auto all = [values](auto is) { return std::all_of(values.begin(), values.end(), is); };
    const bool are_finite = all([](double value) { return std::isfinite(value); });
    switch (range) {
        case Range::finite:
        case Range::apart:
            return are_finite;
        case Range::number:
            return all([](double value) { return !std::isnan(value); });
        case Range::size:
            return all([](double value) { return value >= 0.0; });
        case Range::finite_size:
            return are_finite && all([](double value) { return value >= 0.0; });
        case Range::direction:
            return are_finite && !all([](double value) { return value == 0.0; });
        case Range::factor:
            return are_finite && all([](double value) { return value > 0.0; });
    }
    return true;
}

const char* describe(Range range) {
    switch (range) {
        case Range::finite:
            return "finite";
        case Range::number:
            return "a number, which may be inf or -inf";
        case Range::size:
            return "0 or more, which may be inf";
        case Range::finite_size:
            return "0 or more, and finite";
        case Range::direction:
            return "finite, and long enough not to round to length zero";
        case Range::apart:
            return "finite, and another point than the one before";
        case Range::factor:
            return "above 0, and finite";
    }
    return "";
}

}  // namespace espalier::tools
