// Verbs and their options, as the files of this folder declare them. Only verb.cpp and usage_error.cpp include CLI11,
// which reads the words: it takes seconds to compile.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/choices.hpp"
#include "base/exit_code.hpp"

namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI

namespace espalier::tools {

/// An option of a verb, or words that stand without a name.
class Option {
public:
    explicit Option(CLI::Option* option) : option_(option) {}
    Option required();
    /// Help shows the value that the target has now.
    Option with_default();
    /// How many values it takes.
    Option expected(int count);
    Option expected(int least, int most);
    Option excludes(Option other);
    Option needs(Option other);
    /// Refuses what is no number from `least` to `most`.
    template <class Number>
    Option between(Number least, Number most);
    /// Takes the sign off "10%".
    Option percentage();
    /// Takes some of these names, with commas between.
    Option names_of(std::vector<std::string> names);

private:
    CLI::Option* option_;
};

using Run = std::function<ExitCode()>;

/// A verb of the command, or a kind of query.
class Verb {
public:
    Verb(CLI::App* app, Run* chosen) : app_(app), chosen_(chosen) {}

    /// The types of targets are listed in verb.cpp. Help shows `type` in place of the value.
    template <class Target>
    Option option(const std::string& name, Target& target, const std::string& type, const std::string& description);
    Option flag(const std::string& name, bool& target, const std::string& description);
    /// An option that takes one of a few names; help shows them in the order of the list.
    template <class Target, class Value>
    void choice(const std::string& name, Target& target, const Choices<Value>& choices,
                const std::string& description) {
        std::vector<std::string> names;
        for (const auto& choice : choices) names.push_back(choice.first);
        const auto choose = [&target, choices](std::size_t number) { target = choices[number].second; };
        choice_of(name, std::move(names), choose, description);
    }
    /// The end of the help, before the exit codes.
    void footer(const std::string& words);
    /// What the verb does when it is chosen.
    void runs(Run run);

    /// A verb below this one, which then needs one. Help lists it in the group, unless that is empty.
    Verb below(const std::string& name, const std::string& description, const std::string& group = {});

private:
    void choice_of(const std::string& name, std::vector<std::string> names, std::function<void(std::size_t)> choose,
                   const std::string& description);

    CLI::App* app_;
    Run* chosen_;
};

/// The command with its verbs.
class CommandLine {
public:
    CommandLine(const std::string& description, const std::string& version, const std::string& footer);
    ~CommandLine();
    Verb& top() { return top_; }
    /// Returns what the chosen verb does. Throws CommandError (usage) where the words cannot be parsed.
    Run parse(std::vector<std::string> words);

private:
    std::unique_ptr<CLI::App> app_;
    Run chosen_;
    Verb top_;
};

/// Returns the error of ExitCode::usage for a command line that `app` could not parse.
CommandError usage_error(const CLI::App& app, const CLI::ParseError& error);

}  // namespace espalier::tools
