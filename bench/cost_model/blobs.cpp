#include "blobs.hpp"

#include <stdexcept>
#include <utility>

namespace espalier::bench {

BlobsOfMesh::BlobsOfMesh(const tests::Mesh& mesh, const ProfileRun& profile, unsigned bits) {
    const MeshView view = mesh.view();
    for (const unsigned divisor : {4u, 2u, 1u}) {
        BakeOptions options;
        options.resolution = Resolution::bits(bits);
        options.profile = profile.profile;
        options.build.max_leaf_triangles = profile.largest_leaf / divisor;
        BakeResult baked = bake({&view, 1}, options);
        if (!baked) throw std::runtime_error(mesh.name + ": " + baked.message);
        baked_.push_back(std::move(baked));
        const Blob blob = open(baked_.back().bytes);
        if (!blob) throw std::runtime_error(mesh.name + ": " + describe(blob.status()));
        blobs_.push_back(blob);
    }
}

}  // namespace espalier::bench
