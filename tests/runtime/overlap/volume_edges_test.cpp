// Claims about volumes at the edges, as the header words them, and about the boxes of nodes as bytes.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/overlap.hpp>
#include <runtime/box_nodes.hpp>
#include <runtime/lattice_box.hpp>
#include <runtime/lattice_capsule.hpp>
#include <runtime/lattice_corners.hpp>
#include <runtime/lattice_half_spaces.hpp>
#include <runtime/lattice_oriented_box.hpp>
#include <runtime/plane_nodes.hpp>

#include "support/base/profiles.hpp"
#include "support/base/random.hpp"
#include "support/blobs/node_kinds.hpp"
#include "support/blobs/test_blobs.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/meshes/makers.hpp"
#include "support/queries/shape_maker.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

template <class Shape>
QueryStatus status_of(const Blob& blob, const Shape& shape) {
    const OverlapPage page = collect_overlaps(blob, shape, std::span<Triangle>());
    CHECK(page.count == 0);
    CHECK(overlaps(blob, shape) == (page.status == QueryStatus::output_full));
    return page.status;
}

constexpr QueryStatus no = QueryStatus::ok;

}  // namespace

TEST_SUITE("volume edges") {
    TEST_CASE("overlap: touching counts and a step of the grid beside does not") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const float beside = 1.0f + cube.blob.step();
        for (const float at : {1.0f, beside}) {
            const bool touches = at == 1.0f;
            CAPTURE(at);
            CHECK(overlaps(cube.blob, Box{{at, -0.5f, -0.5f}, {9.0f, 0.5f, 0.5f}}) == touches);
            CHECK(overlaps(cube.blob, Box{{at, at, at}, {infinity, infinity, infinity}}) == touches);
            CHECK(overlaps(cube.blob, Box{{at, 0.25f, 0.5f}, {at, 0.25f, 0.5f}}) == touches);
            const Vec3 x = {0.5f, 0.5f, 0.0f}, y = {-0.5f, 0.5f, 0.0f};
            CHECK(overlaps(cube.blob, OrientedBox{{1.0f + at, 0.0f, 0.0f}, {x, y, {0.0f, 0.0f, 0.25f}}}) == touches);
            CHECK(overlaps(cube.blob, OrientedBox{{at, 0.0f, 0.0f}, {{}, {}, {}}}) == touches);
            CHECK(overlaps(cube.blob, OrientedBox{{at, 0.0f, 0.0f}, {{0.0f, 0.125f, 0.0f}, {}, {}}}) == touches);
            CHECK(overlaps(cube.blob, Corners{{at, 0.0f, 0.0f}, {at, 1.0f, 0.0f}, {at, 0.0f, 0.5f}}) == touches);
            CHECK(overlaps(cube.blob, Corners{{at, 0.0f, 0.0f}, {2.0f, 1.0f, 0.0f}, {3.0f, 0.0f, 0.5f}}) == touches);
            CHECK(overlaps(cube.blob, Capsule{{1.0f + at, 0.0f, 0.0f}, {1.0f + at, 9.0f, 0.0f}, 1.0f}) == touches);
            CHECK(overlaps(cube.blob, Capsule{{at, 0.0f, 0.0f}, {9.0f, 0.0f, 0.0f}, 0.0f}) == touches);
            const std::vector<Plane> corner = {Plane{{-1.0f, -1.0f, -1.0f}, -3.0f * at}};
            CHECK(overlaps(cube.blob, corner) == touches);
            const std::vector<Plane> needle = {Plane{{1.0f, 0.0f, 0.0f}, at}, Plane{{-1.0f, 0.0f, 0.0f}, -at},
                                               Plane{{0.0f, 1.0f, 0.0f}, 0.25f}, Plane{{0.0f, -1.0f, 0.0f}, -0.25f}};
            CHECK(overlaps(cube.blob, needle) == touches);
        }
    }

    TEST_CASE("overlap: no shape inside a closed mesh overlaps the surface") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        CHECK_FALSE(overlaps(cube.blob, Box{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}}));
        CHECK_FALSE(overlaps(cube.blob, Capsule{{-0.25f, 0.0f, 0.0f}, {0.25f, 0.0f, 0.0f}, 0.5f}));
        CHECK_FALSE(overlaps(cube.blob, Corners{{-0.5f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.5f}}));
        CHECK_FALSE(overlaps(cube.blob, OrientedBox{{}, {{0.4f, 0.4f, 0.0f}, {-0.4f, 0.4f, 0.0f}, {0, 0, 0.5f}}}));
    }

    TEST_CASE("overlap: an infinite shape overlaps everything and an empty one nothing") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        std::array<Triangle, 12> all;
        const auto is_all = [&](const auto& shape) {
            const OverlapPage page = collect_overlaps(cube.blob, shape, all);
            return page.status == QueryStatus::ok && page.count == 12 && page.next == 12;
        };
        CHECK(is_all(Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}));
        CHECK(is_all(Box{{-1e30f, -1e38f, -9.0f}, {1e30f, 3e38f, 9.0f}}));
        CHECK(is_all(Capsule{{}, {1.0f, 0.0f, 0.0f}, infinity}));
        CHECK(is_all(OrientedBox{{}, {{1e5f, 0.0f, 0.0f}, {0.0f, 1e5f, 0.0f}, {0.0f, 0.0f, 1e5f}}}));
        CHECK(is_all(std::span<const Plane>()));
        CHECK(is_all(std::vector<Plane>{Plane{{1.0f, 2.0f, 3.0f}, infinity}, Plane{{0.0f, 1.0f, 0.0f}, 1e30f}}));
        CHECK(status_of(cube.blob, Box{{0.5f, -9.0f, -9.0f}, {-0.5f, 9.0f, 9.0f}}) == no);
        CHECK(status_of(cube.blob, std::vector<Plane>{Plane{{1.0f, 2.0f, 3.0f}, -infinity}}) == no);
        CHECK(status_of(cube.blob, std::vector<Plane>{Plane{{1.0f, 0.0f, 0.0f}, -1e30f}}) == no);
        CHECK(status_of(Blob(), Box{{-9.0f, -9.0f, -9.0f}, {9.0f, 9.0f, 9.0f}}) == no);
        CHECK(for_each_overlap(Blob(), std::span<const Plane>(), [](Triangle) { return stop; }));
    }

    TEST_CASE("overlap: invalid arguments differ from no overlap") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const Blob& blob = cube.blob;
        const QueryStatus invalid = QueryStatus::invalid_argument;
        CHECK(status_of(blob, Sphere{{not_a_number, 0, 0}, 9.0f}) == invalid);
        CHECK(status_of(blob, Sphere{{0, 0, 0}, -1.0f}) == invalid);
        CHECK(status_of(blob, Sphere{{0, 0, 0}, -0.0f}) == no);
        CHECK(status_of(blob, Capsule{{}, {}, not_a_number}) == invalid);
        CHECK(status_of(blob, Capsule{{}, {0, infinity, 0}, 1.0f}) == invalid);
        CHECK(status_of(blob, Box{{not_a_number, 0, 0}, {9, 9, 9}}) == invalid);
        CHECK(status_of(blob, OrientedBox{{}, {{infinity, 0, 0}, {}, {}}}) == invalid);
        CHECK(status_of(blob, Corners{{0, 0, 0}, {0, 0, not_a_number}, {0, 0, 0}}) == invalid);
        CHECK(status_of(blob, std::vector<Plane>{Plane{{0, 0, 0}, 1.0f}}) == invalid);
        CHECK(status_of(blob, std::vector<Plane>{Plane{{infinity, 0, 0}, 1.0f}}) == invalid);
        CHECK(status_of(blob, std::vector<Plane>(max_planes + 1, Plane{{1.0f, 0.0f, 0.0f}, 0.0f})) == invalid);
        // Far away is no overlap, and too large to say is not.
        CHECK(status_of(blob, OrientedBox{{1e20f, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) == no);
        CHECK(status_of(blob, OrientedBox{{}, {{1e20f, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) == QueryStatus::out_of_range);
        CHECK(status_of(blob, Corners{{1e20f, 0, 0}, {1e20f, 1, 0}, {1e20f, 0, 1}}) == no);
        CHECK(status_of(blob, Corners{{-1e20f, 0, 0}, {1e20f, 1, 0}, {1e20f, 0, 1}}) == QueryStatus::out_of_range);
        CHECK(status_of(blob, Capsule{{}, {1e20f, 1, 0}, 0.5f}) == QueryStatus::out_of_range);
        int visited = 0;
        const auto count = [&](Triangle) { return ++visited, keep_going; };
        CHECK_FALSE(for_each_overlap(blob, OrientedBox{{}, {{1e20f, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, count));
        CHECK(for_each_overlap(blob, Box{{not_a_number, 0, 0}, {9, 9, 9}}, count));
        CHECK(visited == 0);
    }

    TEST_CASE("overlap: a page without room reports more and where it starts") {
        const OpenedBlob cube(make_cube(-1.0f, 1.0f));
        const Box top = {{-9.0f, -9.0f, 0.5f}, {9.0f, 9.0f, 9.0f}};
        std::array<Triangle, 4> room;
        const OverlapPage first = collect_overlaps(cube.blob, top, room);
        REQUIRE(first.status == QueryStatus::output_full);
        CHECK(first.count == 4);
        const OverlapPage asked = collect_overlaps(cube.blob, top, std::span<Triangle>(), first.next);
        CHECK(asked.status == QueryStatus::output_full);
        CHECK(asked.next == first.next);
        CHECK(collect_overlaps(cube.blob, top, room, 12).status == QueryStatus::ok);
        CHECK(collect_overlaps(cube.blob, top, room, 0xFFFFFFFFu).count == 0);
    }

    TEST_CASE("overlap: blobs with copies answer yes or no and refuse lists") {
        BakeOptions options;
        options.profile = format::Profile::fast;
        options.builder = Builder::spatial_splits;
        options.duplicates = 1.0;
        const OpenedBlob split(make_soup(400, 3), options);
        REQUIRE(split.blob.copy_count() > 0);
        const DecodedBlob decoded = decode(split.bytes);
        const TriangleLoop loop(decoded);
        ShapeMaker maker(decoded, 90);
        std::array<int, 2> answers = {};
        const auto check = [&](const auto& shape, auto& rounded) {
            if (round_volume(split.blob.data(), shape, rounded) != QueryStatus::ok) return;
            const bool expected = !rounded.is_empty && !loop.every_overlap(rounded).empty();
            REQUIRE(overlaps(split.blob, shape) == expected);
            ++answers[expected ? 1 : 0];
        };
        for (std::uint64_t i = 0; i < scaled(200); ++i) {
            detail::LatticeBox box;
            check(maker.box(maker.random().coin()), box);
            detail::LatticeOrientedBox oriented;
            check(maker.oriented_box(maker.random().coin()), oriented);
            detail::LatticeCorners corners;
            check(maker.corners(maker.random().coin()), corners);
            detail::LatticeHalfSpaces half_spaces;
            check(maker.planes(maker.random().coin()), half_spaces);
            detail::LatticeCapsule capsule;
            check(maker.capsule(maker.random().coin()), capsule);
        }
        CHECK(answers[0] > 0);
        CHECK(answers[1] > 0);
        const Box all = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
        std::array<Triangle, 4> room;
        CHECK(overlaps(split.blob, all));
        CHECK_FALSE(for_each_overlap(split.blob, all, [](Triangle) { return keep_going; }));
        const OverlapPage page = collect_overlaps(split.blob, all, room, 3);
        CHECK(page.status == QueryStatus::has_copies);
        CHECK(page.next == 3);
    }

    TEST_CASE("kernel: eight bytes at once compare as one at a time") {
        Random random(11);
        for (unsigned a = 0; a < 256; ++a) {
            for (unsigned b = 0; b < 256; ++b) {
                std::uint64_t left = random.next(), right = random.next();
                const unsigned place = random.below(8);
                left = (left & ~(std::uint64_t{255} << 8 * place)) | std::uint64_t{a} << 8 * place;
                right = (right & ~(std::uint64_t{255} << 8 * place)) | std::uint64_t{b} << 8 * place;
                const unsigned tops = detail::byte_tops_of(detail::fields_at_least<detail::byte_tops>(left, right));
                for (unsigned i = 0; i < 8; ++i)
                    REQUIRE((tops >> i & 1u) == ((left >> 8 * i & 255) >= (right >> 8 * i & 255) ? 1u : 0u));
            }
        }
    }

    TEST_CASE("kernel: four words at once compare as one at a time") {
        Random random(13);
        for (unsigned i = 0; i < 100000; ++i) {
            const std::uint64_t left = random.next();
            std::uint64_t right = random.next();
            // Words that are equal, or differ by one.
            const unsigned place = 16 * random.below(4);
            const std::uint64_t near = (left >> place) + random.below(3) - 1;
            right = (right & ~(std::uint64_t{65535} << place)) | (near & 65535) << place;
            const unsigned tops = detail::word_tops_of(detail::fields_at_least<detail::word_tops>(left, right));
            for (unsigned word = 0; word < 4; ++word)
                REQUIRE((tops >> word & 1u) == ((left >> 16 * word & 65535) >= (right >> 16 * word & 65535) ? 1u : 0u));
        }
    }

    TEST_CASE("kernel: children within bounds and behind a plane and below a size equal a plain loop") {
        Random random(12);
        for (const TestBlob& blob : small_test_blobs()) {
            const detail::BlobData& data = blob.opened.blob.data();
            for (std::uint64_t i = 0; i < scaled_share(600); ++i) {
                with_node_kind(data.profile, [&]<class Node>() {
                    const Node node = detail::node_at<Node>(data, random.below(data.node_count));
                    detail::IntegerBounds bounds;
                    detail::LatticePlane plane;
                    plane.offset = 0;
                    for (int k = 0; k < 3; ++k) {
                        bounds.low[k] = random.between(-2, data.extent[k] + 2);
                        bounds.high[k] = bounds.low[k] + random.between(-1, data.extent[k] / 4 + 1);
                        if (random.below(4) == 0) bounds.high[k] = detail::bounds_limit;
                        plane.normal[k] = random.between(-(1 << 24), 1 << 24);
                        plane.offset += std::int64_t{plane.normal[k]} * random.between(0, data.extent[k]);
                    }
                    const std::int32_t size = random.between(-1, data.extent[0] / 2);
                    unsigned within = 0, behind = 0, small = 0;
                    for (unsigned c = 0; c < node.node_children() + node.leaf_children(); ++c) {
                        bool meets = true, is_small = true;
                        std::int64_t deepest = 0;
                        for (int k = 0; k < 3; ++k) {
                            const std::int32_t low = node.low(k, c, data.bits), high = node.high(k, c, data.bits);
                            meets = meets && low <= bounds.high[k] && high >= bounds.low[k];
                            is_small = is_small && high - low <= size;
                            deepest += std::int64_t{plane.normal[k]} * (plane.normal[k] < 0 ? high : low);
                        }
                        within |= (meets ? 1u : 0u) << c;
                        small |= (is_small ? 1u : 0u) << c;
                        behind |= (deepest <= plane.offset ? 1u : 0u) << c;
                    }
                    REQUIRE(detail::children_within(node, data.bits, bounds) == within);
                    REQUIRE(detail::children_behind(node, data.bits, plane, detail::all_children(node)) == behind);
                    REQUIRE(detail::children_no_larger(node, size, data.bits) == small);
                });
            }
        }
    }
}
