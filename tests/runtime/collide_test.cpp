// Two blobs: walking both trees changes nothing, on any instruction set, and the answers are what the header says.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <espalier/collide.hpp>
#include <runtime/pair_queries.hpp>

#include "../support/hostile_values.hpp"
#include "../support/instruction_paths.hpp"
#include "../support/mesh_files.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/pair_loop.hpp"
#include "../support/placement_maker.hpp"
#include "../support/profiles.hpp"
#include "../support/test_blobs.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::uint64_t no_limit = ~std::uint64_t{0};

/// What one instruction set finds, and how much work it was.
struct Touching {
    std::vector<TrianglePair> pairs;
    std::uint64_t work = 0;
    bool operator==(const Touching&) const = default;
};

Touching find_touching(const InstructionPath& path, const detail::PairFrame& frame) {
    Touching result;
    std::uint64_t left = no_limit;
    const auto add = [&](const TrianglePair& pair, const detail::LatticeTriangle&, const detail::LatticeTriangle&) {
        result.pairs.push_back(pair);
        return keep_going;
    };
    REQUIRE(path.touching_pairs(frame, add, left) == QueryStatus::ok);
    result.work = no_limit - left;
    return result;
}

struct Counts {
    std::uint64_t asked = 0;
    std::uint64_t touching = 0;
    std::uint64_t pairs = 0;
};

bool same_bits(const detail::FoundTriangles& a, const detail::FoundTriangles& b) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    bool same = a.pair == b.pair && bits(a.distance.squared) == bits(b.distance.squared);
    for (int k = 0; k < 2; ++k)
        same = same && bits(a.distance.on_a[k]) == bits(b.distance.on_a[k]) &&
               bits(a.distance.on_b[k]) == bits(b.distance.on_b[k]);
    return same;
}

/// Every question about one placement, against the loop.
void check_placement(const TestBlob& a, const TestBlob& b, const Placement& placement, bool with_distance,
                     Counts& counts) {
    CAPTURE(a.name);
    CAPTURE(b.name);
    CAPTURE(describe(placement));
    const Blob& blob_a = a.opened.blob;
    const Blob& blob_b = b.opened.blob;
    detail::PairFrame frame;
    const QueryStatus status = detail::place_pair(blob_a.data(), blob_b.data(), placement, frame);
    bool answer = false;
    REQUIRE(collides(blob_a, blob_b, placement, answer) == status);
    if (status != QueryStatus::ok) return;
    const PairLoop loop(frame, a.decoded, b.decoded);
    const std::vector<TrianglePair> expected = loop.every_contact();

    const std::vector<InstructionPath>& paths = instruction_paths();
    const Touching first = find_touching(paths.front(), frame);
    for (const InstructionPath& path : paths) {
        CAPTURE(path.name);
        REQUIRE(find_touching(path, frame) == first);
    }
    std::vector<TrianglePair> sorted = first.pairs;
    std::sort(sorted.begin(), sorted.end());
    REQUIRE(sorted == expected);
    REQUIRE(answer == !expected.empty());
    ++counts.asked;
    counts.touching += answer ? 1u : 0u;
    counts.pairs += expected.size();

    TrianglePair contact;
    bool found = false;
    REQUIRE(first_contact(blob_a, blob_b, placement, contact, found) == QueryStatus::ok);
    REQUIRE(found == answer);
    if (found) REQUIRE(contact == first.pairs.front());
    if (!with_distance) return;

    PairDistance nearest;
    const QueryStatus distance_status =
        minimum_distance(blob_a, blob_b, placement, std::numeric_limits<float>::infinity(), nearest, found);
    REQUIRE(distance_status == (frame.gap > 1024.0f * frame.span ? QueryStatus::out_of_range : QueryStatus::ok));
    if (distance_status != QueryStatus::ok) return;
    REQUIRE(found);
    if (answer) {
        REQUIRE(nearest.distance == 0.0f);
        REQUIRE(nearest.pair == contact);
        return;
    }
    const auto least = loop.nearest_pair(std::numeric_limits<float>::infinity());
    REQUIRE(least.has_value());
    REQUIRE(nearest.pair == least->pair);
    std::array<float, 7> radii = {};
    std::array<bool, 7> within = {};
    float radius = std::sqrt(least->distance.squared);
    for (int step = 0; step < 3; ++step) radius = std::nextafter(radius, 0.0f);
    for (std::size_t step = 0; step < radii.size(); ++step, radius = std::nextafter(radius, 1e30f)) {
        radii[step] = radius;
        within[step] = loop.is_any_within(radius);
    }
    for (const InstructionPath& path : paths) {
        CAPTURE(path.name);
        detail::FoundTriangles best;
        std::uint64_t left = no_limit;
        REQUIRE(path.nearest_pair(frame, std::numeric_limits<float>::infinity(), false, best, found, left) ==
                QueryStatus::ok);
        REQUIRE(same_bits(best, *least));
        for (std::size_t step = 0; step < radii.size(); ++step) {
            left = no_limit;
            REQUIRE(path.nearest_pair(frame, radii[step], true, best, found, left) == QueryStatus::ok);
            REQUIRE(found == within[step]);
        }
    }
}

void check_blobs(const std::vector<TestBlob>& blobs, std::uint64_t count, bool adversarial, bool with_distance) {
    Counts counts;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        // Each with another mesh, and with itself.
        for (const std::size_t j : {(i + 4) % blobs.size(), i}) {
            PlacementMaker maker(blobs[i].decoded, blobs[j].decoded, 900 + i);
            for (std::uint64_t n = 0; n < count; ++n)
                check_placement(blobs[i], blobs[j], adversarial ? maker.adversarial() : maker.random(), with_distance,
                                counts);
        }
    }
    MESSAGE(counts.asked, " placements, ", counts.touching, " touch, in ", counts.pairs, " pairs");
    CHECK(counts.touching > counts.asked / 10);
    CHECK(counts.touching < counts.asked);
}

}  // namespace

TEST_SUITE("two blobs against the loop") {
    TEST_CASE("placed anyhow: all pairs, in the same order on every path, and the first of them") {
        check_blobs(small_test_blobs(), scaled_share(30), false, false);
    }
    TEST_CASE("placed to touch, in one plane, far away or out of proportion: all pairs, on every path") {
        check_blobs(small_test_blobs(), scaled_share(30), true, false);
    }
    TEST_CASE("the smallest distance and what is within a distance, on every path") {
        check_blobs(small_test_blobs(), scaled_share(6), false, true);
        check_blobs(small_test_blobs(), scaled_share(6), true, true);
    }
}

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

TEST_SUITE("two blobs") {
    TEST_CASE("touching counts, to the last step of the grid") {
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

    TEST_CASE("distances and witnesses of boxes are what geometry says") {
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

    TEST_CASE("a surface that pierces another is at distance 0, with a common point as both witnesses") {
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

    TEST_CASE("an array takes as many pairs as it holds, and says when there are more") {
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

    TEST_CASE("a work limit is kept, and what was found until then is part of the whole") {
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

    TEST_CASE("what cannot be answered is refused, and results are left alone") {
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

    TEST_CASE("blobs with copies are asked whether and how near, and refuse to list") {
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

    TEST_CASE("real meshes: every path finds the same pairs, the first of them first, and distances fit") {
        const auto files = mesh_files();
        if (files.empty()) {
            MESSAGE("SKIPPED: no meshes");
            return;
        }
        for (const auto& file : files) {
            const std::string name = file.filename().string();
            CAPTURE(name);
            const Mesh mesh = read_mesh(file);
            if (mesh.triangles.size() > 200'000) continue;
            std::vector<TestBlob> blobs;
            for (const format::Profile profile : {format::Profile::fast, format::Profile::balanced}) {
                OpenedBlob opened(mesh, with_profile(profile));
                DecodedBlob decoded = decode(opened.bytes);
                blobs.push_back({name, std::move(opened), std::move(decoded)});
            }
            PlacementMaker maker(blobs[0].decoded, blobs[1].decoded, 55);
            for (std::uint64_t i = 0; i < scaled(20); ++i) {
                const Placement placement = i % 4 == 3 ? maker.adversarial() : maker.random();
                CAPTURE(describe(placement));
                detail::PairFrame frame;
                if (detail::place_pair(blobs[0].opened.blob.data(), blobs[1].opened.blob.data(), placement, frame) !=
                    QueryStatus::ok)
                    continue;
                const Touching first = find_touching(instruction_paths().front(), frame);
                for (const InstructionPath& path : instruction_paths()) REQUIRE(find_touching(path, frame) == first);
                if (i % (mesh.triangles.size() < 20'000 ? 20 : 1'000) != 10) continue;  // the loop takes its time
                std::vector<TrianglePair> sorted = first.pairs;
                std::sort(sorted.begin(), sorted.end());
                const PairLoop loop(frame, blobs[0].decoded, blobs[1].decoded);
                REQUIRE(loop.every_contact() == sorted);
            }
        }
    }
}
