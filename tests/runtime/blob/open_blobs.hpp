// Blobs to break, for tests of the verifier's rules.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <vector>

#include <espalier/espalier.hpp>

#include "support/base/profiles.hpp"
#include "support/blobs/baking.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::tests::opening {

namespace at = format::header;
namespace feature = format::feature;
using Bytes = std::vector<std::byte>;

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
    BakeOptions options = with_profile(profile);
    options.original_ids = true;
    auto baked = bake(views, options);
    REQUIRE(baked);
    return baked.bytes;
}

inline Bytes without(Bytes bytes, std::size_t first, std::size_t count) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(first);
    bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    return bytes;
}

}  // namespace espalier::tests::opening
