#include "baking.hpp"

#include <stdexcept>
#include <utility>

namespace espalier::tests {

std::vector<std::byte> bake_or_throw(const Mesh& mesh, const BakeOptions& options) {
    const MeshView view = mesh.view();
    auto baked = bake(std::span(&view, 1), options);
    if (!baked) throw std::runtime_error("bake of " + mesh.name + ": " + baked.message);
    return std::move(baked.bytes);
}

OpenedBlob::OpenedBlob(std::vector<std::byte> blob_bytes) : bytes(std::move(blob_bytes)), blob(open(bytes)) {
    if (!blob) throw std::runtime_error(std::string("open: ") + describe(blob.status()));
}

std::vector<OpenedBlob> opened_blobs(const std::vector<Mesh>& meshes, const BakeOptions& options) {
    std::vector<OpenedBlob> blobs;
    for (const Mesh& mesh : meshes) blobs.emplace_back(mesh, options);
    return blobs;
}

}  // namespace espalier::tests
