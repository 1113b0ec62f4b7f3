// refit: a deformable blob and a pose in, the blob in that pose out.
#include <cstddef>
#include <string>
#include <vector>

#include <espalier/deformation.hpp>

#include <import/base/numbers.hpp>

#include "base/positions.hpp"
#include "bake/policy.hpp"
#include "bake/baking.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "files/outputs.hpp"
#include "layout/places.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"
#include "report/source_point.hpp"

namespace espalier::tools {

namespace {

/// From this quality on, another bake is advised (RefitResult::quality).
constexpr float costly_quality = 1.5f;

/// A blob in a new pose, as the bytes of a file.
struct Refitted {
    std::vector<std::byte> bytes;
    Blob blob;
    float quality = 0.0f;
};

void require_deformable(const RefitArguments& arguments, const Blob& blob) {
    if (blob.is_deformable()) return;
    throw_file_error(ExitCode::unsupported, arguments.blob,
                     " is not deformable. Bake it with 'espalier bake --deformable'.");
}

/// Throws CommandError (invalid_input) for a pose that refit() refuses.
void refuse_pose(const RefitArguments& arguments, const Deformable& mesh, const ImportResult& pose,
                 const std::vector<Vec3>& positions, const RefitResult& result, const Vec3d& origin) {
    const std::string blob = text('\'', printable(arguments.blob), '\'');
    if (positions.size() != mesh.position_count()) {
        throw_file_error(ExitCode::invalid_input, arguments.pose, " has ", counted(positions.size(), "vertex"),
                         ", and the mesh of ", blob, " has ", mesh.position_count(),
                         ". A pose has all vertices of the mesh, in the same order.");
    }
    const Vec3& position = positions[result.position];
    if (result.status == QueryStatus::out_of_range) {
        const auto in_source = [&](Vec3 point) { return words_for_point({point, origin}); };
        const Box range = mesh.range();
        refuse_position(pose, result.position,
                        text("is at ", in_source(position), ", outside of the range of motion of ", blob, ", ",
                             in_source(range.min), " to ", in_source(range.max),
                             ". Bake it with a larger --range, or with this pose among --poses."),
                        "out_of_range");
    }
    refuse_position(pose, result.position, text("has ", words_for_not_finite(position), ". Mend the pose."));
}

Refitted refitted(const RefitArguments& arguments, const AssetFile& file, const ImportResult& pose) {
    std::vector<std::byte> memory(deformable_bytes(file.blob));
    Deformable mesh = create_deformable(file.blob, memory);
    const Vec3d origin = file.blob.source_origin();
    const std::vector<Vec3> positions = positions_in_a_row(pose, origin);
    const RefitResult result = refit(mesh, positions);
    if (!result) refuse_pose(arguments, mesh, pose, positions, result, origin);
    Refitted refitted{std::vector<std::byte>(file.blob.size()), {}, result.quality};
    static_cast<void>(seal(mesh, refitted.bytes));
    refitted.blob = open(refitted.bytes);
    if (!refitted.blob) {
        throw_error(ExitCode::internal,
                    "the refitted blob is refused by this program's own reader: ", describe(refitted.blob.status()),
                    ". Nothing was written; please report the blob and the pose.");
    }
    return refitted;
}

std::vector<Warning> warnings_about(const RefitArguments& arguments, const Refitted& refitted) {
    if (refitted.quality < costly_quality) return {};
    return {{"costly_pose",
             text(printable(arguments.pose), ": in this pose the tree costs an average ray ",
                  rounded(double(refitted.quality), 3),
                  " times as much as at rest. Bake the blob once with this pose among --poses; if the number stays, no "
                  "tree is better in it. Are the vertices in the order of the mesh, and in its units?"),
             arguments.pose,
             {},
             {}}};
}

Json refit_json(const RefitArguments& arguments, const ImportResult& pose, const Refitted& refitted,
                const std::vector<Warning>& warnings) {
    const Box bounds = refitted.blob.bounds();
    Json document = json_document();
    document["file"] = arguments.blob;
    document["pose"] = arguments.pose;
    document["output"] = arguments.output;
    document["positions"] = positions_in_a_row(pose, {}).size();
    document["bounds"] = json_box(bounds.min, bounds.max);
    document["quality"] = json_number(refitted.quality);
    document["bytes"] = refitted.blob.size();
    document["checksum"] = checksum_text(refitted.blob.checksum());
    document["warnings"] = warnings_json(warnings);
    return document;
}

void refuse_to_meet_pose(const RefitArguments& arguments, const std::vector<std::string>& inputs) {
    const NamedOutput outputs[] = {{"-o", arguments.output}};
    for (const std::string& input : inputs) refuse_to_overwrite_input(outputs, input);
    require_writable(outputs);
    if (arguments.json) refuse_standard_output(outputs);
}

}  // namespace

ExitCode run_refit(const RefitArguments& arguments, std::vector<Warning>& warnings) {
    const Console console(arguments.quiet);
    refuse_to_meet_pose(arguments, {arguments.blob, arguments.pose});
    ImportOptions source = import_options(arguments.source, arguments.json, warnings);
    source.keep_vertices = true;
    const AssetFile file = open_blob_file(arguments.blob);
    require_deformable(arguments, file.blob);
    const ImportResult pose = import_with_progress({&arguments.pose, 1}, source, arguments.quiet);
    refuse_to_meet_pose(arguments, pose.files.front().opened);

    const Refitted refitted = tools::refitted(arguments, file, pose);
    give(warnings_about(arguments, refitted), warnings);
    if (arguments.source.strict) refuse_warnings(warnings, pose);
    const Box bounds = refitted.blob.bounds();
    console.say("bounds: ", shortest(bounds.min), " to ", shortest(bounds.max));
    console.say("quality: an average ray costs ", rounded(double(refitted.quality), 3), " times as much as at rest");
    write_output_file(arguments.output, refitted.bytes);
    console.say("wrote ", printable(arguments.output));
    if (arguments.json) print_json(refit_json(arguments, pose, refitted, warnings));
    return ExitCode::ok;
}

}  // namespace espalier::tools
