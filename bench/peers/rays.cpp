// Espalier beside its peers, on the same vertices and the same rays, asked for the same outputs (t, u, v, normal, id).

#include <CLI/CLI.hpp>

#include "../../tools/base/choices.hpp"
#include "measure.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

std::string known_systems(const std::vector<Maker>& makers) {
    std::string names;
    for (const Maker& maker : makers) names += "\n  " + maker.name + "/" + maker.profile;
    return names;
}

/// Every --system must name something.
void check_systems(const Options& options, const std::vector<Maker>& makers) {
    for (const std::string& system : options.systems) {
        const auto named = [&system](const Maker& m) { return system == m.name || system == m.name + "/" + m.profile; };
        if (std::none_of(makers.begin(), makers.end(), named))
            throw std::invalid_argument(
                "there is no system '" + system +
                "' in this build; peers are compiled where they are installed. There are:" + known_systems(makers));
    }
}

/// Adds an option that takes the name of one of the values.
template <class Value>
void add_named(CLI::App& words, const char* option, Value& variable, const tools::Choices<Value>& choices,
               const char* help) {
    const auto choose = [&variable, &choices](const std::string& word) {
        for (const auto& [name, value] : choices)
            if (name == word) variable = value;
    };
    words.add_option_function<std::string>(option, choose, help)->check(CLI::IsMember(names_of(choices)));
}

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

}  // namespace

int rays_subject(int count, char** words) {
    Options options;
    Program program("espalier_bench_peers rays", "Espalier beside its peers, on the same vertices and the same rays");
    add_options(program, options);
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        std::vector<Maker> makers = all_makers(options.bake);
        check_systems(options, makers);
        std::erase_if(makers, [&options](const Maker& maker) { return !is_asked_for(maker, options); });
        if (std::none_of(makers.begin(), makers.end(), is_reference))
            std::fprintf(stderr,
                         "espalier_bench_peers rays: built without Embree 3 (libembree-dev), which ratios are taken "
                         "to: they are "
                         "null, and so is what disagrees\n");
        for (const std::string& path : meshes) {
            const MeshResult result = measure(path, makers, options);
            options.json ? print_json(result, options) : print_table(result, options);
        }
    });
}

}  // namespace espalier::bench
