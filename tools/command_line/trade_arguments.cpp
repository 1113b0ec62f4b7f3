// What trade takes.
#include <memory>

#include "arguments.hpp"
#include "commands/commands.hpp"

namespace espalier::tools {

void add_trade(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<TradeArguments>();
    CLI::App* verb = add_verb(app, "trade", "Bake one source in many ways; measure bytes, time and error of each");
    verb->add_option("inputs", arguments->inputs, "Mesh files, as for bake")->required()->type_name("MESH");
    verb->add_option("-o,--output", arguments->output, "The picture to write: the trade and its Pareto front")
        ->type_name("SVG");
    verb->add_option("--csv", arguments->csv, "Where the numbers go; without it and without --json, to stdout")
        ->type_name("CSV");
    const auto add_list = [&](const char* option, std::string& list, const char* description) {
        verb->add_option(option, list, description)->capture_default_str()->type_name("LIST");
    };
    add_list("--bits", arguments->bits, "Lattices, 1 to 24 bits");
    add_list("--leaf-sizes", arguments->leaf_sizes,
             "Most triangles of a leaf; if a profile holds fewer, its limit is taken");
    add_list("--byte-prices", arguments->byte_prices,
             "Prices of a byte, as --byte-price of bake: higher prices give smaller blobs");
    add_list("--profiles", arguments->profiles, "Profiles by name, or all");
    add_list("--builders", arguments->builders, "Builders by name, or all");
    verb->add_option("--rays", arguments->rays, "Rays, and as many spheres, that are tested against each blob")
        ->capture_default_str()
        ->check(between(100u, 10'000'000u))
        ->type_name("COUNT");
    verb->add_option("--repetitions", arguments->repetitions, "How often each query is timed; the times are medians")
        ->capture_default_str()
        ->check(between(1u, 1000u))
        ->type_name("COUNT");
    add_source(verb, arguments->source);
    verb->add_flag("--drop-bad-triangles", arguments->drop_bad_triangles, "As for bake");
    add_choice(verb, "--effort", arguments->effort, effort_choices, "As for bake");
    verb->add_option("--threads", arguments->threads,
                     "Threads of the bakes, 0 for all of the machine; queries are timed on one")
        ->capture_default_str()
        ->type_name("COUNT");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_trade(*arguments); }; });
}

}  // namespace espalier::tools
