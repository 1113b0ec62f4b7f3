#include "baking.hpp"

#include <optional>
#include <utility>

#include <baker/bake_with.hpp>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

ExitCode exit_code_of_bake(BakeStatus status) {
    switch (status) {
        case BakeStatus::ok:
            return ExitCode::ok;
        case BakeStatus::invalid_options:
            return ExitCode::usage;
        case BakeStatus::invalid_mesh:
            return ExitCode::invalid_input;
        // The mesh is sound and the option is well-formed: together they need more than 24 bits.
        case BakeStatus::too_fine:
            return ExitCode::unsupported;
        case BakeStatus::too_large:
            return ExitCode::unsupported;
        case BakeStatus::internal:
            return ExitCode::internal;
    }
    return ExitCode::internal;
}

BakeResult sound_or_throw(BakeResult result, const Imported& imported, const BakeOptions& options) {
    if (!result) {
        std::string message = result.message;
        if (!message.ends_with('.')) message += '.';
        if (result.status == BakeStatus::invalid_mesh && !options.deformation) {
            message += " --drop-bad-triangles drops such triangles and counts them.";
        }
        const std::optional<SourcePlace>& place = result.place;
        throw CommandError(exit_code_of_bake(result.status), message,
                           place ? details_of(*place, imported) : ErrorDetails());
    }
    static_cast<void>(opened(result));
    return result;
}

}  // namespace

ErrorDetails details_of(const SourcePlace& place, const Imported& imported) {
    ErrorDetails details;
    details.file = imported.files.at(place.file).path;
    details.mesh = place.mesh;
    details.triangle = place.triangle;
    return details;
}

BakeResult bake_or_throw(const Imported& imported, const BakeOptions& options) {
    return bake_or_throw(imported.views(), imported, options);
}

BakeResult bake_or_throw(std::span<const MeshView> meshes, const Imported& imported, const BakeOptions& options) {
    return sound_or_throw(bake(meshes, options), imported, options);
}

BakeResult bake_trial_or_throw(const Imported& imported, const BakeOptions& options) {
    return sound_or_throw(baker::bake_trial(imported.views(), options), imported, options);
}

Blob opened(const BakeResult& baked) {
    const Blob blob = open(baked.bytes);
    if (!blob) {
        throw CommandError(ExitCode::internal,
                           text("the baked blob is refused by this program's own reader: ", describe(blob.status()),
                                ". Nothing was written; please report the mesh."));
    }
    return blob;
}

}  // namespace espalier::tools
