// What the command lines of several verbs have in common.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/choices.hpp"
#include "base/exit_code.hpp"
#include "base/numbers.hpp"
#include "base/verb_arguments.hpp"

namespace espalier::tools {

/// The verb that was chosen, ready to run.
using Chosen = std::function<ExitCode()>;

inline const Choices<Axis> axes{{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};

/// An option that takes one of a few names; the help shows them in the order of the list.
template <class Target, class Value>
CLI::Option* add_choice(CLI::App* verb, const std::string& option, Target& target, const Choices<Value>& choices,
                        const std::string& description) {
    std::string names;
    for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.first;
    const auto choose = [&target, choices, option, names](const std::string& name) {
        for (const auto& choice : choices) {
            if (choice.first != name) continue;
            target = choice.second;
            return;
        }
        throw CLI::ValidationError(option, "'" + name + "' is none of " + names);
    };
    return verb->add_option_function<std::string>(option, choose, description)->type_name(names);
}

/// Takes the sign off "10%".
inline CLI::Validator percentage() {
    return CLI::Validator(
        [](std::string& value) {
            if (value.size() > 1 && value.back() == '%') value.pop_back();
            return std::string();
        },
        "");
}

/// Refuses what is none of the names.
inline CLI::Validator one_of(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : "|") + name;
    const auto check = [names, list](const std::string& value) {
        const bool is_name = std::find(names.begin(), names.end(), value) != names.end();
        return is_name ? std::string() : text("'", value, "' is none of ", list);
    };
    return CLI::Validator(check, "");
}

template <class Number>
CLI::Validator between(Number least, Number most) {
    const char* what = std::is_integral_v<Number> ? "whole number" : "number";
    const auto check = [least, most, what](const std::string& value) {
        Number number{};
        const bool is_between =
            CLI::detail::lexical_cast(value, number) && number >= least && number <= most;  // no NaN
        return is_between ? std::string() : text("'", value, "' is no ", what, " from ", least, " to ", most);
    };
    return CLI::Validator(check, "");
}

/// Makes all options of the verb and of those below it refuse an empty value, which a script with an unset variable
/// passes.
void refuse_empty_values(CLI::App& verb);

/// A verb whose help ends with the exit codes.
CLI::App* add_verb(CLI::App& app, const std::string& name, const std::string& description);
/// The blob or the scene that a verb reads.
void add_blob(CLI::App* verb, std::string& blob);
void add_json(CLI::App* verb, bool& json);
void add_quiet(CLI::App* verb, bool& quiet);
void add_source(CLI::App* verb, SourceArguments& source);

// The verbs with the most options, each in <verb>_arguments.cpp; the others are in main.cpp.
void add_bake(CLI::App& app, Chosen& chosen);
void add_query(CLI::App& app, Chosen& chosen);
void add_trade(CLI::App& app, Chosen& chosen);

}  // namespace espalier::tools
