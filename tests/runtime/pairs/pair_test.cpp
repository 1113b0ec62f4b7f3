// Claims about two blobs as the header words them; loop_test.cpp compares them with the loop.
#include "support/testing.hpp"

#include "contacts.hpp"
#include "support/queries/placement_maker.hpp"

namespace espalier::tests::pair_test {
namespace {

/// A triangle mesh of its own is a mesh of one triangle.
bool touch(const Blob& a, const Blob& b, const Transform& placement) {
    const YesNo answer = overlaps(a, {b, placement}, unlimited);
    REQUIRE((answer.yes() || answer.no()));
    return answer.yes();
}

TEST_CASE("pair: the first in storage of two equally near leaves is met first") {
    Mesh pair = make_triangle({16, -16, -1}, {24, -16, 1}, {16, -24, 1});
    append_triangle(pair, {-16, 16, -1}, {-16, 24, 1}, {-24, 16, 1});
    const BakeOptions options = {
        .resolution = Resolution::bits(12), .profile = Profile::fast, .build = {.max_leaf_triangles = 1}};
    const OpenedBlob a(pair, options);
    const OpenedBlob b(make_triangle({-100, -100, 0}, {100, -100, 0}, {-100, 100, 0}), options);
    const PairContact expected = {{0}, {0}, QueryStatus::ok};
    CHECK(first_contact(a.blob, b.blob, unlimited) == expected);
    CHECK(all_contacts(a.blob, b.blob) == Contacts{expected, {{1}, {0}, QueryStatus::ok}});
}

TEST_CASE("pair: touching counts to the last step of the grid") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    const Blob& blob = cube.blob;
    // A grid step is 2^-6 of a lattice step, which is 2^-16 here; 24 bits hold both cubes.
    const float step = std::ldexp(1.0f, blob.lattice().step_exponent) * 0x1p-6f;
    CHECK(touch(blob, blob, {{}, {1.0f, 0.0f, 0.0f}, 1.0f}));
    CHECK(touch(blob, blob, {{}, {1.0f, 1.0f, 1.0f}, 1.0f}));
    CHECK_FALSE(touch(blob, blob, {{}, {1.0f + step, 0.0f, 0.0f}, 1.0f}));
    CHECK_FALSE(touch(blob, blob, {{}, {-1.0f, 0.25f, -1.0f - step}, 1.0f}));
    // The triangles are a surface: a cube inside a cube touches nothing.
    CHECK_FALSE(touch(blob, blob, {{}, {0.25f, 0.25f, 0.25f}, 0.5f}));
    CHECK(touch(blob, blob, {{}, {0.5f, 0.25f, 0.25f}, 0.5f}));
    CHECK(touch(blob, blob, {{0.0f, 0.0f, 1.0f, 1.0f}, {2.0f, 0.0f, 0.0f}, 1.0f}));
}

TEST_CASE("pair: distances and witnesses of boxes match hand-computed values") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    const PlacedBlob aside(cube.blob, {{}, {4.0f, 5.0f, 13.0f}, 1.0f});
    const BlobDistance nearest = distance(cube.blob, aside, unlimited, 100.0f);
    CHECK(nearest.distance == 13.0f);
    CHECK(nearest.on_a == Vec3{1.0f, 1.0f, 1.0f});
    CHECK(nearest.on_b == Vec3{4.0f, 5.0f, 13.0f});
    const float less = std::nextafter(13.0f, 0.0f);
    const BlobDistance none = distance(cube.blob, aside, unlimited, less);
    CHECK(none.status == QueryStatus::not_found);
    CHECK_FALSE(none);
    CHECK(none.distance == std::numeric_limits<float>::infinity());
    CHECK(none.a == no_triangle);
    CHECK(none.b == no_triangle);
    CHECK(within_distance(cube.blob, aside, 13.0f, unlimited).yes());
    CHECK(within_distance(cube.blob, aside, less, unlimited).no());
    // A scale of 2 and a quarter turn: the cube [0, 2] x [-2, 0] x [0, 2], 3 below.
    const PlacedBlob below(cube.blob, {{0.0f, 0.0f, -1.0f, 1.0f}, {0.0f, -3.0f, 0.0f}, 2.0f});
    CHECK(distance(cube.blob, below, unlimited).distance == 3.0f);
}

TEST_CASE("pair: two placed blobs have distances and witnesses in world space") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    // [10, 14] x [20, 24] x [-4, 0], and the unit cube on the other side of x = 0.
    const PlacedBlob a(cube.blob, {{0.0f, 1.0f, 0.0f, 1.0f}, {10.0f, 20.0f, 0.0f}, 4.0f});
    const PlacedBlob b(cube.blob, {{0.0f, 0.0f, 1.0f, 0.0f}, {0.0f, 20.5f, -2.0f}, 1.0f});
    const BlobDistance nearest = distance(a, b, unlimited);
    CHECK(nearest.distance == 10.0f);
    CHECK(nearest.on_a.x == 10.0f);
    CHECK(nearest.on_b.x == 0.0f);
    CHECK(nearest.on_a.y == nearest.on_b.y);
    CHECK(nearest.on_a.z == nearest.on_b.z);
    CHECK(within_distance(a, b, 10.0f, unlimited).yes());
    CHECK(within_distance(a, b, 9.999f, unlimited).no());
    CHECK(overlaps(a, b, unlimited).no());
    CHECK(overlaps(a, {cube.blob, {{}, {13.5f, 23.5f, -0.5f}, 1.0f}}, unlimited).yes());
}

TEST_CASE("pair: moving both blobs by one rigid motion keeps their contacts") {
    const OpenedBlob sphere(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
    const Transform b_in_a = {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 0.75f};
    const Contacts expected = all_contacts(sphere.blob, {sphere.blob, b_in_a});
    CHECK(expected.size() > 20);
    // A quarter turn, a scale and a translation whose products floats hold exactly.
    const Transform both = {{0.0f, 0.0f, 1.0f, 1.0f}, {16.0f, -32.0f, 8.0f}, 2.0f};
    const Transform moved = {{-0.1f, 0.3f, 1.3f, 0.7f}, to_world(both, b_in_a.translation), 1.5f};
    CHECK(all_contacts({sphere.blob, both}, {sphere.blob, moved}) == expected);
}

TEST_CASE("pair: surfaces that pierce each other have distance 0 and one common witness") {
    const OpenedBlob flat(make_triangle({0.0f, 0.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}));
    const OpenedBlob upright(make_triangle({1.0f, 1.0f, -1.0f}, {1.0f, 1.0f, 3.0f}, {9.0f, 9.0f, 9.0f}));
    const BlobDistance nearest = distance(flat.blob, upright.blob, unlimited, 0.0f);
    CHECK(nearest);
    CHECK(nearest.distance == 0.0f);
    CHECK(std::abs(nearest.on_a.z) < 1e-4f);
    CHECK(std::abs(nearest.on_b.z) < 1e-4f);
    CHECK(std::abs(nearest.on_a.x - nearest.on_b.x) < 1e-4f);
}

TEST_CASE("pair: invalid calls are refused and a refusal is not a no") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    const Blob& blob = cube.blob;
    // The same for either blob, since the other one stands at the origin.
    const auto status = [&](const Transform& placement) {
        const YesNo answer = overlaps(blob, {blob, placement}, unlimited);
        CHECK(answer.no() == (answer.status() == QueryStatus::not_found));
        const YesNo exchanged = overlaps({blob, placement}, blob, unlimited);
        CHECK(is_refused(exchanged.status()) == is_refused(answer.status()));
        return answer.status();
    };
    CHECK(status({{0.0f, 0.0f, 0.0f, 0.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{0.0f, not_a_number, 0.0f, 1.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{0.0f, infinity, 0.0f, 1.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{}, {0.0f, 0.0f, -infinity}, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{}, {0.0f, not_a_number, 0.0f}, 1.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{}, {}, 0.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{}, {}, -1.0f}) == QueryStatus::invalid_argument);
    CHECK(status({{}, {}, not_a_number}) == QueryStatus::invalid_argument);
    CHECK(status({{}, {1e35f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::out_of_range);
    CHECK(status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::not_found);
    CHECK(overlaps(blob, {blob, {{}, {}, 1e35f}}, unlimited).status() == QueryStatus::out_of_range);
    CHECK(overlaps({blob, {{}, {}, 0x1p-101f}}, blob, unlimited).status() == QueryStatus::out_of_range);
    CHECK(overlaps({blob, {{}, {-3e38f, 0, 0}, 1}}, {blob, {{}, {3e38f, 0, 0}, 1}}, unlimited).status() ==
          QueryStatus::out_of_range);
    const auto distance_status = [&](const Transform& placement, float most) {
        const PlacedBlob other(blob, placement);
        const QueryStatus decided = within_distance(blob, other, most, unlimited).status();
        CHECK(distance(blob, other, unlimited, most).status == decided);
        return decided;
    };
    CHECK(distance_status({}, not_a_number) == QueryStatus::invalid_argument);
    CHECK(distance_status({}, -1.0f) == QueryStatus::invalid_argument);
    CHECK(distance_status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, infinity) == QueryStatus::out_of_range);
    CHECK(distance_status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, 6e9f) == QueryStatus::out_of_range);
    CHECK(distance_status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, 1.0f) == QueryStatus::not_found);
    // Subnormal components turn as well as any.
    const float tiny = std::numeric_limits<float>::denorm_min();
    CHECK(status({{0.0f, 0.0f, tiny, tiny}, {2.0f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::ok);
    CHECK(PairContact().status == QueryStatus::not_open);
    CHECK(BlobDistance().status == QueryStatus::not_open);
}

TEST_CASE("pair: a blob that was never opened is refused and one without triangles touches nothing") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    const OpenedBlob empty(Mesh{}, {});
    REQUIRE(empty.blob.triangle_count() == 0);
    const Blob never_opened;
    const Transform invalid = {{}, {}, not_a_number};
    const auto check = [](const PlacedBlob& a, const PlacedBlob& b, QueryStatus one, QueryStatus list) {
        PairContact page[1];
        CHECK(overlaps(a, b, unlimited).status() == one);
        CHECK(first_contact(a, b, unlimited).status == one);
        CHECK(distance(a, b, unlimited).status == one);
        CHECK(within_distance(a, b, 1.0f, unlimited).status() == one);
        CHECK(for_each_contact(
                  a, b, [](const PairContact&) {}, unlimited) == list);
        CHECK(collect_contacts(a, b, page, unlimited).status == list);
    };
    check(never_opened, cube.blob, QueryStatus::not_open, QueryStatus::not_open);
    check(cube.blob, never_opened, QueryStatus::not_open, QueryStatus::not_open);
    check(cube.blob, {never_opened, invalid}, QueryStatus::not_open, QueryStatus::not_open);
    check(empty.blob, cube.blob, QueryStatus::not_found, QueryStatus::ok);
    check(cube.blob, empty.blob, QueryStatus::not_found, QueryStatus::ok);
    check(cube.blob, {empty.blob, invalid}, QueryStatus::invalid_argument, QueryStatus::invalid_argument);
}

TEST_CASE("pair: blobs with duplicate references answer as those without") {
    const OpenedBlob split(make_soup(400, 21), with_copies());
    REQUIRE(split.blob.duplicate_reference_count() > 0);
    const OpenedBlob plain(make_soup(400, 21), with_profile(Profile::fast));
    const DecodedBlob split_decoded = decode(split.bytes);
    PlacementMaker maker(split_decoded, split_decoded, 77);
    std::size_t touching = 0;
    for (int i = 0; i < 60; ++i) {
        const Transform placement = i % 2 == 0 ? maker.random() : maker.adversarial();
        CAPTURE(describe(placement));
        const PlacedBlob split_b(split.blob, placement), plain_b(plain.blob, placement);
        const YesNo answer = overlaps(split.blob, plain_b, unlimited);
        REQUIRE(answer == overlaps(plain.blob, plain_b, unlimited));
        touching += answer.yes() ? 1u : 0u;
        const BlobDistance nearest = distance(split.blob, split_b, unlimited, 1e30f);
        const BlobDistance plain_nearest = distance(plain.blob, plain_b, unlimited, 1e30f);
        REQUIRE(nearest.status == plain_nearest.status);
        REQUIRE(nearest.distance == plain_nearest.distance);
        const auto is_owner = [&](TriangleId id) { return split_decoded.owners[id.index] == id.index; };
        if (nearest) REQUIRE((is_owner(nearest.a) && is_owner(nearest.b)));
        if (is_refused(answer.status())) continue;
        Contacts listed = all_contacts(split.blob, split_b);
        for (const PairContact& pair : listed) REQUIRE((is_owner(pair.a) && is_owner(pair.b)));
        const auto by_ids = [](const PairContact& x, const PairContact& y) {
            return x.a != y.a ? x.a < y.a : x.b < y.b;
        };
        std::sort(listed.begin(), listed.end(), by_ids);
        REQUIRE(std::adjacent_find(listed.begin(), listed.end()) == listed.end());
        REQUIRE(listed.size() == all_contacts(plain.blob, plain_b).size());
    }
    CHECK(touching > 5);
}

}  // namespace
}  // namespace espalier::tests::pair_test
