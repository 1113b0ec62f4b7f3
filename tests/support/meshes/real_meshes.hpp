// A claim about every mesh that is there to be read, mostly in each profile. Without any it says that it is skipped.
#pragma once

#include <doctest/doctest.h>

#include <cstddef>

#include "files.hpp"
#include "support/base/profiles.hpp"

namespace espalier::tests {

/// Baking more than that takes longer than asking what is baked: some claims leave such meshes out.
inline constexpr std::size_t quickly_baked = 200'000;

/// Calls `check(mesh)`. Meshes of more triangles are left out, and named.
template <class Check>
void for_each_mesh_read(Check check, std::size_t most_triangles = ~std::size_t{0}) {
    bool is_skipped = true;
    for (const auto& file : mesh_files()) {
        const Mesh mesh = read_mesh(file);
        CAPTURE(mesh.name);
        if (mesh.triangles.size() > most_triangles) {
            MESSAGE("left out: more than ", most_triangles, " triangles");
            continue;
        }
        check(mesh);
        is_skipped = false;
    }
    if (is_skipped) MESSAGE("SKIPPED: no .obj or .ply file, or none small enough, in the folder ESPALIER_MESHES");
}

/// Calls `check(mesh, profile)`.
template <class Check>
void for_each_real_mesh(Check check, std::size_t most_triangles = ~std::size_t{0}) {
    for_each_mesh_read([&](const Mesh& mesh) { for_each_profile([&](Profile profile) { check(mesh, profile); }); },
                       most_triangles);
}

}  // namespace espalier::tests
