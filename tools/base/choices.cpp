#include "choices.hpp"

#include <cctype>
#include <cmath>
#include <cstdlib>

namespace espalier::tools {

namespace {

double parse_part(const std::string& part, std::string_view option, double low, double high, const char* what) {
    const std::optional<double> value = parse_double(part);
    if (!value || !(*value >= low && *value <= high)) {
        throw_error(ExitCode::usage, option, ": '", printable(part), "' is no ", what, " from ", low, " to ", high,
                    ". Write such numbers with commas between.");
    }
    return *value;
}

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
    const auto* const found = std::ranges::find(units, name, &Unit::name);
    return found == std::end(units) ? nullptr : found;
}

constexpr double largest_size = 1e15;

/// Of K, M and G, or nothing for another suffix.
std::optional<double> factor_of(std::string_view suffix) {
    if (suffix.empty() || suffix == "B") return 1.0;
    const std::string_view rest = suffix.substr(1);
    const std::size_t power =
        std::string_view("KMG").find(static_cast<char>(std::toupper(static_cast<unsigned char>(suffix.front()))));
    if (power == std::string_view::npos || (!rest.empty() && rest != "B" && rest != "iB")) return std::nullopt;
    return std::exp2(10.0 * static_cast<double>(power + 1));
}

}  // namespace

std::vector<std::string> split_list(const std::string& input) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    while (true) {
        const std::size_t end = std::min(input.find(',', begin), input.size());
        std::string part = input.substr(begin, end - begin);
        if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(std::move(part));
        if (end == input.size()) return parts;
        begin = end + 1;
    }
}

std::vector<unsigned> parse_whole_numbers(const std::string& input, std::string_view option, unsigned low,
                                          unsigned high) {
    std::vector<unsigned> result;
    for (const std::string& part : split_list(input)) {
        const double value = parse_part(part, option, low, high, "whole number");
        if (value != std::floor(value)) parse_part("fraction " + part, option, low, high, "whole number");
        result.push_back(static_cast<unsigned>(value));
    }
    return result;
}

std::vector<float> parse_numbers(const std::string& input, std::string_view option, float low, float high) {
    std::vector<float> result;
    for (const std::string& part : split_list(input)) {
        result.push_back(static_cast<float>(parse_part(part, option, double(low), double(high), "number")));
    }
    return result;
}

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
        throw_error(ExitCode::usage, option, ": '", printable(input),
                    "' is no length. Write a number with a unit of um, mm, cm, m, km, in or ft, such as "
                    "0.5mm, or a bare number in the asset's own units.");
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
        throw_error(ExitCode::usage, option, ": '", printable(input),
                    "' is no amount of bytes. Write a number above zero, with K, M or G for powers of "
                    "1024, such as 65536, 64K or 1.5M.");
    }
    return static_cast<std::uint64_t>(bytes);
}

}  // namespace espalier::tools
