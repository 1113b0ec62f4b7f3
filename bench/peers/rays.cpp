// Espalier beside its peers, on the same vertices and the same rays, asked for the same outputs (t, u, v, normal, id).

#include <CLI/CLI.hpp>

#include "../../tools/base/choices.hpp"
#include "../selected.hpp"
#include "measure.hpp"
#include "system.hpp"

namespace espalier::bench {
namespace {

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

}  // namespace

const Subcommand subcommand("rays", [](int count, char** words) {
    Options options;
    Program program("espalier_bench_peers rays",
                    "Espalier beside its peers, on the same vertices and the same rays; JSON");
    add_options(program, options);
    return program.run(count, words, [&](const std::vector<std::string>& meshes) {
        std::vector<Maker> makers = all_makers(options.bake);
        const auto full_name = [](const Maker& maker) { return maker.name + "/" + maker.profile; };
        const auto is_named = [&](const Maker& maker, const std::string& word) {
            return word == maker.name || word == full_name(maker);
        };
        select(makers, options.systems, is_named, is_reference, full_name);
        if (std::none_of(makers.begin(), makers.end(), is_reference))
            std::fprintf(stderr,
                         "espalier_bench_peers rays: built without Embree 3 (libembree-dev), which ratios are taken "
                         "to: they are "
                         "null, and so is what disagrees\n");
        for (const std::string& path : meshes) measure(path, makers, options);
    });
});

}  // namespace espalier::bench
