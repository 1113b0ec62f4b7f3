// Blobs to break, for tests of the verifier's rules.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests::opening {

namespace at = format::header;
namespace feature = format::feature;
inline Bytes plain_blob(Profile profile) {
    return bake_or_throw(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}), with_profile(profile));
}

/// Of three sources with a triangle each.
inline Bytes three_sources(Profile profile) {
    std::array<Mesh, 3> meshes = {make_cube(0.0f, 1.0f), make_cube(2.0f, 3.0f), make_cube(4.0f, 5.0f)};
    std::vector<MeshView> views;
    for (Mesh& mesh : meshes) {
        mesh.triangles.resize(1);
        views.push_back(mesh.view());
    }
    auto baked = bake(views, {.profile = profile, .original_ids = true});
    REQUIRE(baked);
    return baked.bytes;
}

inline Bytes without(Bytes bytes, std::size_t first, std::size_t count) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
    bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return bytes;
}

}  // namespace espalier::tests::opening
