#include "verb.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include <CLI/CLI.hpp>

#include <import/base/numbers.hpp>

#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

/// Makes all options of the verb and of those below it refuse an empty value, which a script with an unset variable
/// passes.
void refuse_empty_values(CLI::App& verb) {
    const CLI::Validator not_empty(
        [](std::string& value) { return std::string(value.empty() ? "the value is empty" : ""); }, "");
    for (CLI::Option* option : verb.get_options())
        if (!option->get_positional() && option->get_items_expected_min() > 0) option->check(not_empty);
    for (CLI::App* below : verb.get_subcommands([](CLI::App*) { return true; })) refuse_empty_values(*below);
}

/// Returns "bake --help" for "help bake".
std::vector<std::string> with_help_as_option(std::vector<std::string> words) {
    if (words.empty() || words.front() != "help") return words;
    words.erase(words.begin());
    if (words.size() > 1 && words.front() == "query") words.insert(words.begin() + 1, "BLOB");
    words.emplace_back("--help");
    return words;
}

/// CLI11 takes -1 for a number, but -.5, -inf and -2mm for options. With a space before it none of them looks like one,
/// and number parsers skip the space.
std::vector<std::string> with_negative_numbers_marked(std::vector<std::string> words) {
    for (std::string& word : words) {
        const bool is_negative = word.size() > 1 && word[0] == '-' &&
                                 (word[1] == '.' || (word[1] >= '0' && word[1] <= '9') || parse_double(word));  // -inf
        if (is_negative) word.insert(0, 1, ' ');
    }
    return words;
}

/// Returns a word as it was typed, without that mark.
std::string without_mark(const std::string& word) { return word.starts_with(" -") ? word.substr(1) : word; }

}  // namespace

Option Option::required() { return Option(option_->required()); }
Option Option::with_default() { return Option(option_->capture_default_str()); }
Option Option::expected(int count) { return Option(option_->expected(count)); }
Option Option::expected(int least, int most) { return Option(option_->expected(least, most)); }
Option Option::excludes(Option other) { return Option(option_->excludes(other.option_)); }
Option Option::needs(Option other) { return Option(option_->needs(other.option_)); }

template <class Number>
Option Option::between(Number least, Number most) {
    const char* what = std::is_integral_v<Number> ? "whole number" : "number";
    const auto check = [least, most, what](const std::string& value) {
        Number number{};
        const bool is_between =
            CLI::detail::lexical_cast(value, number) && number >= least && number <= most;  // no NaN
        return is_between ? std::string()
                          : text("'", without_mark(value), "' is no ", what, " from ", least, " to ", most);
    };
    return Option(option_->check(CLI::Validator(check, "")));
}
template Option Option::between(unsigned, unsigned);
template Option Option::between(float, float);
template Option Option::between(double, double);

Option Option::percentage() {
    const auto without_sign = [](std::string& value) {
        if (value.size() > 1 && value.back() == '%') value.pop_back();
        return std::string();
    };
    return Option(option_->transform(CLI::Validator(without_sign, "")));
}

Option Option::names_of(std::vector<std::string> names) {
    const auto check = [names = std::move(names)](const std::string& value) {
        const bool is_name = std::find(names.begin(), names.end(), value) != names.end();
        return is_name ? std::string() : text("'", value, "' is none of ", listed(names, "|"));
    };
    return Option(option_->delimiter(',')->check(CLI::Validator(check, ""))->allow_extra_args(false));
}

template <class Target>
Option Verb::option(const std::string& name, Target& target, const std::string& type, const std::string& description) {
    return Option(app_->add_option(name, target, description)->type_name(type));
}
template Option Verb::option(const std::string&, std::string&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::vector<std::string>&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::optional<std::string>&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::uint32_t&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::optional<std::uint32_t>&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::uint64_t&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, double&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::optional<double>&, const std::string&, const std::string&);
template Option Verb::option(const std::string&, std::optional<float>&, const std::string&, const std::string&);

Option Verb::flag(const std::string& name, bool& target, const std::string& description) {
    return Option(app_->add_flag(name, target, description));
}

void Verb::choice_of(const std::string& name, std::vector<std::string> names, std::function<void(std::size_t)> choose,
                     const std::string& description) {
    const std::string list = listed(names, "|");
    const auto choose_name = [name, names = std::move(names), list,
                              choose = std::move(choose)](const std::string& value) {
        const auto found = std::find(names.begin(), names.end(), value);
        if (found == names.end()) throw CLI::ValidationError(name, "'" + value + "' is none of " + list);
        choose(static_cast<std::size_t>(found - names.begin()));
    };
    app_->add_option_function<std::string>(name, choose_name, description)->type_name(list);
}

void Verb::footer(const std::string& words) { app_->footer(words + exit_code_help); }

void Verb::runs(Run run) {
    app_->callback([chosen = chosen_, run = std::move(run)] { *chosen = run; });
}

Verb Verb::below(const std::string& name, const std::string& description, const std::string& group) {
    app_->require_subcommand(1);
    CLI::App* verb = app_->add_subcommand(name, description)->footer(exit_code_help);
    if (!group.empty()) verb->group(group);
    return {verb, chosen_};
}

CommandLine::CommandLine(const std::string& description, const std::string& version, const std::string& footer)
    : app_(std::make_unique<CLI::App>(description, "espalier")), top_(app_.get(), &chosen_) {
    app_->allow_windows_style_options(false);  // on no system is /folder/mesh.obj an option
    app_->set_version_flag("--version", version);
    top_.footer(footer);
}

CommandLine::~CommandLine() = default;

Run CommandLine::parse(std::vector<std::string> words) {
    refuse_empty_values(*app_);
    words = with_negative_numbers_marked(with_help_as_option(std::move(words)));
    std::reverse(words.begin(), words.end());  // CLI11 takes them last first
    try {
        app_->parse(std::move(words));
    } catch (const CLI::Success& success) {  // --help and --version
        app_->exit(success);
        finish_standard_output();
        return [] { return ExitCode::ok; };
    } catch (const CLI::ParseError& error) {
        throw usage_error(*app_, error);
    }
    return chosen_;
}

}  // namespace espalier::tools
