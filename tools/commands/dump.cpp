// dump: every byte of a blob or a scene, with its meaning.
#include <algorithm>

#include <espalier/espalier.hpp>

#include "commands.hpp"
#include "files/blob_file.hpp"
#include "layout/listing.hpp"

namespace espalier::tools {

ExitCode run_dump(const DumpArguments& arguments) {
    static_assert(format::scene::header_bytes == format::header::bytes);
    const AssetFile file(arguments.blob);
    const bool is_open = file.status() == OpenStatus::ok;
    const Bytes shown =
        Bytes(file.bytes).first(is_open ? file.bytes.size() : std::min(file.bytes.size(), format::header::bytes));
    ByteListing listing(shown, arguments.limit, arguments.json);
    if (is_open) {
        if (file.is_a_scene) list_scene(shown, file.scene(), listing);
        else list_blob(shown, file.blob, listing);
        return listing.finish();
    }
    if (file.is_a_scene) list_scene_header(shown, listing);
    else list_blob_header(shown, listing);
    const CommandError refusal(exit_code_of(file.status()), file.refusal() + " Only its header was listed.",
                               {.file = arguments.blob});
    return listing.finish(&refusal);
}

}  // namespace espalier::tools
