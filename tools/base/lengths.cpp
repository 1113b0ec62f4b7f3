#include "lengths.hpp"

#include <cmath>
#include <cstdlib>

#include "exit_code.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

// Ratios of integers, so that 0.5mm is the double nearest to 0.0005 and not a product of two rounded factors.
struct Unit {
    std::string_view name;
    double numerator;
    double denominator;
};

constexpr Unit units[] = {
    {"m", 1, 1}, {"km", 1000, 1}, {"cm", 1, 100}, {"mm", 1, 1000}, {"um", 1, 1e6}, {"in", 254, 1e4}, {"ft", 3048, 1e4},
};

const Unit* find_unit(std::string_view name) {
    for (const Unit& unit : units) {
        if (unit.name == name) return &unit;
    }
    return nullptr;
}

}  // namespace

std::optional<double> metres_in(std::string_view unit_name) {
    const Unit* unit = find_unit(unit_name);
    if (unit == nullptr) return std::nullopt;
    return unit->numerator / unit->denominator;
}

double parse_length(const std::string& input, std::string_view option) {
    char* end = nullptr;
    const double value = std::strtod(input.c_str(), &end);
    const std::string_view suffix(end);
    const Unit* unit = find_unit(suffix);
    if (end == input.c_str() || !std::isfinite(value) || (unit == nullptr && !suffix.empty())) {
        throw CommandError(ExitCode::usage,
                           text(option, ": '", printable(input),
                                "' is no length. Write a number with a unit of um, mm, cm, m, km, in or ft, such as "
                                "0.5mm, or a bare number in the asset's own units."));
    }
    return unit == nullptr ? value : value * unit->numerator / unit->denominator;
}

}  // namespace espalier::tools
