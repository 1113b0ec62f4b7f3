#include "arguments.hpp"

namespace espalier::tools {

void refuse_empty_values(CLI::App& verb) {
    const CLI::Validator not_empty(
        [](std::string& value) { return std::string(value.empty() ? "the value is empty" : ""); }, "");
    for (CLI::Option* option : verb.get_options())
        if (!option->get_positional() && option->get_items_expected_min() > 0) option->check(not_empty);
    for (CLI::App* below : verb.get_subcommands([](CLI::App*) { return true; })) refuse_empty_values(*below);
}

CLI::App* add_verb(CLI::App& app, const std::string& name, const std::string& description) {
    CLI::App* verb = app.add_subcommand(name, description);
    verb->footer(exit_code_help);
    return verb;
}

void add_blob(CLI::App* verb, std::string& blob) {
    verb->add_option("blob", blob, "A blob or a scene")->required()->type_name("BLOB");
}

void add_json(CLI::App* verb, bool& json) { verb->add_flag("--json", json, "The result as one JSON object on stdout"); }

void add_quiet(CLI::App* verb, bool& quiet) { verb->add_flag("-q,--quiet", quiet, "Warnings and errors only"); }

void add_source(CLI::App* verb, SourceArguments& source) {
    verb->add_option(
            "--unit", source.unit,
            "What one unit of the files is: m, cm, mm, in, ft, km or um. The blob is in metres. Without it, the "
            "unit that a file states (FBX, glTF, Collada, IFC), else a metre")
        ->type_name("UNIT");
    verb->add_option("--scale", source.scale, "Factor on all coordinates, on top of the unit")->type_name("FACTOR");
    add_choice(verb, "--up", source.up, axes,
               "The axis that points up in the files; the asset is turned so that it is +Y in the blob. Without it the "
               "axes stay as the importer gives them (Collada and IFC come with +Y up)");
    verb->add_flag("--strict", source.strict, "Warnings are errors: exit status 3, and nothing is written");
    verb->add_flag("--allow-empty", source.allow_empty,
                   "Take files without triangles, and let bake write a blob without any; without it either is an "
                   "error, and nothing is written");
    verb->add_option("--import-memory", source.import_memory,
                     "Most address space (512M, 4G) that reading one file may add, or none for no limit; without it "
                     "half of the machine's memory. Beyond it the file is refused")
        ->type_name("BYTES");
    verb->add_option("--import-seconds", source.import_seconds,
                     "Most processor time that reading one file may take. Beyond it the file is refused")
        ->capture_default_str()
        ->check(between(0.001, 1e6))
        ->type_name("SECONDS");
    verb->add_flag("--verbose", source.verbose, "Also print what the importers report");
}

}  // namespace espalier::tools
