// trade: one source baked in many ways, measured, and shown.
#include <algorithm>
#include <iostream>
#include <span>

#include <import/base/numbers.hpp>
#include <import/platform/files.hpp>
#include <runtime/lanes/select.hpp>

#include "bake/policy.hpp"
#include "bake/baking.hpp"
#include "base/choices.hpp"
#include "commands.hpp"
#include "files/outputs.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"
#include "trade/point.hpp"

namespace espalier::tools {

namespace {

constexpr float dearest_byte = 1e6f;

TradeSpace trade_space(const TradeArguments& arguments) {
    TradeSpace space;
    space.bits = parse_whole_numbers(arguments.bits, "--bits", 1, format::max_bits);
    space.leaf_sizes = parse_whole_numbers(arguments.leaf_sizes, "--leaf-sizes", 1, format::max_leaf_triangles);
    space.byte_prices = parse_numbers(arguments.byte_prices, "--byte-prices", 0.0f, dearest_byte);
    space.profiles = parse_names(arguments.profiles, "--profiles", profile_choices);
    space.builders = parse_names(arguments.builders, "--builders", builder_choices);
    space.rays = arguments.rays;
    space.repetitions = arguments.repetitions;
    return space;
}

std::string names_of(const TradeArguments& arguments) {
    return listed(arguments.inputs, " + ", [](const std::string& input) { return text_of(path_of(input).filename()); });
}

const char* instruction_set_name() {
    constexpr const char* names[] = {"scalar", "SSE4.2", "AVX2", "AVX-512", "NEON", "SIMD128"};
    return names[static_cast<std::size_t>(detail::instruction_set())];
}

/// How the figures came about.
std::string conditions(const TradeArguments& arguments, std::uint64_t triangles) {
    return text(counted(triangles, "triangle"), ", effort ", name_in(effort_choices, arguments.effort), ". ",
                counted(arguments.rays, "random ray"), " and spheres, one thread, ", instruction_set_name(),
                ", all in turn, medians of ", counted(arguments.repetitions, "repetition"), ".");
}

void write_text(const std::string& path, const std::string& words) {
    write_output_file(path, std::as_bytes(std::span(words)));
}

}  // namespace

ExitCode run_trade(const TradeArguments& arguments, std::vector<Warning>& warnings) {
    const Console console(arguments.quiet);
    const NamedOutput outputs[] = {{"-o", arguments.output}, {"--csv", arguments.csv}};
    for (const std::string& input : arguments.inputs) refuse_to_overwrite_input(outputs, input);
    require_ending(outputs[0], ".svg", "the picture is an SVG");
    require_writable(outputs);
    if (arguments.json) refuse_standard_output(outputs);
    const TradeSpace space = trade_space(arguments);
    BakeOptions options;
    options.origin.reset();
    options.effort = arguments.effort;
    options.threads = arguments.threads;
    options.drop_bad_triangles = arguments.drop_bad_triangles;
    ImportOptions source = import_options(arguments.source, arguments.json, warnings);
    source.require_vertices = !arguments.drop_bad_triangles;

    std::vector<TradePoint> points;
    std::uint64_t triangles = 0;
    {
        const ImportResult imported = import_with_progress(arguments.inputs, source, arguments.quiet);
        if (!arguments.source.allow_empty) refuse_empty_files(imported);
        if (arguments.source.strict) refuse_warnings(warnings, imported);
        for (const ImportedFile& file : imported.files) triangles += file.triangles;
        Progress progress(arguments.quiet);
        points = measure_trade(imported, options, space,
                               [&progress](const char* stage, double done) { progress.show(stage, done); });
    }
    const std::string names = names_of(arguments);
    const std::string how = conditions(arguments, triangles);
    const std::vector<bool> front = pareto_front(points, timed_queries[0]);
    console.say(names, ": ", how);
    console.say(counted(points.size(), "bake"), ", of which ", std::count(front.begin(), front.end(), true),
                " are on the front of bytes, time of closest hits, and error");
    if (!arguments.output.empty()) {
        write_text(arguments.output, trade_chart(names, how, points));
        console.say("wrote ", printable(arguments.output));
    }
    if (!arguments.csv.empty()) {
        write_text(arguments.csv, trade_csv(names, points));
        console.say("wrote ", printable(arguments.csv));
    }
    if (arguments.json) {
        Json document = json_document();
        document["mesh"] = names;
        document["rays"] = arguments.rays;
        document["repetitions"] = arguments.repetitions;
        document["effort"] = name_in(effort_choices, arguments.effort);
        document["instruction_set"] = instruction_set_name();
        document["points"] = trade_json(points);
        document["warnings"] = warnings_json(warnings);
        print_json(document);
    } else if (arguments.csv.empty()) {
        std::cout << trade_csv(names, points);
        finish_standard_output();
    }
    return ExitCode::ok;
}

}  // namespace espalier::tools
