#include "baking.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace espalier::tests {

std::vector<std::byte> bake_or_throw(const Mesh& mesh, const BakeOptions& options) {
    const MeshView view = mesh.view();
    auto baked = bake(std::span(&view, 1), options);
    if (!baked) throw std::runtime_error("bake of " + mesh.name + ": " + baked.error().message);
    return std::move(baked->blob);
}

OpenedBlob::OpenedBlob(std::vector<std::byte> blob_bytes) : bytes(std::move(blob_bytes)) {
    const Status status = open(bytes, blob);
    if (status != Status::ok) throw std::runtime_error(std::string("open: ") + describe(status));
}

}  // namespace espalier::tests
