// Volumes: every query equals the loop over all triangles, page by page too.
#include "support/testing.hpp"

#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/overlap/rounded_shapes.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/meshes/real_meshes.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests::volume_test {
namespace {

using detail::round_volume;

std::vector<std::uint32_t> indices_of(std::span<const TriangleId> triangles) {
    std::vector<std::uint32_t> indices;
    for (const TriangleId triangle : triangles) indices.push_back(triangle.index);
    return indices;
}

template <class Shape>
std::vector<std::uint32_t> every_overlap(const Blob& blob, const Shape& shape) {
    std::vector<std::uint32_t> found;
    CHECK(for_each_overlap(blob, shape, [&](TriangleId t) { found.push_back(t.index); }) == QueryStatus::ok);
    return found;
}

/// All pages, of sizes that change; some tens of them when there are that many overlaps.
template <class Shape>
std::vector<std::uint32_t> all_pages(const Blob& blob, const Shape& shape, std::size_t overlaps, Random& random) {
    std::vector<std::uint32_t> found;
    std::vector<TriangleId> room(1 + random.below(40 + static_cast<std::uint32_t>(overlaps / 8)));
    for (Cursor from;;) {
        const std::span<TriangleId> part =
            std::span(room).first(1 + random.below(static_cast<std::uint32_t>(room.size())));
        const Filled page = collect_overlaps(blob, shape, part, from);
        REQUIRE(page.count <= part.size());
        for (const std::uint32_t index : indices_of(page.in(part))) found.push_back(index);
        if (page.status == QueryStatus::ok) {
            CHECK(collect_overlaps(blob, shape, part, page.next).count == 0);
            return found;
        }
        REQUIRE(page.status == QueryStatus::output_full);
        REQUIRE(page.count == part.size());
        REQUIRE(page.next != from);
        from = page.next;
    }
}

struct Tally {
    std::uint64_t asked = 0, awkward = 0;
    std::uint64_t overlapping = 0;  ///< queries with an overlap
    std::uint64_t out_of_range = 0;
};

template <class Shape>
void check_answers(const Blob& blob, const Shape& shape, const std::vector<std::uint32_t>& expected, Random& random,
                   Tally& tally) {
    on_each_instruction_set([&] {
        REQUIRE(overlaps(blob, shape).yes() == !expected.empty());
        REQUIRE(every_overlap(blob, shape) == expected);
    });
    REQUIRE(all_pages(blob, shape, expected.size(), random) == expected);
    tally.overlapping += expected.empty() ? 0u : 1u;
}

template <class Shape>
void check_against_loop(const Blob& blob, const TriangleLoop& loop, const Shape& shape, Random& random, Tally& tally) {
    CAPTURE(describe(shape));
    detail::Rounded<Shape> rounded;
    const QueryStatus status = round_volume(detail::data_of(blob), shape, rounded);
    if (is_refused(status)) {
        ++tally.out_of_range;
        TriangleId room[1];
        REQUIRE(collect_overlaps(blob, shape, room).status == status);
        REQUIRE(overlaps(blob, shape).status() == status);
        REQUIRE(for_each_overlap(blob, shape, [](TriangleId) { FAIL("a refused shape overlaps"); }) == status);
        return;
    }
    const bool is_empty = status == QueryStatus::not_found;
    check_answers(blob, shape, is_empty ? std::vector<std::uint32_t>() : loop.every_overlap(rounded), random, tally);
}

void check_sphere(const Blob& blob, const TriangleLoop& loop, const Sphere& sphere, Random& random, Tally& tally) {
    CAPTURE(describe(sphere));
    detail::RoundedPoint rounded;
    if (detail::round_point(detail::data_of(blob), sphere.center, sphere.radius, rounded) == QueryStatus::ok) {
        check_answers(blob, sphere, loop.every_overlap(rounded), random, tally);
        return;
    }
    // Too far away for its radius, or one that a hair's breadth made negative.
    ++tally.out_of_range;
    const bool is_valid = sphere.radius >= 0.0f;
    TriangleId room[1];
    const Filled page = collect_overlaps(blob, sphere, room);
    REQUIRE(page.status == (is_valid ? QueryStatus::ok : QueryStatus::invalid_argument));
    REQUIRE(page.count == 0);
    REQUIRE(overlaps(blob, sphere).status() == (is_valid ? QueryStatus::not_found : QueryStatus::invalid_argument));
}

constexpr std::array kinds = {"spheres", "capsules", "boxes", "oriented boxes", "triangles", "sets of planes"};
using Tallies = std::array<Tally, kinds.size()>;

struct Makers {
    Makers(const DecodedBlob& decoded, std::uint64_t seed) : spheres(decoded, seed), shapes(decoded, seed) {}
    QueryMaker spheres;
    ShapeMaker shapes;
};

/// Asks with a shape of each kind.
void check_shapes(const Blob& blob, const TriangleLoop& loop, Makers& makers, bool awkward, Tallies& tallies) {
    Random& random = makers.shapes.random();
    check_sphere(blob, loop, awkward ? makers.spheres.sphere() : makers.spheres.random_sphere(), random, tallies[0]);
    std::size_t kind = 0;
    makers.shapes.make_volumes(
        awkward, [&](const auto& shape) { check_against_loop(blob, loop, shape, random, tallies[++kind]); });
    for (Tally& tally : tallies) {
        ++tally.asked;
        tally.awkward += awkward ? 1u : 0u;
    }
}

void tell_calls(const std::string& mesh, const Tallies& tallies) {
    for (std::size_t i = 0; i < kinds.size(); ++i)
        MESSAGE(calls_made(std::string(kinds[i]) + ": any, all, pages", mesh, tallies[i].asked - tallies[i].awkward,
                           tallies[i].awkward));
}

void check_test_blobs(const std::vector<TestBlob>& blobs, std::uint64_t count) {
    Tallies tallies;
    for (const TestBlob& blob : blobs) {
        CAPTURE(blob.name);
        const TriangleLoop loop(blob.decoded);
        Makers makers(blob.decoded, 40);
        for (std::uint64_t i = 0; i < count; ++i)
            check_shapes(blob.opened.blob, loop, makers, makers.shapes.random().coin(), tallies);
    }
    tell_calls(generated_meshes, tallies);
    for (const Tally& tally : tallies) {
        CHECK(tally.overlapping < tally.asked);
        if (!asks_enough()) continue;
        CHECK(tally.overlapping > tally.asked / 5);
        CHECK(tally.out_of_range < tally.asked / 10);
    }
}

/// Times a scale of 1,000 these are at least the counts that a release must show, all profiles together.
void check_real_mesh(const Mesh& mesh, Profile profile) {
    const OpenedBlob opened(mesh, with_profile(profile));
    const DecodedBlob decoded = decode(opened.bytes);
    const TriangleLoop loop(decoded);
    Makers makers(decoded, 50 + static_cast<std::uint64_t>(profile));
    Tallies tallies;
    const std::uint64_t count = scaled_share(decoded.triangles.size() > 200'000 ? 3 : 112);
    for (std::uint64_t i = 0; i < count; ++i) check_shapes(opened.blob, loop, makers, i % 10 == 9, tallies);
    tell_calls(mesh.name, tallies);
    for (const Tally& tally : tallies)
        if (count >= 20) CHECK(tally.overlapping > 0);  // fewer may all be beside it
}

TEST_CASE("overlap: volumes of every kind equal the loop in any and all and pages") {
    check_test_blobs(small_test_blobs(), scaled_share(1'500));
    check_test_blobs(medium_test_blobs(), scaled_share(200));
}

TEST_CASE("overlap: volumes of every kind equal the loop on real meshes") { for_each_real_mesh(check_real_mesh); }

}  // namespace
}  // namespace espalier::tests::volume_test
