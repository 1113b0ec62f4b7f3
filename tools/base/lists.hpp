// Lists as people write them behind an option: 12,14,16.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "choices.hpp"
#include "exit_code.hpp"
#include "numbers.hpp"

namespace espalier::tools {

/// The parts between commas, each once, in the order in which they come first.
std::vector<std::string> split_list(const std::string& input);

/// Numbers from `low` to `high`. Throws CommandError (usage) that names `option`.
std::vector<unsigned> parse_whole_numbers(const std::string& input, std::string_view option, unsigned low,
                                          unsigned high);
std::vector<float> parse_numbers(const std::string& input, std::string_view option, float low, float high);

/// Names out of `choices`, or "all". Throws CommandError (usage) that names `option`.
template <class Value>
std::vector<Value> parse_names(const std::string& input, std::string_view option, const Choices<Value>& choices) {
    std::vector<Value> result;
    for (const std::string& name : split_list(input)) {
        std::string names = "all";
        bool is_known = false;
        for (const auto& choice : choices) {
            names += ", " + choice.first;
            if (name != choice.first && name != "all") continue;
            result.push_back(choice.second);
            is_known = true;
        }
        if (!is_known) {
            throw CommandError(ExitCode::usage,
                               text(option, ": '", printable(name), "' is none of ", names, ", with commas between."));
        }
    }
    return result;
}

}  // namespace espalier::tools
