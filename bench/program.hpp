// What the programs that measure have in common: options and meshes behind the name, words for people, exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace espalier::bench {

/// Options are added before it runs; the meshes to measure stand behind them.
class Program : public CLI::App {
public:
    Program(const std::string& name, const std::string& description);

    /// A whole number from `low` to `high`; what the variable holds now is the default, and shown as such.
    template <class Number>
    CLI::Option* add_number(const std::string& option, Number& variable, Number low, Number high,
                            const std::string& help) {
        return add_option(option, variable, help)->check(CLI::Range(low, high))->capture_default_str();
    }

    /// How often, or how many: at least one.
    template <class Number>
    CLI::Option* add_count(const std::string& option, Number& variable, const std::string& help) {
        return add_number(option, variable, Number{1}, Number{1'000'000'000}, help);
    }

    /// Calls `measure` with the files. Exit status: 0, 1 where the words are wrong or `measure` throws
    /// std::invalid_argument, 2 for every other exception.
    int run(int count, char** words, const std::function<void(const std::vector<std::string>& meshes)>& measure);

private:
    std::vector<std::string> meshes_;
};

}  // namespace espalier::bench
