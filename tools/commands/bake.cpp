// bake: meshes in, one blob or one scene out.
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <import/base/numbers.hpp>

#include "bake/baking.hpp"
#include "bake/policy.hpp"
#include "base/choices.hpp"
#include "commands.hpp"
#include "files/outputs.hpp"
#include "files/blob_file.hpp"
#include "report/diagnostics.hpp"
#include "scenes/baking.hpp"
#include "trade/point.hpp"

namespace espalier::tools {

namespace {

/// Nothing when no picking option was given.
std::optional<PickGoal> pick_goal(const BakeArguments& arguments) {
    PickGoal goal;
    if (arguments.max_bytes) {
        goal.max_bytes = parse_byte_size(*arguments.max_bytes, "--max-bytes");
        goal.may_coarsen = arguments.tolerance.empty() && arguments.step.empty() && arguments.lattice_of.empty() &&
                           !arguments.max_error;
        goal.limit_name = text("--max-bytes ", printable(*arguments.max_bytes));
    } else if (arguments.fastest_under) {
        goal.max_bytes = parse_byte_size(*arguments.fastest_under, "--fastest-under");
        goal.limit_name = text("--fastest-under ", printable(*arguments.fastest_under));
    } else if (!arguments.max_error) {
        return std::nullopt;
    }
    goal.max_dropped = arguments.max_dropped;
    goal.profile = arguments.deformable ? Profile::fast : arguments.profile;
    goal.builder = arguments.builder;
    goal.leaf_size = arguments.leaf_size;
    return goal;
}

void write_blob(const BakeArguments& arguments, const ImportResult& imported, std::span<const ImportedFile> poses,
                const BakeResult& baked) {
    const std::vector<std::byte> remap = arguments.remap.empty() ? std::vector<std::byte>() : remap_file(baked);
    const std::vector<std::byte> reordered =
        arguments.reorder.empty() ? std::vector<std::byte>() : reordered_mesh(arguments.reorder, imported, baked.remap);
    write_outputs(arguments, imported, poses, {baked.bytes, remap, reordered});
}

/// Prints what was picked; for the rest of the verb it is a bake like any other.
BakeResult bake_or_pick(const ImportResult& imported, const BakeArguments& arguments, BakeOptions options,
                        const Console& console, Json& picked_json) {
    const std::optional<PickGoal> goal = pick_goal(arguments);
    Progress progress(arguments.quiet);
    options.progress = [&progress](const char* stage, double done) { progress.show(stage, done); };
    if (!goal) return bake_or_throw(imported, options);
    Picked picked = pick(imported, options, *goal);
    say_pick(console, picked, options);
    picked_json = pick_json(picked);
    return std::move(picked.baked);
}

/// What a bake needs once its meshes are read.
struct Baking {
    const BakeArguments& arguments;
    const AssetPolicy& policy;
    const Console& console;
    const ImportResult& imported;
    const std::vector<ImportedFile>& poses;
    const BakeOptions& options;
};

ExitCode bake_blob(const Baking& baking, std::vector<Warning>& warnings) {
    const auto& [arguments, policy, console, imported, poses, options] = baking;
    Json picked_json;
    const BakeResult baked = bake_or_pick(imported, arguments, options, console, picked_json);
    give(bake_warnings(baked.report, policy, imported), warnings);
    enforce(policy, imported, baked.report, warnings);
    say_report(console, baked.report);
    write_blob(arguments, imported, poses, baked);
    for (const std::string& written : {arguments.remap, arguments.reorder, arguments.output})
        if (!written.empty()) console.say("wrote ", printable(written));
    if (arguments.json) {
        Json document = bake_json(arguments, imported, baked.report, opened(baked), warnings);
        if (!picked_json.is_null()) document["picked"] = std::move(picked_json);
        print_json(document);
    }
    return ExitCode::ok;
}

SceneBake bake_scene_with_progress(const Baking& baking) {
    Progress progress(baking.arguments.quiet);
    BakeOptions options = baking.options;
    options.progress = [&progress](const char* stage, double done) { progress.show(stage, done); };
    return bake_scene_or_throw(baking.imported, baking.arguments.instancing, options);
}

ExitCode bake_scene(const Baking& baking, std::vector<Warning>& warnings) {
    const auto& [arguments, policy, console, imported, poses, options] = baking;
    SceneBake baked = bake_scene_with_progress(baking);
    baked.total.bounds.extent = asset_size(imported).extent;
    const SceneFile file = opened_scene(arguments.output, baked.bytes);
    give(bake_warnings(baked.total, policy, imported), warnings);
    give(border_warnings(imported, baked, file.scene), warnings);
    enforce(policy, imported, baked.total, warnings);
    say_scene(console, baked, file.scene);
    write_outputs(arguments, imported, poses, {.result = baked.bytes, .remap = {}, .reordered = {}});
    console.say("wrote ", printable(arguments.output));
    if (arguments.json) print_json(scene_json(arguments, imported, baked, file.scene, warnings));
    return ExitCode::ok;
}

}  // namespace

ExitCode run_bake(const BakeArguments& arguments, std::vector<Warning>& warnings) {
    const Console console(arguments.quiet);
    const NamedOutput outputs[] = {{"-o", arguments.output},
                                   {"--depfile", arguments.depfile},
                                   {"--remap", arguments.remap},
                                   {"--reorder", arguments.reorder}};
    refuse_one_file_for_two(outputs);
    for (const std::string& input : arguments.inputs) refuse_to_overwrite_input(outputs, input);
    for (const std::string& pose : arguments.poses) refuse_to_overwrite_input(outputs, pose);
    refuse_to_overwrite_input(outputs, arguments.lattice_of);
    refuse_options_of_rigid_blobs(arguments);
    refuse_options_of_blobs(arguments);
    require_writable_mesh(arguments.reorder);
    require_writable(outputs);
    if (arguments.json) refuse_standard_output(outputs);
    const AssetPolicy policy = asset_policy(arguments);
    ImportOptions source = import_options(arguments.source, arguments.json, warnings);
    source.materials = arguments.materials;
    source.keep_places = arguments.instancing != Instancing::off;
    source.keep_vertices = arguments.deformable;
    source.require_vertices = !arguments.drop_bad_triangles;
    BakeOptions options = bake_options(arguments);  // reports typing errors before a long import
    static_cast<void>(pick_goal(arguments));

    ImportResult imported = import_with_progress(arguments.inputs, source, arguments.quiet);
    for (const ImportedFile& file : imported.files)
        for (const std::string& opened : file.opened) refuse_to_overwrite_input(outputs, opened);
    say_import(console, arguments, imported);
    Poses poses = import_poses(arguments, source, imported, options.origin.value_or(Vec3d{}));
    if (options.deformation) options.deformation->poses = std::move(poses.positions);
    if (arguments.instancing != Instancing::off) options.origin = move_to_origin(imported, options);
    const Baking baking{arguments, policy, console, imported, poses.files, options};
    return arguments.instancing == Instancing::off ? bake_blob(baking, warnings) : bake_scene(baking, warnings);
}

}  // namespace espalier::tools
