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
                "unit that a file states (3MF, AMF, FBX, glTF, Collada, IFC), else a metre");
    verb.option(
        "--format", source.format, "NAME",
        "Read the files in this format, whatever their names and contents are: obj, off, ply, stl, raw, gltf, 3mf, or "
        "the ending of a format that assimp reads, such as fbx. Without it, the content decides where it is "
        "enough, else the ending");
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
