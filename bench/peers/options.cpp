#include "options.hpp"

#include <CLI/CLI.hpp>

#include "../../tools/base/choices.hpp"

namespace espalier::bench {

namespace {

/// Adds an option that takes the name of one of the values.
template <class Value>
void add_named(CLI::App& words, const char* option, Value& variable, const tools::Choices<Value>& choices,
               const char* help) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    const auto choose = [&variable, &choices](const std::string& word) {
        for (const auto& [name, value] : choices)
            if (name == word) variable = value;
    };
    words.add_option_function<std::string>(option, choose, help)->check(CLI::IsMember(names));
}

}  // namespace

void add_options(Program& program, Options& options) {
    const auto is_reference_only = [&options](std::int64_t) { options.systems.emplace_back("espalier"); };
    program.add_flag("--json", options.json, "A JSON object for each row instead of a table");
    CLI::App& words = program.command_line();
    words.add_option("--system", options.systems, "Only NAME or NAME/PROFILE beside the reference; may be repeated")
        ->type_name("NAME")
        ->take_all()
        ->expected(1);
    words.add_flag_function("--reference-only", is_reference_only, "The same as --system espalier");
    program.add_count("--repetitions", options.repetitions, "How often every system answers all rays");
    program.add_count("--builds", options.builds, "How often every system is built");
    program.add_count("--rays", options.incoherent, "Incoherent rays");
    words.add_option("--seed", options.seed, "Of the incoherent rays")->capture_default_str();
    program.add_number("--bits", options.bake.bits, 1u, 24u, "Espalier's lattice");
    add_named(words, "--effort", options.bake.effort, tools::effort_choices, "Of Espalier's build (normal)");
    add_named(words, "--builder", options.bake.builder, tools::builder_choices, "Of Espalier's build (binned_sah)");
}

bool is_asked_for(const Maker& maker, const Options& options) {
    if (options.systems.empty() || is_reference(maker)) return true;
    for (const std::string& system : options.systems)
        if (system == maker.name || system == maker.name + "/" + maker.profile) return true;
    return false;
}

}  // namespace espalier::bench
