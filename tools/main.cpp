// The espalier command: its arguments, and nothing else.
#include <espalier/format.hpp>
#include <espalier/version.hpp>

#include <CLI/CLI.hpp>

#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "choices.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

/// The verb that was chosen, ready to run.
using Chosen = std::function<ExitCode()>;

const Choices<Axis> axes{{"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}};

/// An option that takes one of a few names; the help shows them in the order of the list.
template <class Target, class Value>
CLI::Option* add_choice(CLI::App* verb, const std::string& option, Target& target, const Choices<Value>& choices,
                        const std::string& description) {
    std::string names;
    for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.first;
    const auto choose = [&target, choices, option, names](const std::string& name) {
        for (const auto& choice : choices) {
            if (choice.first != name) continue;
            target = choice.second;
            return;
        }
        throw CLI::ValidationError(option, "'" + name + "' is none of " + names);
    };
    return verb->add_option_function<std::string>(option, choose, description)->type_name(names);
}

template <class Number>
CLI::Validator between(Number least, Number most) {
    return CLI::Range(least, most).description("");
}

CLI::App* add_verb(CLI::App& app, const std::string& name, const std::string& description) {
    CLI::App* verb = app.add_subcommand(name, description);
    verb->footer(exit_code_help);
    return verb;
}

void add_json(CLI::App* verb, bool& json) { verb->add_flag("--json", json, "The result as one JSON object on stdout"); }

void add_quiet(CLI::App* verb, bool& quiet) { verb->add_flag("-q,--quiet", quiet, "Warnings and errors only"); }

void add_source(CLI::App* verb, SourceArguments& source) {
    verb->add_option(
            "--unit", source.unit,
            "What one unit of the files is: m, cm, mm, in, ft, km or um. The blob is in metres. Without it, what "
            "a file says of itself (FBX, glTF, Collada, IFC), else a metre")
        ->type_name("UNIT");
    verb->add_option("--scale", source.scale, "Factor on all coordinates, on top of the unit")->type_name("FACTOR");
    add_choice(verb, "--up", source.up, axes,
               "The axis that points up in the files; the asset is turned so that it is +Y in the blob. Without it the "
               "axes stay as the importer gives them (Collada and IFC come with +Y up)");
}

/// The options that try several bakes and keep one. They judge by counters, so that every machine picks the same.
void add_picking(CLI::App* verb, BakeArguments& arguments, CLI::Option* tolerance, CLI::Option* bits) {
    CLI::Option* max_bytes =
        verb->add_option(
                "--max-bytes", arguments.max_bytes,
                "Pick what fits into so many bytes (64K, 1.5M): the finest lattice up to --bits at which "
                "anything fits, and there the profile, builder, leaf size and price of bytes with the least counted "
                "work. With --tolerance or --max-error the lattice stays")
            ->type_name("BYTES");
    verb->add_option(
            "--fastest-under", arguments.fastest_under,
            "Pick the profile, builder, leaf size and price of bytes with the least counted work that fits into so "
            "many bytes, at the lattice asked for")
        ->excludes(max_bytes)
        ->type_name("BYTES");
    verb->add_option(
            "--max-error", arguments.max_error,
            "Pick the profile, builder, leaf size and price of bytes with the least counted work, on the coarsest "
            "lattice that keeps this distance between source and blob")
        ->excludes(tolerance)
        ->excludes(bits)
        ->type_name("LENGTH");
}

void add_bake(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<BakeArguments>();
    CLI::App* verb = add_verb(app, "bake", "Make one blob out of mesh files");
    verb->add_option("inputs", arguments->inputs,
                     "Mesh files of any format that assimp reads, in the order of their file numbers. Node transforms "
                     "are applied; animated meshes are taken in the pose that the file stores")
        ->required()
        ->type_name("MESH");
    verb->add_option("-o,--output", arguments->output, "The blob to write")->required()->type_name("BLOB");
    CLI::Option* tolerance =
        verb->add_option("--tolerance", arguments->tolerance,
                         "Largest distance between source and blob: 0.5mm, 2cm, 1e-3m, 1in; a bare number is in units "
                         "of the blob")
            ->type_name("LENGTH");
    CLI::Option* bits = verb->add_option("--bits", arguments->bits, "Lattice bits over the largest extent")
                            ->capture_default_str()
                            ->check(between(1u, 24u))
                            ->excludes(tolerance)
                            ->type_name("1..24");
    add_picking(verb, *arguments, tolerance, bits);
    add_choice(verb, "--profile", arguments->profile, profile_choices, "How nodes and leaves are coded");
    verb->add_option("--leaf-size", arguments->leaf_size,
                     "Most triangles of a leaf; fewer are tested faster and take more bytes. 16 unless one is picked")
        ->check(between(1u, format::max_leaf_triangles))
        ->type_name(text("1..", format::max_leaf_triangles));
    verb->add_option("--cost-model", arguments->cost_model,
                     "JSON object with any of node_visit, leaf_visit, triangle and byte_price: what the tree is shaped "
                     "by and what picks are judged by")
        ->type_name("FILE");
    add_choice(verb, "--builder", arguments->builder, builder_choices,
               "How the tree is built, before --effort improves it. Without it: binned_sah");
    add_source(verb, arguments->source);
    verb->add_flag("--ids", arguments->original_ids, "Carry each triangle's file, mesh and number in it");
    const Choices<unsigned> widths{{"8", 8u}, {"16", 16u}};
    add_choice(verb, "--materials", arguments->material_bits, widths,
               "Carry each triangle's material number, in so many bits");
    verb->add_flag("--repair", arguments->repair,
                   "Drop triangles with NaN, infinite or missing corners instead of refusing the mesh");
    verb->add_option("--effort", arguments->effort,
                     "0 bakes fastest, 9 bakes best: more candidate splits throughout; subtrees are moved to better "
                     "places once from 4 on, twice at 6, three times from 7 on, down to 16, 8, 4 or 2 triangles")
        ->capture_default_str()
        ->check(between(0u, 9u))
        ->type_name("0..9");
    verb->add_option("--threads", arguments->threads, "0: all of the machine. The bytes do not depend on it")
        ->capture_default_str()
        ->type_name("COUNT");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_bake(*arguments); }; });
}

void add_blob(CLI::App* verb, std::string& blob) {
    verb->add_option("blob", blob, "A blob")->required()->type_name("BLOB");
}

void add_info(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* verb = add_verb(app, "info", "Say what is inside a blob");
    add_blob(verb, arguments->blob);
    add_json(verb, arguments->json);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_info(*arguments); }; });
}

void add_verify(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<VerifyArguments>();
    CLI::App* verb = add_verb(app, "verify", "Prove that a blob is sound; exit status 3 when it is not");
    add_blob(verb, arguments->blob);
    verb->add_flag("--deep", arguments->deep, "Also that every box contains all below it, and that the header is true");
    verb->add_option("--source", arguments->sources,
                     "Also that the vertices of this mesh (or of these, in order) lie within max error of the surface; "
                     "give --unit, --scale and --up as for bake")
        ->type_name("MESH");
    add_source(verb, arguments->source);
    add_json(verb, arguments->json);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_verify(*arguments); }; });
}

void add_query_numbers(CLI::App* verb, QueryArguments& arguments, const std::string& names, int count) {
    verb->add_option("numbers", arguments.numbers, names)->required()->expected(count)->type_name("NUMBER");
    add_json(verb, arguments.json);
}

void add_query(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<QueryArguments>();
    CLI::App* query = add_verb(app, "query", "Ask a blob one question");
    add_blob(query, arguments->blob);
    add_json(query, arguments->json);  // before the question's name as well as after it
    query->require_subcommand(1);

    CLI::App* ray = add_verb(*query, "ray", "What a ray hits first");
    add_query_numbers(ray, *arguments, "Origin x y z and direction x y z; t counts in the direction's length", 6);
    ray->add_option("--t-min", arguments->t_min, "Hits before this t do not count")
        ->capture_default_str()
        ->type_name("T");
    ray->add_option("--t-max", arguments->t_max, "Hits beyond this t do not count")
        ->capture_default_str()
        ->type_name("T");
    const Choices<Faces> faces{{"both", Faces::both}, {"front", Faces::front}, {"back", Faces::back}};
    add_choice(ray, "--faces", arguments->faces, faces, "Which sides of triangles the ray sees; both without it");
    CLI::Option* all = ray->add_flag("--all", arguments->all, "Every hit, in storage order");
    ray->add_flag("--any", arguments->any, "Only whether anything is hit")->excludes(all);
    ray->callback([arguments, &chosen] { chosen = [arguments] { return run_query_ray(*arguments); }; });

    CLI::App* sphere = add_verb(*query, "sphere", "Which triangles a sphere touches, in storage order");
    add_query_numbers(sphere, *arguments, "Centre x y z and radius", 4);
    sphere->add_flag("--any", arguments->any, "Only whether it touches any");
    sphere->callback([arguments, &chosen] { chosen = [arguments] { return run_query_sphere(*arguments); }; });

    CLI::App* nearest = add_verb(*query, "nearest", "The point of the surface that is closest to a point");
    add_query_numbers(nearest, *arguments, "Point x y z", 3);
    nearest->add_option("--max-distance", arguments->max_distance, "Nothing beyond it is found")
        ->capture_default_str()
        ->type_name("DISTANCE");
    nearest->callback([arguments, &chosen] { chosen = [arguments] { return run_query_nearest(*arguments); }; });
}

void add_render(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* verb = add_verb(app, "render", "Draw a blob by casting rays at it");
    add_blob(verb, arguments->blob);
    verb->add_option("-o,--output", arguments->output, "The PNG to write")->required()->type_name("PNG");
    verb->add_option("--size", arguments->size, "Pixels")->capture_default_str()->type_name("WIDTHxHEIGHT");
    const Choices<bool> heatmaps{{"steps", true}};
    add_choice(verb, "--heatmap", arguments->heatmap, heatmaps,
               "Colour by work instead of by light: steps are the nodes and triangles visited for a pixel");
    add_choice(verb, "--up", arguments->up, axes, "The axis that points up in the picture; y without it");
    verb->add_option("--azimuth", arguments->azimuth, "Where the eye stands around the up axis, in degrees")
        ->capture_default_str()
        ->type_name("DEGREES");
    verb->add_option("--elevation", arguments->elevation, "How high the eye stands, in degrees, -89 to 89")
        ->capture_default_str()
        ->check(between(-89.0, 89.0))
        ->type_name("DEGREES");
    verb->add_option("--samples", arguments->samples, "Rays along each side of a pixel")
        ->capture_default_str()
        ->check(between(1u, 8u))
        ->type_name("1..8");
    verb->add_option("--threads", arguments->threads, "0: all of the machine. The picture does not depend on it")
        ->capture_default_str()
        ->type_name("COUNT");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_render(*arguments); }; });
}

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
    add_list("--leaf-sizes", arguments->leaf_sizes, "Most triangles of a leaf, 1 to 16");
    add_list("--byte-prices", arguments->byte_prices,
             "Prices of a byte in the cost model: dearer bytes, smaller blobs");
    add_list("--profiles", arguments->profiles, "Profiles by name, or all");
    add_list("--builders", arguments->builders, "Builders by name, or all");
    verb->add_option("--rays", arguments->rays, "Rays, and as many spheres, that each blob is asked")
        ->capture_default_str()
        ->check(between(100u, 10'000'000u))
        ->type_name("COUNT");
    verb->add_option("--repetitions", arguments->repetitions, "How often; times are medians")
        ->capture_default_str()
        ->check(between(1u, 1000u))
        ->type_name("COUNT");
    verb->add_option("--cost-model", arguments->cost_model, "JSON file, as for bake")->type_name("FILE");
    add_source(verb, arguments->source);
    verb->add_flag("--repair", arguments->repair, "As for bake");
    verb->add_option("--effort", arguments->effort, "0 bakes fastest, 9 bakes best")
        ->capture_default_str()
        ->check(between(0u, 9u))
        ->type_name("0..9");
    verb->add_option("--threads", arguments->threads, "For baking; queries are timed on one thread")
        ->capture_default_str()
        ->type_name("COUNT");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_trade(*arguments); }; });
}

void add_dump(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<DumpArguments>();
    CLI::App* verb = add_verb(app, "dump", "Every byte of a blob, with its meaning");
    add_blob(verb, arguments->blob);
    verb->add_option("--limit", arguments->limit, "At most so many lines, and a last one that says what was left out")
        ->type_name("LINES");
    add_json(verb, arguments->json);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_dump(*arguments); }; });
}

/// CLI11 takes -1 for a number, but -.5 and -inf for options. With a space before it none of them looks like one, and
/// number parsers skip the space.
std::vector<std::string> with_negative_numbers_marked(int count, char** values) {
    std::vector<std::string> arguments;
    for (int i = count - 1; i > 0; --i) {  // CLI11 takes them last first
        std::string argument = values[i];
        if (argument.size() > 1 && argument[0] == '-' && parse_double(argument)) argument.insert(0, 1, ' ');
        arguments.push_back(std::move(argument));
    }
    return arguments;
}

ExitCode run(int count, char** values) {
    CLI::App app{"Baked collision meshes, queried straight from their bytes", "espalier"};
    app.footer(std::string("'espalier VERB --help' says more. stdout is data, stderr is talk.\n") + exit_code_help);
    app.set_version_flag("--version", text("espalier ", library_version, ", format ", format::version_major, '.',
                                           format::version_minor));
    app.require_subcommand(1);
    Chosen chosen;
    add_bake(app, chosen);
    add_info(app, chosen);
    add_verify(app, chosen);
    add_query(app, chosen);
    add_render(app, chosen);
    add_trade(app, chosen);
    add_dump(app, chosen);
    try {
        app.parse(with_negative_numbers_marked(count, values));
    } catch (const CLI::Success& success) {  // --help and --version
        app.exit(success);
        finish_standard_output();
        return ExitCode::ok;
    } catch (const CLI::ParseError& error) {
        std::cerr << "espalier: " << printable(error.what()) << "\nRun 'espalier --help' or 'espalier VERB --help'.\n";
        return ExitCode::usage;
    }
    return chosen();
}

}  // namespace

}  // namespace espalier::tools

int main(int count, char** values) {
    using espalier::tools::ExitCode;
    try {
        return static_cast<int>(espalier::tools::run(count, values));
    } catch (const espalier::tools::CommandError& error) {
        std::cerr << "espalier: " << error.what() << '\n';
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        std::cerr << "espalier: the machine has not enough memory for this. Bake the asset in parts.\n";
    } catch (const std::exception& error) {
        std::cerr << "espalier: internal error: " << error.what() << ". Please report how it came about.\n";
    }
    return static_cast<int>(ExitCode::internal);
}
