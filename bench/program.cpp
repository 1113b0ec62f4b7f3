#include "program.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <map>

#include "support/machine/chosen_instruction_set.hpp"

namespace espalier::bench {

Program::Program(const std::string& name, const std::string& description)
    : command_line_(std::make_unique<CLI::App>(description, name)) {
    command_line_->add_option("meshes", meshes_, "What to measure")->required()->type_name("MESH.obj|MESH.ply");
}

Program::~Program() = default;

void Program::allow_no_meshes() { command_line_->get_option("meshes")->required(false); }

template <class Number>
void Program::add_number(const std::string& option, Number& variable, Number low, Number high,
                         const std::string& help) {
    command_line_->add_option(option, variable, help)->check(CLI::Range(low, high))->capture_default_str();
}

template void Program::add_number(const std::string&, unsigned&, unsigned, unsigned, const std::string&);
template void Program::add_number(const std::string&, std::size_t&, std::size_t, std::size_t, const std::string&);
template void Program::add_number(const std::string&, double&, double, double, const std::string&);

void Program::add_flag(const std::string& option, bool& variable, const std::string& help) {
    command_line_->add_flag(option, variable, help);
}

void Program::add_word(const std::string& option, std::string& variable, const std::string& help,
                       const std::vector<std::string>& allowed) {
    CLI::Option* const added = command_line_->add_option(option, variable, help);
    if (!allowed.empty()) added->check(CLI::IsMember(allowed))->capture_default_str();
}

// Of an option that may be repeated, CLI11 would take all words up to the next option, meshes too, as its values.
void Program::add_words(const std::string& option, std::vector<std::string>& variable, const std::string& help,
                        const std::vector<std::string>& allowed) {
    CLI::Option* const added = command_line_->add_option(option, variable, help);
    added->take_all()->expected(1)->allow_extra_args(false);
    if (!allowed.empty()) added->check(CLI::IsMember(allowed));
}

int Program::run(int count, char** words, const std::function<void(const std::vector<std::string>&)>& measure) {
    const auto fail = [this](const char* why, int status) {
        const std::string name = command_line_->get_name();
        std::fprintf(stderr, "%s: %s\n", name.c_str(), why);
        if (status == 1) std::fprintf(stderr, "Run '%s --help'.\n", name.c_str());
        return status;
    };
    try {
        command_line_->parse(count, words);
        if (const std::string wrong = tests::force_instruction_set(); !wrong.empty()) return fail(wrong.c_str(), 2);
        measure(meshes_);
    } catch (const CLI::Success& success) {
        return command_line_->exit(success);  // --help
    } catch (const CLI::ParseError& error) {
        return fail(error.what(), 1);
    } catch (const std::invalid_argument& error) {
        return fail(error.what(), 1);
    } catch (const std::exception& error) {
        return fail(error.what(), 2);
    }
    return 0;
}

namespace {

using Subcommands = std::map<std::string_view, int (*)(int count, char** words)>;

/// A function, so that it is there for those that add themselves before main().
Subcommands& subcommands() {
    static Subcommands all;
    return all;
}

}  // namespace

Subcommand::Subcommand(std::string_view name, int (*run)(int count, char** words)) { subcommands()[name] = run; }

int Subcommand::run_named(int count, char** words) {
    const auto named = subcommands().find(count > 1 ? words[1] : "");
    if (named != subcommands().end()) return named->second(count - 1, words + 1);
    std::fprintf(stderr, "%s SUBJECT [OPTION...] [MESH...]; a subject's --help lists its options. Subjects:\n",
                 words[0]);
    for (const auto& [name, run] : subcommands()) std::fprintf(stderr, "  %s\n", name.data());
    return 1;
}

}  // namespace espalier::bench
