#include "program.hpp"

#include <CLI/CLI.hpp>
#include <exception>

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

// Of an option that may be repeated, CLI11 would take all words up to the next option, meshes too, as its values.
void Program::add_numbers(const std::string& option, std::vector<unsigned>& variable, unsigned low, unsigned high,
                          const std::string& help) {
    command_line_->add_option(option, variable, help)
        ->check(CLI::Range(low, high))
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false)
        ->capture_default_str();
}

void Program::add_flag(const std::string& option, bool& variable, const std::string& help) {
    command_line_->add_flag(option, variable, help);
}

void Program::add_word(const std::string& option, std::string& variable, const std::string& help) {
    command_line_->add_option(option, variable, help);
}

void Program::add_words(const std::string& option, std::vector<std::string>& variable, const std::string& help) {
    command_line_->add_option(option, variable, help)->take_all()->expected(1)->allow_extra_args(false);
}

void Program::add_required_word(const std::string& option, std::string& variable, const std::string& help) {
    command_line_->add_option(option, variable, help)->required();
}

void Program::add_choice(const std::string& option, std::string& variable, const std::vector<std::string>& allowed,
                         const std::string& help) {
    command_line_->add_option(option, variable, help)->check(CLI::IsMember(allowed))->capture_default_str();
}

void Program::add_choices(const std::string& option, std::vector<std::string>& variable,
                          const std::vector<std::string>& allowed, const std::string& help) {
    command_line_->add_option(option, variable, help)
        ->check(CLI::IsMember(allowed))
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);
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

}  // namespace espalier::bench
