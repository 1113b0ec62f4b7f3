#include "baking.hpp"

#include <optional>
#include <utility>

#include <baker/bake_with.hpp>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

ExitCode exit_code_of(BakeError::Kind kind) {
    switch (kind) {
        case BakeError::Kind::invalid_options:
            return ExitCode::usage;
        case BakeError::Kind::invalid_mesh:
            return ExitCode::invalid_input;
        // The mesh is sound and the option is well-formed: together they ask for more than 24 bits.
        case BakeError::Kind::too_fine:
            return ExitCode::unsupported;
        case BakeError::Kind::too_large:
            return ExitCode::unsupported;
        case BakeError::Kind::internal:
            return ExitCode::internal;
    }
    return ExitCode::internal;
}

Baked sound_or_throw(Result<Baked, BakeError> result, const Imported& imported) {
    if (!result) {
        std::string message = result.error().message;
        if (!message.ends_with('.')) message += '.';
        if (result.error().kind == BakeError::Kind::invalid_mesh) {
            message += " --repair drops such triangles and counts them.";
        }
        const std::optional<SourcePlace>& place = result.error().place;
        throw CommandError(exit_code_of(result.error().kind), message,
                           place ? details_of(*place, imported) : ErrorDetails());
    }
    static_cast<void>(opened(*result));
    return std::move(*result);
}

}  // namespace

ErrorDetails details_of(const SourcePlace& place, const Imported& imported) {
    ErrorDetails details;
    details.file = imported.files.at(place.file).path;
    details.mesh = place.mesh;
    details.triangle = place.triangle;
    return details;
}

Baked bake_or_throw(const Imported& imported, const BakeOptions& options) {
    return sound_or_throw(bake(imported.views(), options), imported);
}

Baked bake_trial_or_throw(const Imported& imported, const BakeOptions& options) {
    return sound_or_throw(baker::bake_trial(imported.views(), options), imported);
}

Blob opened(const Baked& baked) {
    Blob blob;
    if (const Status status = open(baked.blob, blob); status != Status::ok) {
        throw CommandError(ExitCode::internal,
                           text("the baked blob is refused by this program's own reader: ", describe(status),
                                ". Nothing was written; please report the mesh."));
    }
    return blob;
}

}  // namespace espalier::tools
