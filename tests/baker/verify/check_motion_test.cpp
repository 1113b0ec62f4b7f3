// Claims about verify on deformable blobs: each thing that it promises to find is planted and found.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::check_motion_test {
namespace {

namespace at = format::header;

std::string verdict(Bytes blob) {
    repair_checksum(blob);
    return verify(blob).message;
}

Bytes with(Bytes bytes, std::size_t place, std::uint64_t value, unsigned size) {
    put(bytes, place, value, size);
    return bytes;
}

std::size_t corners_of(const Bytes& bytes) {
    return leaves_of(bytes) + get(bytes, at::leaf_bytes_at, 4) + format::guard_bytes;
}
std::size_t sources_of(const Bytes& bytes) {
    return corners_of(bytes) +
           format::corners::padded_bytes(static_cast<std::uint32_t>(get(bytes, at::triangle_count_at, 4))) +
           format::corners::guard_bytes;
}

TEST_CASE("verify: deformable blobs are sound in every pose") {
    for (const Mesh& mesh : {make_plane_grid(12), make_soup(150, 2), make_torus(14, 9, 2.0, 0.7)})
        for (const unsigned bits : {4u, 16u, 22u}) {
            DeformedMesh moving(mesh, bits);
            CHECK(verdict(moving.baked) == "");
            for (const Motion motion : every_motion) {
                moving.move_to(posed(mesh, motion));
                CHECK(verdict(moving.sealed()) == "");
            }
        }
}

TEST_CASE("verify: a box of a deformable blob that is not the least is found") {
    DeformedMesh moving(make_plane_grid(12), 14);
    moving.move_to(posed(moving.mesh, Motion::wave));
    const Bytes good = moving.sealed();
    const DecodedBlob decoded = decode(good);
    const NodeLayout layout = layout_of(Profile::fast);
    for (std::size_t node = 0; node < decoded.nodes.size(); ++node)
        for (std::size_t child = 0; child < decoded.nodes[node].children.size(); ++child)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t low = node_of(good, node) + layout.lo_at + layout.row_bytes * k + 2 * child;
                const std::size_t high = node_of(good, node) + layout.hi_at + layout.row_bytes * k + 2 * child;
                CHECK(verdict(with(good, high, get(good, high, 2) + 1, 2)) != "");
                if (get(good, low, 2) != 0) CHECK(verdict(with(good, low, get(good, low, 2) - 1, 2)) != "");
            }
}

TEST_CASE("verify: a position that leaves have at different places is found") {
    const DeformedMesh moving(make_plane_grid(12), 14);
    const Bytes& good = moving.baked;
    const std::size_t sources = sources_of(good);
    const std::uint64_t slots = get(good, at::vertex_slots_at, 4);
    std::size_t found = 0;
    for (std::size_t slot = 0; slot < slots; ++slot) {
        const std::uint64_t position = get(good, sources + 2 * slot, 2);
        const std::string message = verdict(with(good, sources + 2 * slot, position == 0 ? 1 : 0, 2));
        CHECK(message != "");
        found += contains(message, "elsewhere than another leaf") ? 1u : 0u;
    }
    CHECK(found > slots / 2);
}

TEST_CASE("verify: wrong counts and flags and boxes of a pose are found") {
    const DeformedMesh moving(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), 14);
    const Bytes& good = moving.baked;
    const auto field = [&](std::size_t place) { return get(good, place, 4); };
    CHECK(contains(verdict(with(good, at::vertex_count_at, field(at::vertex_count_at) + 1, 4)), "vertices, but"));
    CHECK(contains(verdict(with(good, at::features_at, field(at::features_at) ^ format::feature::closed, 4)),
                   "edges cancel"));
    CHECK(contains(verdict(with(good, at::max_error_at, field(at::max_error_at) - 1, 4)), "largest error"));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t low = at::pose_low_at + 4 * k, high = at::pose_high_at + 4 * k;
        CHECK(contains(verdict(with(good, low, field(low) - 1, 4)), "of the pose goes from"));
        CHECK(contains(verdict(with(good, high, field(high) + 1, 4)), "of the pose goes from"));
    }
}

TEST_CASE("verify: corners of a deformable blob that are out of order or repeat a triangle are found") {
    const DeformedMesh moving(make_plane_grid(12), 14);
    const Bytes& good = moving.baked;
    const std::size_t corners = corners_of(good);
    CHECK(contains(verdict(with(good, corners, 1, 1)), "before those numbered lower"));
    const DecodedBlob decoded = decode(good);
    const std::size_t count = decoded.triangles_in_leaf.front();
    REQUIRE(count > 1);
    Bytes twice = good;
    for (std::size_t row = 0; row < 3; ++row)
        put(twice, corners + row * count + 1, get(good, corners + row * count, 1), 1);
    CHECK(verdict(twice) != "");
}

}  // namespace
}  // namespace espalier::tests::check_motion_test
