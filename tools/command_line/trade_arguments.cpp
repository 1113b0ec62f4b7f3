// What trade takes.
#include "arguments.hpp"

namespace espalier::tools {

void add_trade(Verb verb, TradeArguments& arguments) {
    verb.option("inputs", arguments.inputs, "MESH", "Mesh files, as for bake").required();
    verb.option("-o,--output", arguments.output, "SVG", "The picture to write: the trade and its Pareto front");
    verb.option("--csv", arguments.csv, "CSV", "Where the numbers go; without it and without --json, to stdout");
    const auto add_list = [&](const char* name, std::string& list, const char* description) {
        verb.option(name, list, "LIST", description).with_default();
    };
    add_list("--bits", arguments.bits, "Lattices, 1 to 24 bits");
    add_list("--leaf-sizes", arguments.leaf_sizes,
             "Most triangles of a leaf; if a profile holds fewer, its limit is taken");
    add_list("--byte-prices", arguments.byte_prices,
             "Prices of a byte, as --byte-price of bake: higher prices give smaller blobs");
    add_list("--profiles", arguments.profiles, "Profiles by name, or all");
    add_list("--builders", arguments.builders, "Builders by name, or all");
    verb.option("--rays", arguments.rays, "COUNT", "Rays, and as many spheres, that are tested against each blob")
        .with_default()
        .between(100u, 10'000'000u);
    verb.option("--repetitions", arguments.repetitions, "COUNT", "How often each query is timed; the times are medians")
        .with_default()
        .between(1u, 1000u);
    add_source(verb, arguments.source);
    verb.flag("--drop-bad-triangles", arguments.drop_bad_triangles, "As for bake");
    verb.choice("--effort", arguments.effort, effort_choices, "As for bake");
    add_threads(verb, arguments.threads, "Threads of the bakes, 0 for all of the machine; queries are timed on one");
    add_json_and_quiet(verb, arguments.json, arguments.quiet);
}

}  // namespace espalier::tools
