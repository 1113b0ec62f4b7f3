// bake: meshes in, one blob out.
#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "bake_report.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "import_assimp.hpp"
#include "lengths.hpp"
#include "numbers.hpp"
#include "output_file.hpp"
#include "source_options.hpp"

namespace espalier::tools {

namespace {

BakeOptions bake_options(const BakeArguments& arguments) {
    BakeOptions options;
    if (!arguments.tolerance.empty()) {
        options.tolerance = parse_length(arguments.tolerance, "--tolerance");
        if (*options.tolerance <= 0.0) {
            throw CommandError(ExitCode::usage,
                               text("--tolerance ", printable(arguments.tolerance), ": a tolerance is above zero."));
        }
    }
    options.bits = arguments.bits;
    options.profile = arguments.profile;
    options.original_ids = arguments.original_ids;
    options.materials = arguments.material_bits == 8    ? Materials::bits_8
                        : arguments.material_bits == 16 ? Materials::bits_16
                                                        : Materials::none;
    options.repair = arguments.repair;
    options.effort = arguments.effort;
    options.threads = arguments.threads;
    return options;
}

ExitCode exit_code_of(BakeError::Kind kind) {
    switch (kind) {
        case BakeError::Kind::invalid_options: return ExitCode::usage;
        case BakeError::Kind::invalid_mesh: return ExitCode::invalid_input;
        // The mesh is sound and the option is well-formed: together they ask for more than 24 bits.
        case BakeError::Kind::tolerance_too_fine: return ExitCode::unsupported;
        case BakeError::Kind::too_large: return ExitCode::unsupported;
        case BakeError::Kind::internal: return ExitCode::internal;
    }
    return ExitCode::internal;
}

Imported import_with_progress(const BakeArguments& arguments, ImportOptions options) {
    Progress progress(arguments.quiet);
    options.progress = [&progress](const char* stage, double done) { progress.show(stage, done); };
    return import_files(arguments.inputs, options);
}

Baked bake_or_throw(const Imported& imported, const BakeArguments& arguments) {
    BakeOptions options = bake_options(arguments);
    Progress progress(arguments.quiet);
    options.progress = [&progress](const char* stage, double done) { progress.show(stage, done); };
    const std::vector<MeshView> meshes = imported.views();
    Result<Baked, BakeError> result = bake(meshes, options);
    if (!result) {
        std::string message = result.error().message;
        if (!message.ends_with('.')) message += '.';
        if (result.error().kind == BakeError::Kind::invalid_mesh) {
            message += " --repair drops such triangles and counts them.";
        }
        throw CommandError(exit_code_of(result.error().kind), message);
    }
    return std::move(*result);
}

}  // namespace

ExitCode run_bake(const BakeArguments& arguments) {
    const Console console(arguments.quiet);
    for (const std::string& input : arguments.inputs) refuse_to_overwrite_input(arguments.output, input);
    const ImportOptions source = import_options(arguments.source);
    static_cast<void>(bake_options(arguments));  // a mistyped length is said before a long import

    const Imported imported = import_with_progress(arguments, source);
    say_import(console, arguments, imported);
    const Baked baked = bake_or_throw(imported, arguments);

    // What is written has been read by those who will read it.
    Blob blob;
    if (const Status status = open(baked.blob, blob); status != Status::ok) {
        throw CommandError(ExitCode::internal,
                           text("the baked blob is refused by this program's own reader: ", describe(status),
                                ". Nothing was written; please report the mesh."));
    }
    say_findings(console, baked.report);
    say_result(console, baked.report);
    write_output_file(arguments.output, baked.blob);
    console.say(text("wrote ", printable(arguments.output)));
    if (arguments.json) print_json(bake_json(arguments, imported, baked.report, blob));
    return ExitCode::ok;
}

}  // namespace espalier::tools
