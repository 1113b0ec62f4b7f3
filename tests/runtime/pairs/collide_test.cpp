// Claims about two blobs as the header words them; that they equal the loop, collide_loop_test.cpp shows.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/collide.hpp>

#include "support/base/profiles.hpp"
#include "support/blobs/baking.hpp"
#include "support/format/decoder.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/placement_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// A triangle mesh of its own is a mesh of one triangle.
Mesh one_triangle(Vec3 a, Vec3 b, Vec3 c) {
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {a, b, c};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

bool touch(const Blob& a, const Blob& b, const Placement& placement) {
    bool answer = false;
    REQUIRE(collides(a, b, placement, answer) == QueryStatus::ok);
    return answer;
}

}  // namespace

TEST_SUITE("collide") {
    TEST_CASE("pair: the first in storage of two equally near leaves is met first") {
        Mesh pair = one_triangle({16, -16, -1}, {24, -16, 1}, {16, -24, 1});
        pair.positions.insert(pair.positions.end(), {{-16, 16, -1}, {-16, 24, 1}, {-24, 16, 1}});
        pair.triangles.push_back({3, 4, 5});
        const BakeOptions options = {.bits = 12, .profile = format::Profile::fast, .max_leaf_triangles = 1};
        const OpenedBlob a(pair, options);
        const OpenedBlob b(one_triangle({-100, -100, 0}, {100, -100, 0}, {-100, 100, 0}), options);
        TrianglePair first;
        bool found = false;
        REQUIRE(first_contact(a.blob, b.blob, {}, first, found) == QueryStatus::ok);
        REQUIRE(found);
        CHECK(first == TrianglePair{{0}, {0}});
        std::vector<TrianglePair> all;
        const auto add = [&](const TrianglePair& contact) { return all.push_back(contact), keep_going; };
        REQUIRE(for_each_contact(a.blob, b.blob, {}, add) == QueryStatus::ok);
        CHECK(all == std::vector<TrianglePair>{{{0}, {0}}, {{1}, {0}}});
    }

    TEST_CASE("pair: touching counts to the last step of the grid") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        const Blob& blob = cube.blob;
        // A grid step is 2^-6 of a lattice step, which is 2^-16 here; 24 bits hold both cubes.
        const float step = blob.step() * 0x1p-6f;
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
        PairDistance nearest;
        bool found = false;
        CHECK(minimum_distance(cube.blob, cube.blob, {{}, {4.0f, 5.0f, 13.0f}, 1.0f}, 100.0f, nearest, found) ==
              QueryStatus::ok);
        CHECK(found);
        CHECK(nearest.distance == 13.0f);
        CHECK(nearest.on_a == Vec3{1.0f, 1.0f, 1.0f});
        CHECK(nearest.on_b == Vec3{4.0f, 5.0f, 13.0f});
        CHECK(minimum_distance(cube.blob, cube.blob, {{}, {4.0f, 5.0f, 13.0f}, 1.0f}, std::nextafter(13.0f, 0.0f),
                               nearest, found) == QueryStatus::ok);
        CHECK_FALSE(found);
        bool within = false;
        CHECK(within_distance(cube.blob, cube.blob, {{}, {4.0f, 5.0f, 13.0f}, 1.0f}, 13.0f, within) == QueryStatus::ok);
        CHECK(within);
        CHECK(within_distance(cube.blob, cube.blob, {{}, {4.0f, 5.0f, 13.0f}, 1.0f}, std::nextafter(13.0f, 0.0f),
                              within) == QueryStatus::ok);
        CHECK_FALSE(within);
        // A scale of 2 and a quarter turn: the cube [0, 2] x [-2, 0] x [0, 2], 3 below.
        CHECK(minimum_distance(cube.blob, cube.blob, {{0.0f, 0.0f, -1.0f, 1.0f}, {0.0f, -3.0f, 0.0f}, 2.0f}, 100.0f,
                               nearest, found) == QueryStatus::ok);
        CHECK(nearest.distance == 3.0f);
    }

    TEST_CASE("pair: surfaces that pierce each other have distance 0 and one common witness") {
        const OpenedBlob flat(one_triangle({0.0f, 0.0f, 0.0f}, {4.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}));
        const OpenedBlob upright(one_triangle({1.0f, 1.0f, -1.0f}, {1.0f, 1.0f, 3.0f}, {9.0f, 9.0f, 9.0f}));
        PairDistance nearest;
        bool found = false;
        CHECK(minimum_distance(flat.blob, upright.blob, {}, 0.0f, nearest, found) == QueryStatus::ok);
        CHECK(found);
        CHECK(nearest.distance == 0.0f);
        CHECK(std::abs(nearest.on_a.z) < 1e-4f);
        CHECK(std::abs(nearest.on_b.z) < 1e-4f);
        CHECK(std::abs(nearest.on_a.x - nearest.on_b.x) < 1e-4f);
    }

    TEST_CASE("pair: a full array reports that there are more") {
        const OpenedBlob sphere(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
        const Placement placement = {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f};
        std::vector<TrianglePair> all(10'000);
        std::size_t count = 0;
        CHECK(all_contacts(sphere.blob, sphere.blob, placement, all, count) == QueryStatus::ok);
        CHECK(count > 20);
        all.resize(count);
        std::vector<TrianglePair> few(count);
        std::size_t written = 0;
        CHECK(all_contacts(sphere.blob, sphere.blob, placement, few, written) == QueryStatus::ok);
        CHECK(few == all);
        few.resize(count - 1);
        CHECK(all_contacts(sphere.blob, sphere.blob, placement, few, written) == QueryStatus::output_full);
        CHECK(written == count - 1);
        CHECK(std::equal(few.begin(), few.end(), all.begin()));
        CHECK(all_contacts(sphere.blob, sphere.blob, placement, {}, written) == QueryStatus::output_full);
        CHECK(written == 0);
        std::size_t visited = 0;
        CHECK(for_each_contact(sphere.blob, sphere.blob, placement, [&](const TrianglePair&) {
                  return ++visited == 5 ? stop : keep_going;
              }) == QueryStatus::ok);
        CHECK(visited == 5);
    }

    TEST_CASE("pair: a work limit is kept and the contacts found are part of the whole") {
        const OpenedBlob sphere(make_icosphere(3, 1.0, {0.0f, 0.0f, 0.0f}));
        const Placement placement = {{0.1f, 0.2f, 0.3f, 1.0f}, {0.5f, 0.25f, 0.125f}, 1.0f};
        std::vector<TrianglePair> all(10'000), part(10'000);
        std::size_t count = 0, part_count = 0;
        CHECK(all_contacts(sphere.blob, sphere.blob, placement, all, count) == QueryStatus::ok);
        CHECK(all_contacts(sphere.blob, sphere.blob, placement, part, part_count, {50}) == QueryStatus::work_limit);
        CHECK(part_count < count);
        CHECK(std::equal(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(part_count), all.begin()));
        bool answer = true;
        CHECK(collides(sphere.blob, sphere.blob, placement, answer, {0}) == QueryStatus::work_limit);
        CHECK_FALSE(answer);
        CHECK(collides(sphere.blob, sphere.blob, {{}, {100.0f, 0.0f, 0.0f}, 1.0f}, answer, {1}) == QueryStatus::ok);
        CHECK_FALSE(answer);
        PairDistance nearest;
        CHECK(minimum_distance(sphere.blob, sphere.blob, {{}, {9.0f, 0.0f, 0.0f}, 1.0f}, 100.0f, nearest, answer,
                               {3}) == QueryStatus::work_limit);
    }

    TEST_CASE("pair: invalid calls are refused and leave results untouched") {
        const OpenedBlob cube(make_cube(0.0f, 1.0f));
        const Blob& blob = cube.blob;
        const float infinity = std::numeric_limits<float>::infinity();
        const float nan = std::numeric_limits<float>::quiet_NaN();
        bool answer = true;
        const auto status = [&](const Placement& placement) { return collides(blob, blob, placement, answer); };
        CHECK(status({{0.0f, 0.0f, 0.0f, 0.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{0.0f, nan, 0.0f, 1.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{0.0f, infinity, 0.0f, 1.0f}, {}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {0.0f, 0.0f, -infinity}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {0.0f, nan, 0.0f}, 1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {}, 0.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {}, -1.0f}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {}, nan}) == QueryStatus::invalid_argument);
        CHECK(status({{}, {1e35f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::out_of_range);
        CHECK(status({{}, {}, 1e35f}) == QueryStatus::out_of_range);
        CHECK(answer);
        CHECK(status({{}, {1e10f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::ok);
        CHECK_FALSE(answer);
        PairDistance nearest;
        const auto distance = [&](const Placement& placement, float most) {
            return minimum_distance(blob, blob, placement, most, nearest, answer);
        };
        CHECK(distance({}, nan) == QueryStatus::invalid_argument);
        CHECK(distance({}, -1.0f) == QueryStatus::invalid_argument);
        CHECK(within_distance(blob, blob, {}, nan, answer) == QueryStatus::invalid_argument);
        CHECK(distance({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, infinity) == QueryStatus::out_of_range);
        CHECK(distance({{}, {1e10f, 0.0f, 0.0f}, 1.0f}, 1.0f) == QueryStatus::ok);
        CHECK_FALSE(answer);
        // Subnormal components turn as well as any.
        const float tiny = std::numeric_limits<float>::denorm_min();
        CHECK(status({{0.0f, 0.0f, tiny, tiny}, {2.0f, 0.0f, 0.0f}, 1.0f}) == QueryStatus::ok);
        CHECK(answer);
        CHECK(collides(Blob(), blob, {}, answer) == QueryStatus::ok);
        CHECK_FALSE(answer);
        CHECK(collides(blob, Blob(), {{}, {}, nan}, answer) == QueryStatus::invalid_argument);
    }

    TEST_CASE("pair: blobs with copies give yes or no and distances and refuse lists") {
        BakeOptions options = with_profile(format::Profile::fast);
        options.builder = Builder::spatial_splits;
        options.duplicates = 1.0;
        const OpenedBlob split(make_soup(400, 21), options);
        REQUIRE(split.blob.copy_count() > 0);
        const OpenedBlob plain(make_soup(400, 21), with_profile(format::Profile::fast));
        const DecodedBlob split_decoded = decode(split.bytes);
        PlacementMaker maker(split_decoded, split_decoded, 77);
        std::size_t touching = 0;
        for (int i = 0; i < 60; ++i) {
            const Placement placement = i % 2 == 0 ? maker.random() : maker.adversarial();
            CAPTURE(describe(placement));
            bool answer = false, expected = false;
            REQUIRE(collides(split.blob, plain.blob, placement, answer) ==
                    collides(plain.blob, plain.blob, placement, expected));
            REQUIRE(answer == expected);
            touching += answer ? 1u : 0u;
            PairDistance nearest, plain_nearest;
            REQUIRE(minimum_distance(split.blob, split.blob, placement, 1e30f, nearest, answer) ==
                    minimum_distance(plain.blob, plain.blob, placement, 1e30f, plain_nearest, expected));
            REQUIRE(answer == expected);
            REQUIRE(nearest.distance == plain_nearest.distance);
            if (answer) REQUIRE(split_decoded.owners[nearest.pair.a.index] == nearest.pair.a.index);
            REQUIRE(for_each_contact(split.blob, plain.blob, placement, [](const TrianglePair&) { return stop; }) ==
                    QueryStatus::has_copies);
            REQUIRE(for_each_contact(plain.blob, split.blob, placement, [](const TrianglePair&) { return stop; }) ==
                    QueryStatus::has_copies);
        }
        CHECK(touching > 5);
    }
}
