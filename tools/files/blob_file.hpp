// A blob as a file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <espalier/blob.hpp>

#include "base/exit_code.hpp"

namespace espalier::tools {

/// The whole file. Throws CommandError (file_access) when it cannot be read, (unsupported) when it is larger than any
/// blob.
std::vector<std::byte> read_file(const std::string& path);

/// An opened blob with the bytes that it points into: moved as one, never copied.
struct BlobFile {
    std::vector<std::byte> bytes;
    Blob blob;

    BlobFile() = default;
    BlobFile(BlobFile&&) = default;
    BlobFile& operator=(BlobFile&&) = default;
};

/// Throws CommandError as read_file does, and (invalid_input or unsupported) when `open` refuses the bytes.
BlobFile open_blob_file(const std::string& path);

/// Opens the blob that was read from `path`. Throws CommandError as open_blob_file does, and (unsupported) for a scene.
BlobFile open_blob(const std::string& path, std::vector<std::byte> bytes);

/// Which exit code a refused blob has: newer than this program, or broken.
ExitCode exit_code_of(OpenStatus status);

/// What was refused, why, and what to do.
std::string refusal_text(const std::string& path, OpenStatus status);

}  // namespace espalier::tools
