// What the programs that measure have in common: options and meshes behind the name, words for people, exit status.
#pragma once

#include "base.hpp"

namespace CLI {
class App;
}

namespace espalier::bench {

/// The command line of a program that measures: options first, then the meshes. It keeps CLI11, which takes long to
/// compile, out of the files that measure. The defaults of options are the values of their variables.
class Program {
public:
    Program(const std::string& name, const std::string& description);
    ~Program();

    /// Lets the program run without meshes.
    void allow_no_meshes();

    /// Adds a number from `low` to `high`: unsigned, std::size_t or double.
    template <class Number>
    void add_number(const std::string& option, Number& variable, Number low, Number high, const std::string& help);

    /// Adds a number of things or of repetitions: at least one.
    template <class Number>
    void add_count(const std::string& option, Number& variable, const std::string& help) {
        add_number(option, variable, Number{1}, Number{1'000'000'000}, help);
    }

    /// Adds an option without a value.
    void add_flag(const std::string& option, bool& variable, const std::string& help);

    /// Adds a word, one of `allowed` if there are some.
    void add_word(const std::string& option, std::string& variable, const std::string& help,
                  const std::vector<std::string>& allowed = {});

    /// The same; the option may be repeated.
    void add_words(const std::string& option, std::vector<std::string>& variable, const std::string& help,
                   const std::vector<std::string>& allowed = {});

    /// Returns what reads the command line, for options of other kinds.
    CLI::App& command_line() { return *command_line_; }

    /// Calls `measure` with each mesh; without one, with a torus. The rows of a mesh are written before the next
    /// begins.
    int run_on_meshes(int count, char** words, const std::function<void(Mesh mesh)>& measure) {
        allow_no_meshes();
        return run(count, words, [&](const std::vector<std::string>& meshes) {
            const auto measure_all_of = [&](Mesh mesh) {
                measure(std::move(mesh));
                std::fflush(stdout);
            };
            for (const std::string& file : meshes) measure_all_of(tests::read_mesh(file));
            if (meshes.empty()) measure_all_of(tests::make_torus(60, 30, 2.0, 0.5));
        });
    }

    /// Calls `measure` with each mesh at the common size.
    int run_at_common_size(int count, char** words, const std::function<void(const Mesh& mesh)>& measure) {
        return run(count, words, [&](const std::vector<std::string>& meshes) {
            for (const std::string& file : meshes) {
                Mesh mesh = tests::read_mesh(file);
                bring_to_common_size(mesh);
                measure(mesh);
                std::fflush(stdout);
            }
        });
    }

    /// Calls `measure` with the files. Exit status: 0, 1 where the words are wrong or `measure` throws
    /// std::invalid_argument, 2 for every other exception.
    int run(int count, char** words, const std::function<void(const std::vector<std::string>& meshes)>& measure);

private:
    std::unique_ptr<CLI::App> command_line_;
    std::vector<std::string> meshes_;
};

/// Returns the words of choices (tools/base/choices.hpp).
template <class Choices>
std::vector<std::string> names_of(const Choices& choices) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    return names;
}

/// A word of a program that measures several subjects: what follows it on the command line is its own. Each adds itself
/// to the program that it is linked into.
class Subcommand {
public:
    Subcommand(std::string_view name, int (*run)(int count, char** words));
    /// Runs the one that the first word names. Returns 1 where there is none.
    static int run_named(int count, char** words);
};

}  // namespace espalier::bench
