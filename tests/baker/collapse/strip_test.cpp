// Claims about strips: whatever the triangles of a leaf have to do with one another, each is there once, wound as it
// was, and the marks say no more than they must.
#include "support/testing.hpp"

#include <baker/build/sah.hpp>
#include <baker/collapse/leaf_size.hpp>
#include <baker/collapse/strip.hpp>

#include "baker/baking_support.hpp"
#include "support/answers/differences.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/strip_shapes.hpp"

namespace espalier::tests::strip_test {
namespace {

baker::LatticeMesh lattice_mesh_of(const Mesh& mesh) {
    baker::LatticeMesh result;
    result.lattice.bits = 16;
    for (const Vec3& point : mesh.positions) {
        const auto steps = [](float coordinate) { return static_cast<std::int32_t>(coordinate * 256.0f); };
        result.vertices.push_back({steps(point.x), steps(point.y), steps(point.z)});
    }
    for (const TriangleVertices& triangle : mesh.triangles) {
        result.triangles.push_back({triangle, static_cast<std::uint32_t>(result.triangles.size())});
    }
    return result;
}

/// Reads a strip as docs/format.md says and checks each triangle against the one that it stands for.
void check_strip(const baker::Strip& strip, const baker::LatticeMesh& mesh, const baker::BinaryTree& tree,
                 const baker::BinaryNode& node) {
    REQUIRE(strip.triangle_count == node.count);
    REQUIRE(strip.entry_count <= format::max_leaf_vertices);
    const unsigned windows = strip.entry_count - 2;
    REQUIRE((strip.pivots & 1) == 1);
    REQUIRE((strip.windows & 1) == 1);
    REQUIRE(std::bit_width(strip.windows) == static_cast<int>(windows));  // the last one is a triangle
    REQUIRE(std::bit_width(strip.pivots) <= static_cast<int>(windows));
    std::set<std::uint32_t> places;
    unsigned found = 0, pivot = 0, pivots = 0;
    unsigned paths = 1;
    for (unsigned window = 0; window < windows; ++window) {
        if ((strip.pivots >> window & 1) != 0) {
            pivot = window;
            ++pivots;
        }
        if ((strip.windows >> window & 1) == 0) {
            // Two windows lie between one path and the next.
            if ((strip.windows >> (window - 1) & 1) == 0) ++paths;
            continue;
        }
        const bool keeps_order = pivots % 2 == 1;
        const std::uint32_t corners[3] = {strip.entries[pivot], strip.entries[window + (keeps_order ? 1 : 2)],
                                          strip.entries[window + (keeps_order ? 2 : 1)]};
        const auto [place, first_corner] = strip.triangles[found++];
        REQUIRE(place >= node.first);
        REQUIRE(place < node.first + node.count);
        REQUIRE(places.insert(place).second);
        const auto& meant = mesh.triangles[tree.triangles[place]].corners;
        for (unsigned corner = 0; corner < 3; ++corner) REQUIRE(corners[corner] == meant[(first_corner + corner) % 3]);
    }
    REQUIRE(found == strip.triangle_count);
    REQUIRE(strip.entry_count == strip.triangle_count + 2 * paths);
}

/// Every part of the tree that could become a leaf; returns the entries of the whole, or 0 when that is too large.
unsigned check_strips_of(const Mesh& mesh) {
    CAPTURE(mesh.name);
    const baker::LatticeMesh lattice_mesh = lattice_mesh_of(mesh);
    const baker::BinaryTree tree = baker::build_sah(lattice_mesh, baker::build_settings(Effort::normal, 1));
    const baker::StripMaker maker(lattice_mesh, tree);
    unsigned entries_of_all = 0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const baker::BinaryNode& node = tree.nodes[i];
        if (node.count > format::max_leaf_triangles) continue;
        const unsigned entries = maker.entries_of(node);
        REQUIRE(entries >= node.count + 2);
        REQUIRE(entries <= 3 * node.count);
        if (entries > format::max_leaf_vertices) continue;
        const baker::Strip strip = maker.make(node);
        REQUIRE(strip.entry_count == entries);
        check_strip(strip, lattice_mesh, tree, node);
        if (i == 0) entries_of_all = entries;
    }
    return entries_of_all;
}

/// Bytes are dear: as few leaves as the profile allows.
BakeOptions with_large_leaves(Profile profile, unsigned bits) {
    BakeOptions options = with_profile(profile, with_bits(bits));
    options.original_ids = true;
    options.build.byte_price = 1000.0f;
    return options;
}

TEST_CASE("strip: a strip holds each triangle once with its winding and within two entries for each") {
    for (const Mesh& mesh : strip_shapes()) check_strips_of(mesh);
    for (const Mesh& mesh : {make_icosphere(3, 100.0, {100, 100, 100}), make_torus(30, 12, 60.0, 20.0),
                             make_terrain(20, 4), make_soup(300, 8), make_coplanar_stacks(300, 5), make_needle_fan(300),
                             make_uv_sphere(12, 40, 100.0, {100, 100, 100})}) {
        check_strips_of(mesh);
    }
}

TEST_CASE("strip: a fan or band becomes one path and separate triangles one path each") {
    CHECK(check_strips_of(make_fan(50, false)) == 50 + 2);
    CHECK(check_strips_of(make_fan(50, true)) == 50 + 2);
    CHECK(check_strips_of(make_band(50, false)) == 50 + 2);
    CHECK(check_strips_of(make_band(50, true)) == 50 + 2);
    CHECK(check_strips_of(make_disjoint(18)) == 3 * 18);
}

TEST_CASE("strip: a triangle that meets another from the same side is no neighbour") {
    // Three triangles run up the edge and two run down: two pairs and one alone.
    Mesh mesh = {.name = "book",
                 .positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {2, 1, 0}},
                 .triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 5}, {1, 0, 6}}};
    CHECK(check_strips_of(mesh) == 5 + 2 * 3);
}

TEST_CASE("strip: shapes hard on strips bake to sound blobs that keep every corner of the source") {
    for (const Mesh& mesh : strip_shapes()) {
        CAPTURE(mesh.name);
        for_each_profile([&](Profile profile) {
            for (const unsigned bits : {10u, 16u, 24u}) {
                CAPTURE(bits);
                const auto result = must_bake_mesh(mesh, with_large_leaves(profile, bits));
                require_sound(result.bytes);
                const DecodedBlob decoded = decode(result.bytes);
                CHECK(std::set(decoded.original_ids.begin(), decoded.original_ids.end()).size() ==
                      decoded.triangles.size());
                require_corners_of_source(decoded, mesh);
            }
        });
    }
}

TEST_CASE("strip: shapes hard on strips equal the loop on every instruction set") {
    for (const Mesh& mesh : strip_shapes()) {
        CAPTURE(mesh.name);
        for (const Profile profile : {Profile::balanced, Profile::small, Profile::tiny}) {
            CAPTURE(name_of(profile));
            for (const unsigned bits : {12u, 24u}) {
                const OpenedBlob opened(mesh, with_large_leaves(profile, bits));
                const DecodedBlob decoded = decode(opened.bytes);
                const TriangleLoop loop(decoded);
                QueryMaker maker(decoded, 700 + bits);
                std::uint64_t hits = 0;
                for (std::uint64_t i = 0; i < scaled(60); ++i) {
                    require_none(ray_difference(opened.blob, loop, maker.any_ray(), hits));
                    require_none(sphere_difference(opened.blob, loop, maker.sphere(), hits));
                }
                CHECK(hits > 0);
            }
        }
    }
}

TEST_CASE("strip: a fan of 50 triangles is one leaf whose pivot serves more windows than lanes") {
    const auto result = must_bake_mesh(make_fan(50, false), with_large_leaves(Profile::small, 16));
    const DecodedBlob decoded = decode(result.bytes);
    REQUIRE(decoded.triangles_in_leaf.size() == 1);
    CHECK(decoded.triangles_in_leaf[0] == 50);
    const std::size_t descriptor =
        format::header::bytes + format::packed_node::bytes + format::strip_leaf::descriptors_at;
    const std::size_t marks = descriptor + format::strip_leaf::descriptor_bytes;
    unsigned pivots = 0;
    for (unsigned entry = 0; entry < 49; ++entry) {
        pivots += std::to_integer<unsigned>(result.bytes[marks + entry / 8]) >> (entry % 8) & 1u;
    }
    CHECK(pivots <= 2);
}

TEST_CASE("strip: of strips with equally many entries it is the one in the order of the source") {
    // Around its center a closed fan can be cut anywhere.
    for (std::size_t cut = 0; cut < 7; ++cut) {
        CAPTURE(cut);
        Mesh mesh = make_fan(7, true);
        std::rotate(mesh.triangles.begin(), mesh.triangles.begin() + static_cast<std::ptrdiff_t>(cut),
                    mesh.triangles.end());
        BakeOptions options = with_large_leaves(Profile::small, 16);
        options.original_ids = true;
        const auto result = must_bake_mesh(mesh, options);
        std::vector<std::uint32_t> ids = decode(result.bytes).original_ids;
        REQUIRE(ids.size() == 7);
        if (ids[0] != 0) std::reverse(ids.begin(), ids.end());
        CHECK(ids == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6});
    }
}

TEST_CASE("strip: leaves reach the largest size of each profile and never exceed it") {
    const Mesh mesh = make_terrain(60, 3);
    for_each_profile([&](Profile profile) {
        const unsigned most = profile == Profile::fast       ? format::plain_leaf::max_triangles
                              : profile == Profile::balanced ? format::strip_leaf::max_balanced_entries - 2
                              : profile == Profile::small    ? format::strip_leaf::max_small_entries - 2
                                                             : format::predicted_strip::max_entries - 2;
        const auto result = must_bake_mesh(mesh, with_large_leaves(profile, 16));
        const DecodedBlob decoded = decode(result.bytes);
        const unsigned largest = *std::max_element(decoded.triangles_in_leaf.begin(), decoded.triangles_in_leaf.end());
        CHECK(largest <= most);
        CHECK(largest >= most * 3 / 4);
    });
}

}  // namespace
}  // namespace espalier::tests::strip_test
