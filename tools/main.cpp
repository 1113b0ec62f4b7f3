// The espalier command: its arguments, and nothing else.
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>
#include <espalier/format.hpp>

#include <import/base/numbers.hpp>
#include <import/platform/process.hpp>

#include "command_line/arguments.hpp"
#include "commands/commands.hpp"
#include "report/diagnostics.hpp"

namespace espalier::tools {

namespace {

void add_refit(Verb verb, RefitArguments& arguments) {
    verb.option("blob", arguments.blob, "BLOB", "A blob of bake --deformable").required();
    verb.option("pose", arguments.pose, "POSE",
                "A mesh file with all vertices of the baked mesh, in the same order: OBJ, OFF, PLY, 3MF or glTF. Its "
                "faces do not count; give --unit, --scale and --up as for bake")
        .required();
    verb.option("-o,--output", arguments.output, "BLOB", "The blob to write, in this pose").required();
    add_source(verb, arguments.source, strict_of_a_bake, nullptr);  // a pose needs no triangles
    add_json_and_quiet(verb, arguments.json, arguments.quiet);
}

void add_embed(Verb verb, EmbedArguments& arguments) {
    add_blob(verb, arguments.blob);
    verb.option("-o,--output", arguments.output, "SOURCE",
                "The source to write: an array for C and C++ (.c, .cpp), or assembler (.S) that includes the blob "
                "by its name, which compiles faster; give the compiler the blob's folder with -I")
        .required();
    verb.option("--header", arguments.header, "HEADER",
                "Also write a header for C and C++ that declares SYMBOL, SYMBOL_size and, in C++20, SYMBOL_bytes()");
    verb.option("--symbol", arguments.symbol, "SYMBOL",
                "Name of the array; without it, that of SOURCE without its ending");
    verb.option("--section", arguments.section, "SECTION", "Where the linker finds it; without it .rodata.SYMBOL");
    verb.option("--alignment", arguments.alignment, "BYTES",
                "Of the first byte; a power of two. Queries need none: it is for caches and for direct memory access")
        .with_default();
    add_json_and_quiet(verb, arguments.json, arguments.quiet);
}

void add_info(Verb verb, InfoArguments& arguments) {
    add_blob(verb, arguments.blob);
    verb.flag("--histogram", arguments.histogram,
              "Also how good the tree is: areas, volumes and overlap of boxes by depth, balance, triangles in a leaf");
    add_json(verb, arguments.json);
}

void add_verify(Verb verb, VerifyArguments& arguments) {
    add_blob(verb, arguments.blob);
    verb.flag("--deep", arguments.deep, "Also that every box contains all below it, and that the header is true");
    verb.option("--source", arguments.sources, "MESH",
                "Also that the blob and this mesh (or these, in order) have the same triangles, within max error; give "
                "--unit, --scale and --up as for bake");
    add_source(verb, arguments.source, "Warnings about the files of --source are errors: exit status 3",
               "Take files of --source without triangles; without it they are an error");
    add_json(verb, arguments.json);
}

void add_render(Verb verb, RenderArguments& arguments) {
    add_blob(verb, arguments.blob);
    verb.option("-o,--output", arguments.output, "PNG", "The PNG to write").required();
    verb.option("--size", arguments.size, "WIDTHxHEIGHT", "Pixels").with_default();
    const Choices<bool> heatmaps{{"steps", true}};
    verb.choice(
        "--heatmap", arguments.heatmap, heatmaps,
        "Colour by work instead of by light: steps are the nodes and triangles visited for a pixel; of blobs only");
    verb.choice("--up", arguments.up, axes, "The axis that points up in the picture; y without it");
    verb.option("--azimuth", arguments.azimuth, "DEGREES", "Where the eye stands around the up axis, in degrees")
        .with_default();
    verb.option("--elevation", arguments.elevation, "DEGREES", "How high the eye stands, in degrees, -89 to 89")
        .with_default()
        .between(-89.0, 89.0);
    verb.option("--samples", arguments.samples, "1..8", "Rays along each side of a pixel")
        .with_default()
        .between(1u, 8u);
    add_threads(verb, arguments.threads, "0: all of the machine. The picture does not depend on it");
    add_json_and_quiet(verb, arguments.json, arguments.quiet);
}

void add_dump(Verb verb, DumpArguments& arguments) {
    add_blob(verb, arguments.blob);
    verb.option("--limit", arguments.limit, "LINES",
                "At most so many lines, and a last one that counts the bytes left out");
    add_json(verb, arguments.json);
}

/// A verb whose options are those that `add` adds.
template <class Arguments, class... Warnings>
void add_verb(Verb& command, const char* name, const char* description, void (*add)(Verb, Arguments&),
              ExitCode (*run)(const Arguments&, Warnings&...)) {
    const auto arguments = std::make_shared<Arguments>();
    Verb verb = command.below(name, description);
    add(verb, *arguments);
    verb.runs([arguments, run] {
        return with_warnings([&](std::vector<Warning>& warnings) {
            if constexpr (sizeof...(Warnings) == 0) return run(*arguments);
            else return run(*arguments, warnings);
        });
    });
}

ExitCode run(const std::vector<std::string>& words) {
    CommandLine line("Baked collision meshes, queried straight from their bytes",
                     text("espalier ", library_version, ", format ", format::version_major, '.', format::version_minor),
                     "'espalier VERB --help' has the options. stdout is data; stderr has messages.\n");
    Verb& command = line.top();
    add_verb(command, "bake", "Make one blob or scene out of mesh files", add_bake, run_bake);
    add_verb(command, "refit", "Move the vertices of a deformable blob to a pose", add_refit, run_refit);
    add_verb(command, "embed", "Make a blob or a scene into a source file, to be linked into a program", add_embed,
             run_embed);
    add_verb(command, "info", "Say what is inside a blob or a scene", add_info, run_info);
    add_verb(command, "verify", "Prove that a blob or a scene is sound; exit status 3 when it is not", add_verify,
             run_verify);
    add_query(command.below("query", "Answer one query of a blob or a scene"));
    add_verb(command, "render", "Draw a blob or a scene by casting rays at it", add_render, run_render);
    add_verb(command, "trade", "Bake one source in many ways; measure bytes, time and error of each", add_trade,
             run_trade);
    add_verb(command, "dump", "Every byte of a blob or a scene, with its meaning", add_dump, run_dump);
    return line.parse(words)();
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
