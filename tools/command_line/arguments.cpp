#include "arguments.hpp"

namespace espalier::tools {

void add_blob(Verb verb, std::string& blob) { verb.option("blob", blob, "BLOB", "A blob or a scene").required(); }

void add_json(Verb verb, bool& json) { verb.flag("--json", json, "The result as one JSON object on stdout"); }

void add_json_and_quiet(Verb verb, bool& json, bool& quiet) {
    add_json(verb, json);
    verb.flag("-q,--quiet", quiet, "Warnings and errors only");
}

void add_threads(Verb verb, unsigned& threads, const std::string& description) {
    verb.option("--threads", threads, "COUNT", description).with_default();
}

void add_source(Verb verb, SourceArguments& source, const char* strict, const char* allow_empty) {
    verb.option("--unit", source.unit, "UNIT",
                "What one unit of the files is: m, cm, mm, in, ft, km or um. The blob is in metres. Without it, the "
                "unit that a file states (FBX, glTF, Collada, IFC), else a metre");
    verb.option("--scale", source.scale, "FACTOR", "Factor on all coordinates, on top of the unit");
    verb.choice(
        "--up", source.up, axes,
        "The axis that points up in the files; the asset is turned so that it is +Y in the blob. Without it the "
        "axes stay as the importer gives them (Collada and IFC come with +Y up)");
    verb.flag("--strict", source.strict, strict);
    if (allow_empty != nullptr) verb.flag("--allow-empty", source.allow_empty, allow_empty);
    verb.option("--import-memory", source.import_memory, "BYTES",
                "Most address space (512M, 4G) that reading one file may add, or none for no limit; without it "
                "half of the machine's memory. Beyond it the file is refused");
    verb.option("--import-seconds", source.import_seconds, "SECONDS",
                "Most processor time that reading one file may take. Beyond it the file is refused")
        .with_default()
        .between(0.001, 1e6);
    verb.flag("--verbose", source.verbose, "Also print what the importers report");
}

}  // namespace espalier::tools
