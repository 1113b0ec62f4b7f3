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

#include "arguments.hpp"
#include "choices.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

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
