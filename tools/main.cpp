// The espalier command: its arguments, and nothing else.
#include <espalier/espalier.hpp>
#include <espalier/format.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/choices.hpp"
#include "base/numbers.hpp"
#include "command_line/arguments.hpp"
#include "command_line/usage_error.hpp"
#include "commands/commands.hpp"
#include "platform/arguments.hpp"
#include "platform/standard_streams.hpp"
#include "report/console.hpp"
#include "report/diagnostics.hpp"
#include "report/failure.hpp"

namespace espalier::tools {

namespace {

void add_refit(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<RefitArguments>();
    CLI::App* verb = add_verb(app, "refit", "Move the vertices of a deformable blob to a pose");
    verb->add_option("blob", arguments->blob, "A blob of bake --deformable")->required()->type_name("BLOB");
    verb->add_option("pose", arguments->pose,
                     "A mesh file with all vertices of the baked mesh, in the same order: OBJ, PLY or glTF. Its faces "
                     "do not count; give --unit, --scale and --up as for bake")
        ->required()
        ->type_name("POSE");
    verb->add_option("-o,--output", arguments->output, "The blob to write, in this pose")
        ->required()
        ->type_name("BLOB");
    add_source(verb, arguments->source);
    verb->remove_option(verb->get_option("--allow-empty"));  // a pose needs no triangles
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_refit(*arguments); }; });
}

void add_embed(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<EmbedArguments>();
    CLI::App* verb = add_verb(app, "embed", "Make a blob or a scene into a source file, to be linked into a program");
    add_blob(verb, arguments->blob);
    verb->add_option("-o,--output", arguments->output,
                     "The source to write: an array for C and C++ (.c, .cpp), or assembler (.S) that includes the blob "
                     "by its name, which compiles faster; give the compiler the blob's folder with -I")
        ->required()
        ->type_name("SOURCE");
    verb->add_option(
            "--header", arguments->header,
            "Also write a header for C and C++ that declares SYMBOL, SYMBOL_size and, in C++20, SYMBOL_bytes()")
        ->type_name("HEADER");
    verb->add_option("--symbol", arguments->symbol, "Name of the array; without it, that of SOURCE without its ending")
        ->type_name("SYMBOL");
    verb->add_option("--section", arguments->section, "Where the linker finds it; without it .rodata.SYMBOL")
        ->type_name("SECTION");
    verb->add_option("--alignment", arguments->alignment,
                     "Of the first byte; a power of two. Queries need none: it is for caches and for direct memory "
                     "access")
        ->capture_default_str()
        ->type_name("BYTES");
    add_json(verb, arguments->json);
    add_quiet(verb, arguments->quiet);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_embed(*arguments); }; });
}

void add_info(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* verb = add_verb(app, "info", "Say what is inside a blob or a scene");
    add_blob(verb, arguments->blob);
    verb->add_flag(
        "--histogram", arguments->histogram,
        "Also how good the tree is: areas, volumes and overlap of boxes by depth, balance, triangles in a leaf");
    add_json(verb, arguments->json);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_info(*arguments); }; });
}

void add_verify(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<VerifyArguments>();
    CLI::App* verb = add_verb(app, "verify", "Prove that a blob or a scene is sound; exit status 3 when it is not");
    add_blob(verb, arguments->blob);
    verb->add_flag("--deep", arguments->deep, "Also that every box contains all below it, and that the header is true");
    verb->add_option("--source", arguments->sources,
                     "Also that the vertices of this mesh (or of these, in order) lie within max error of the surface; "
                     "give --unit, --scale and --up as for bake")
        ->type_name("MESH");
    add_source(verb, arguments->source);
    verb->get_option("--strict")->description("Warnings about the files of --source are errors: exit status 3");
    verb->get_option("--allow-empty")
        ->description("Take files of --source without triangles; without it they are an error");
    add_json(verb, arguments->json);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_verify(*arguments); }; });
}

void add_render(CLI::App& app, Chosen& chosen) {
    auto arguments = std::make_shared<RenderArguments>();
    CLI::App* verb = add_verb(app, "render", "Draw a blob or a scene by casting rays at it");
    add_blob(verb, arguments->blob);
    verb->add_option("-o,--output", arguments->output, "The PNG to write")->required()->type_name("PNG");
    verb->add_option("--size", arguments->size, "Pixels")->capture_default_str()->type_name("WIDTHxHEIGHT");
    const Choices<bool> heatmaps{{"steps", true}};
    add_choice(
        verb, "--heatmap", arguments->heatmap, heatmaps,
        "Colour by work instead of by light: steps are the nodes and triangles visited for a pixel; of blobs only");
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
    CLI::App* verb = add_verb(app, "dump", "Every byte of a blob or a scene, with its meaning");
    add_blob(verb, arguments->blob);
    verb->add_option("--limit", arguments->limit,
                     "At most so many lines, and a last one that counts the bytes left out")
        ->type_name("LINES");
    add_json(verb, arguments->json);
    verb->callback([arguments, &chosen] { chosen = [arguments] { return run_dump(*arguments); }; });
}

/// Returns "bake --help" for "help bake".
std::vector<std::string> with_help_as_option(std::vector<std::string> arguments) {
    if (arguments.empty() || arguments.front() != "help") return arguments;
    arguments.erase(arguments.begin());
    if (arguments.size() > 1 && arguments.front() == "query") arguments.insert(arguments.begin() + 1, "BLOB");
    arguments.emplace_back("--help");
    return arguments;
}

/// CLI11 takes -1 for a number, but -.5, -inf and -2mm for options. With a space before it none of them looks like one,
/// and number parsers skip the space.
std::vector<std::string> with_negative_numbers_marked(std::vector<std::string> arguments) {
    for (std::string& argument : arguments) {
        const bool is_negative =
            argument.size() > 1 && argument[0] == '-' &&
            (argument[1] == '.' || (argument[1] >= '0' && argument[1] <= '9') || parse_double(argument));  // -inf
        if (is_negative) argument.insert(0, 1, ' ');
    }
    return arguments;
}

ExitCode run(std::vector<std::string> words) {
    CLI::App app{"Baked collision meshes, queried straight from their bytes", "espalier"};
    app.allow_windows_style_options(false);  // on no system is /folder/mesh.obj an option
    app.footer(std::string("'espalier VERB --help' has the options. stdout is data; stderr has messages.\n") +
               exit_code_help);
    app.set_version_flag("--version", text("espalier ", library_version, ", format ", format::version_major, '.',
                                           format::version_minor));
    app.require_subcommand(1);
    Chosen chosen;
    add_bake(app, chosen);
    add_refit(app, chosen);
    add_embed(app, chosen);
    add_info(app, chosen);
    add_verify(app, chosen);
    add_query(app, chosen);
    add_render(app, chosen);
    add_trade(app, chosen);
    add_dump(app, chosen);
    refuse_empty_values(app);
    words = with_negative_numbers_marked(with_help_as_option(std::move(words)));
    std::reverse(words.begin(), words.end());  // CLI11 takes them last first
    try {
        app.parse(std::move(words));
    } catch (const CLI::Success& success) {  // --help and --version
        app.exit(success);
        finish_standard_output();
        return ExitCode::ok;
    } catch (const CLI::ParseError& error) {
        throw usage_error(app, error);
    }
    return chosen();
}

/// Whether a document is due on stdout, also where the command line cannot be parsed.
bool wants_json(const std::vector<std::string>& words) {
    const auto end_of_options = std::find(words.begin(), words.end(), "--");
    return std::find(words.begin(), end_of_options, "--json") != end_of_options;
}

ExitCode run_and_report(const std::vector<std::string>& words) {
    const auto report = [&](const CommandError& error) {
        Json document = json_document();
        document["warnings"] = warnings_json(error.details().warnings);
        return report_failure(error, wants_json(words) ? &document : nullptr);
    };
    try {
        return run(words);
    } catch (...) {
        return report(current_failure());
    }
}

}  // namespace

}  // namespace espalier::tools

int main(int count, char** values) {
    using namespace espalier::tools;
    prepare_standard_streams();
    try {
        return static_cast<int>(run_and_report(words_of_command_line(count, values)));
    } catch (const CommandError& error) {  // the report itself cannot be written
        std::cerr << "espalier: " << error.what() << '\n';
        return static_cast<int>(error.code());
    }
}
