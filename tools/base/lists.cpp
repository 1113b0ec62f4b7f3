#include "lists.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::tools {

namespace {

double parse_part(const std::string& part, std::string_view option, double low, double high, const char* what) {
    const std::optional<double> value = parse_double(part);
    if (!value || !(*value >= low && *value <= high)) {
        throw CommandError(ExitCode::usage, text(option, ": '", printable(part), "' is no ", what, " from ", low,
                                                 " to ", high, ". Write such numbers with commas between."));
    }
    return *value;
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

}  // namespace espalier::tools
