#include "test_blobs.hpp"

#include <utility>

#include "support/base/profiles.hpp"
#include "support/meshes/makers.hpp"

namespace espalier::tests {

namespace {

enum class Extras { none, edge_flags_and_bounds };

void add(std::vector<TestBlob>& blobs, const Mesh& mesh, unsigned bits, Extras extras = Extras::none) {
    for (const Profile profile : every_profile) {
        BakeOptions options = {.resolution = Resolution::bits(bits), .profile = profile};
        if (extras == Extras::edge_flags_and_bounds) {
            options.flat_angle = 5.0;
            options.bounds = {true, true, true};
        }
        OpenedBlob opened(mesh, options);
        DecodedBlob decoded = decode(opened.bytes);
        blobs.push_back({mesh.name + ", " + std::to_string(bits) + " bits, profile " + name_of(profile),
                         std::move(opened), std::move(decoded)});
    }
}

}  // namespace

const std::vector<TestBlob>& small_test_blobs() {
    static const std::vector<TestBlob> blobs = [] {
        std::vector<TestBlob> made;
        add(made, make_cube(-1.0f, 1.0f), 16);
        add(made, make_cube(0.0f, 1.0f), 1, Extras::edge_flags_and_bounds);
        add(made, make_icosphere(2, 1.0, {0.5f, -3.0f, 0.25f}), 16, Extras::edge_flags_and_bounds);
        add(made, make_icosphere(2, 100.0, {0.0f, 0.0f, 0.0f}), 24, Extras::edge_flags_and_bounds);
        add(made, make_uv_sphere(12, 20, 1.0, {0.0f, 0.0f, 0.0f}), 7);
        add(made, scaled_by(make_torus(24, 12, 2.0, 0.7), 0x1p-20f), 12);
        add(made, make_plane_grid(14), 16);
        add(made, scaled_by(make_terrain(20, 7), 0x1p20f), 20, Extras::edge_flags_and_bounds);
        add(made, make_needle_fan(300), 16);
        add(made, make_slivers(400, 3), 18);
        add(made, make_coplanar_stacks(300, 5), 8, Extras::edge_flags_and_bounds);
        add(made, make_soup(500, 9), 16);
        add(made, make_soup(2, 10), 3);
        return made;
    }();
    return blobs;
}

const std::vector<TestBlob>& medium_test_blobs() {
    static const std::vector<TestBlob> blobs = [] {
        std::vector<TestBlob> made;
        add(made, make_far_sphere(), 16);
        add(made, make_torus(80, 40, 2.0, 0.5), 16, Extras::edge_flags_and_bounds);
        add(made, make_terrain(50, 11), 16);
        add(made, make_soup(4'000, 13), 24);
        add(made, make_coplanar_stacks(3'000, 15), 16);
        add(made, make_needle_fan(3'000), 20);
        add(made, make_uv_sphere(40, 60, 1000.0, {-50.0f, 20.0f, 3000.0f}), 14);
        return made;
    }();
    return blobs;
}

std::vector<std::byte> make_blob_with_every_section(Profile profile) {
    Mesh mesh = make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f});
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(i);
    return bake_or_throw(mesh, with_every_section(profile));
}

}  // namespace espalier::tests
