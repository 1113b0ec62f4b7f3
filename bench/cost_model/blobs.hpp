// The blobs that costs are measured on: a mesh in each profile, with leaves of several sizes.
#pragma once

#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/blob.hpp>

#include "../../tests/support/meshes/mesh.hpp"

namespace espalier::bench {

struct ProfileRun {
    const char* name;
    Profile profile;
    unsigned largest_leaf;
};
inline constexpr ProfileRun profiles[] = {{"fast", Profile::fast, format::plain_leaf::max_triangles},
                                          {"balanced", Profile::balanced, format::strip_leaf::max_balanced_entries - 2},
                                          {"small", Profile::small, format::strip_leaf::max_small_entries - 2},
                                          {"tiny", Profile::tiny, format::predicted_strip::max_entries - 2}};

/// Returns the names of all profiles.
std::vector<std::string> profile_names();
/// Returns the profiles with these names, or all where there are none.
std::vector<ProfileRun> chosen_profiles(const std::vector<std::string>& names);

/// Blobs of one mesh and profile with leaves of several sizes, which go into one fit: else nodes and triangles grow
/// together, and their costs cannot be told apart.
class BlobsOfMesh {
public:
    /// Throws std::runtime_error with the mesh's name.
    BlobsOfMesh(const tests::Mesh& mesh, const ProfileRun& profile, unsigned bits);
    [[nodiscard]] const std::vector<Blob>& blobs() const { return blobs_; }

private:
    std::vector<BakeResult> baked_;  ///< the blobs point into them
    std::vector<Blob> blobs_;
};

}  // namespace espalier::bench
