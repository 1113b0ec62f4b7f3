#include "blobs.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace espalier::bench {

std::vector<std::string> profile_names() {
    std::vector<std::string> names;
    for (const ProfileRun& profile : profiles) names.emplace_back(profile.name);
    return names;
}

std::vector<ProfileRun> chosen_profiles(const std::vector<std::string>& names) {
    std::vector<ProfileRun> chosen;
    for (const ProfileRun& profile : profiles)
        if (names.empty() || std::find(names.begin(), names.end(), profile.name) != names.end())
            chosen.push_back(profile);
    return chosen;
}

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
