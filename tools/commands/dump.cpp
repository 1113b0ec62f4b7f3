// dump: every byte of a blob or a scene, with its meaning.
#include <algorithm>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

#include "base/numbers.hpp"
#include "commands.hpp"
#include "files/blob_file.hpp"
#include "layout/listing.hpp"

namespace espalier::tools {

namespace {

using ListHeader = void(Bytes bytes, ByteListing& listing);

ExitCode dump_refused(const DumpArguments& arguments, Bytes bytes, OpenStatus status, ListHeader& list_header) {
    static_assert(format::scene::header_bytes == format::header::bytes);
    const Bytes shown = bytes.first(std::min(bytes.size(), format::header::bytes));
    ByteListing listing(shown, arguments.limit, arguments.json);
    list_header(shown, listing);
    const CommandError refusal(exit_code_of(status),
                               refusal_text(arguments.blob, status) + " Only its header was listed.",
                               {.file = arguments.blob});
    return listing.finish(&refusal);
}

}  // namespace

ExitCode run_dump(const DumpArguments& arguments) {
    const std::vector<std::byte> bytes = read_file(arguments.blob);
    if (is_scene(bytes)) {
        const SceneFile file = try_open_scene(bytes);
        if (!file.scene) return dump_refused(arguments, bytes, file.scene.status(), list_scene_header);
        ByteListing listing(bytes, arguments.limit, arguments.json);
        list_scene(bytes, file.scene, listing);
        return listing.finish();
    }
    const Blob blob = open(bytes);
    if (!blob) return dump_refused(arguments, bytes, blob.status(), list_blob_header);
    ByteListing listing(bytes, arguments.limit, arguments.json);
    list_blob(bytes, blob, listing);
    return listing.finish();
}

}  // namespace espalier::tools
