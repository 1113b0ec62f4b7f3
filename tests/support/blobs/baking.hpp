// Baking in one line, for tests whose subject is not the baker.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "support/meshes/mesh.hpp"

namespace espalier::tests {

using Bytes = std::vector<std::byte>;

/// The blob's bytes. Throws std::runtime_error with the baker's message.
std::vector<std::byte> bake_or_throw(const Mesh& mesh, const BakeOptions& options = {});

/// Bytes and the view that was opened on them. Throws when the baker or `open` refuses.
struct OpenedBlob {
    explicit OpenedBlob(std::vector<std::byte> blob_bytes);
    OpenedBlob(const Mesh& mesh, const BakeOptions& options = {}) : OpenedBlob(bake_or_throw(mesh, options)) {}
    OpenedBlob(OpenedBlob&&) = default;  // the vector's storage, which the view points into, moves along
    OpenedBlob& operator=(OpenedBlob&&) = default;

    std::vector<std::byte> bytes;
    Blob blob;
};

std::vector<OpenedBlob> opened_blobs(const std::vector<Mesh>& meshes, const BakeOptions& options = {});

}  // namespace espalier::tests
