#include "lengths.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>

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

constexpr double largest_size = 1e15;

std::optional<double> factor_of(std::string_view suffix) {
    if (suffix.empty() || suffix == "B") return 1.0;
    double factor = 0.0;
    switch (std::toupper(static_cast<unsigned char>(suffix.front()))) {
        case 'K':
            factor = 0x1p10;
            break;
        case 'M':
            factor = 0x1p20;
            break;
        case 'G':
            factor = 0x1p30;
            break;
        default:
            return std::nullopt;
    }
    const std::string_view rest = suffix.substr(1);
    if (!rest.empty() && rest != "B" && rest != "iB") return std::nullopt;
    return factor;
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

std::uint64_t parse_byte_size(const std::string& input, std::string_view option) {
    char* end = nullptr;
    const double value = std::strtod(input.c_str(), &end);
    const std::optional<double> factor = factor_of(end);
    const bool is_number = end != input.c_str() && std::isfinite(value) && factor;
    const double bytes = is_number ? std::floor(value * *factor) : 0.0;
    if (!(bytes >= 1.0 && bytes <= largest_size)) {
        throw CommandError(ExitCode::usage,
                           text(option, ": '", printable(input),
                                "' is no amount of bytes. Write a number above zero, with K, M or G for powers of "
                                "1024, such as 65536, 64K or 1.5M."));
    }
    return static_cast<std::uint64_t>(bytes);
}

}  // namespace espalier::tools
