// Claims about verify: each thing that it promises to find is planted and found.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"

namespace espalier::tests::verify_test {
namespace {

std::string verdict(std::vector<std::byte> blob) {
    repair_checksum(blob);
    return verify(blob).message;
}

void add_to(std::vector<std::byte>& blob, std::size_t at, int by) {
    blob[at] = static_cast<std::byte>(std::to_integer<int>(blob[at]) + by);
}

TEST_CASE("verify: baked blobs and the empty blob are sound") {
    for_each_profile([](Profile profile) {
        CHECK(verdict(bake_or_throw(make_terrain(20, 1), with_profile(profile))) == "");
        CHECK(verdict(bake_or_throw(make_soup(200, 2), with_profile(profile))) == "");
        CHECK(verdict(bake({}, with_profile(profile)).bytes) == "");
    });
}

TEST_CASE("verify: bytes that are no blob are refused with a reason") {
    CHECK(!verify({}));
    CHECK(!verify({}).message.empty());
    auto blob = bake_or_throw(make_cube(0.0f, 1.0f));
    blob[200] ^= std::byte{1};
    CHECK(contains(verify(blob).message, "checksum"));
}

TEST_CASE("verify: a box that is too small is found and named with node and byte") {
    for_each_profile([](Profile profile) {
        const auto good = bake_or_throw(make_terrain(30, 1), with_profile(profile));
        const DecodedBlob decoded = decode(good);
        unsigned found = 0;
        for (std::size_t node = 0; node < decoded.nodes.size(); ++node) {
            const NodeLayout layout = layout_of(profile);
            for (std::size_t plane = 0; plane < 3 * layout.max_children; plane += 5) {
                const std::size_t at = node_of(good, node) + layout.hi_at + layout.plane_bytes * plane;
                if (plane % layout.max_children >= decoded.nodes[node].children.size() ||
                    std::to_integer<int>(good[at]) < 2)
                    continue;
                auto bad = good;
                add_to(bad, at, -2);  // two planes lower: below what outward rounding may have left
                const std::string message = verdict(bad);
                if (!contains(message, "does not hold what is below")) continue;
                ++found;
                CHECK(contains(message,
                               "node " + std::to_string(node) + " (byte " + std::to_string(node_of(good, node)) + ")"));
            }
        }
        CHECK(found > decoded.nodes.size());
    });
}

TEST_CASE("verify: a wrong vertex count and extent and closed flag are found") {
    for_each_profile([](Profile profile) {
        namespace header = format::header;
        const auto good = bake_or_throw(make_icosphere(2, 1.0, {0, 0, 0}), with_profile(profile));
        auto bad = good;
        add_to(bad, header::vertex_count_at, 1);
        CHECK(contains(verdict(bad), "counts"));
        bad = good;
        add_to(bad, header::features_at, -static_cast<int>(format::feature::closed));
        CHECK(contains(verdict(bad), "it is closed"));
        bad = bake_or_throw(make_terrain(4, 1), with_profile(profile));
        add_to(bad, header::features_at, static_cast<int>(format::feature::closed));
        CHECK(contains(verdict(bad), "it is not"));
        bad = bake_or_throw(make_cube(0.0f, 200.0f), with_profile(profile, with_bits(8)));
        add_to(bad, header::extent_at, 1);
        CHECK(contains(verdict(bad), "axis 0"));
    });
}

TEST_CASE("verify: a triangle without area and a duplicate are found") {
    // One leaf of two triangles: a byte for each corner, behind two for each coordinate of the four vertices.
    Mesh quad = {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}, {0, 2, 3}}};
    const auto good = bake_or_throw(quad, with_profile(Profile::fast, with_bits(1)));
    const DecodedBlob decoded = decode(good);
    REQUIRE(decoded.triangles.size() == 2);
    const std::size_t data = leaf_data_of(good, format::header::bytes, 0) + format::plain_leaf::words_at;
    using Triangle = std::array<unsigned, 3>;
    const auto with_corners = [&](const Triangle& first, const Triangle& second) {
        auto bad = good;
        for (std::size_t i = 0; i < 3; ++i) {
            bad[data + 24 + 2 * i] = static_cast<std::byte>(first[i]);
            bad[data + 24 + 2 * i + 1] = static_cast<std::byte>(second[i]);
        }
        return bad;
    };
    const auto corners = [](unsigned a, unsigned b, unsigned c) { return Triangle{a, b, c}; };
    CHECK(verdict(with_corners(corners(0, 1, 2), corners(0, 2, 3))) == "");
    CHECK(contains(verdict(with_corners(corners(0, 1, 2), corners(0, 3, 3))), "triangle 1 (leaf data at byte "));
    CHECK(contains(verdict(with_corners(corners(0, 1, 2), corners(0, 3, 3))), "has no area"));
    CHECK(contains(verdict(with_corners(corners(0, 1, 2), corners(1, 2, 0))), "is the same as triangle 0"));
    CHECK(contains(verdict(with_corners(corners(0, 2, 1), corners(0, 2, 3))), "numbered lower"));
    CHECK(contains(verdict(with_corners(corners(0, 1, 2), corners(0, 2, 1))), "none uses"));
}

TEST_CASE("verify: an unused vertex of a strip and a strip triangle without area are found") {
    const std::size_t marks_at = format::header::bytes + format::packed_node::bytes +
                                 format::strip_leaf::descriptors_at + format::strip_leaf::descriptor_bytes;
    // Three triangles over five vertices: the marks are two bits each of pivots, windows and first uses.
    Mesh fan = {.positions = {{0, 0, 0}, {4, 0, 0}, {3, 3, 0}, {0, 4, 0}, {-3, 3, 0}},
                .triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}};
    const auto good = bake_or_throw(fan, with_profile(Profile::balanced, with_bits(3)));
    const DecodedBlob decoded = decode(good);
    REQUIRE(decoded.triangles.size() == 3);
    REQUIRE((std::to_integer<unsigned>(good[marks_at]) & ~15u) == 0b110000);  // five first uses
    const auto with_marks = [&](unsigned marks, unsigned triangles) {
        auto bad = good;
        bad[marks_at] = static_cast<std::byte>(marks);
        bad[format::header::triangle_count_at] = static_cast<std::byte>(triangles);
        return verdict(bad);
    };
    const auto marks = std::to_integer<unsigned>(good[marks_at]);
    CHECK(with_marks(marks, 3) == "");
    CHECK(contains(with_marks(marks & ~0b1000u, 2), "vertices that none uses"));  // the last window is none

    // A path around a tetrahedron: three bits each, then the last two entries' vertices in two bits each.
    Mesh tetrahedron = {.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}},
                        .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    auto bad = bake_or_throw(tetrahedron, with_profile(Profile::balanced, with_bits(3)));
    CHECK(verdict(bad) == "");
    const unsigned high = std::to_integer<unsigned>(bad[marks_at + 1]);
    const unsigned fourth = high >> 1 & 3u;
    const unsigned fifth = high >> 3 & 3u;
    REQUIRE(fifth != fourth);
    bad[marks_at + 1] = static_cast<std::byte>((high & ~(3u << 3)) | fourth << 3);
    CHECK(contains(verdict(bad), "triangle 3 (leaf data at byte "));
    CHECK(contains(verdict(bad), "has no area"));
}

}  // namespace
}  // namespace espalier::tests::verify_test
