// Claims about volumes at the edges, as the header words them, and about the boxes of nodes as bytes.
#include "support/testing.hpp"

#include <runtime/overlap/rounded_shapes.hpp>
#include <runtime/traversal/box_nodes.hpp>

#include "support/blobs/deformed_mesh.hpp"
#include "support/blobs/node_kinds.hpp"
#include "support/loops/triangle_loop.hpp"
#include "support/machine/chosen_instruction_set.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests::volume_edges_test {
namespace {

template <class Shape>
QueryStatus status_of(const Blob& blob, const Shape& shape) {
    const Filled page = collect_overlaps(blob, shape, std::span<TriangleId>());
    CHECK(page.count == 0);
    const YesNo any = overlaps(blob, shape);
    CHECK(any.yes() == (page.status == QueryStatus::output_full));
    CHECK(any.no() == (page.status == QueryStatus::ok));
    if (is_refused(page.status)) CHECK(any.status() == page.status);
    return page.status;
}

/// For the expression at hand.
ConvexVolume planes(std::initializer_list<Plane> some) { return {{some.begin(), some.size()}}; }

constexpr QueryStatus no = QueryStatus::ok;

TEST_CASE("overlap: touching counts and a step of the grid beside does not") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const float beside = 1.0f + std::ldexp(1.0f, cube.blob.lattice().step_exponent);
    for (const float at : {1.0f, beside}) {
        const bool touches = at == 1.0f;
        CAPTURE(at);
        CHECK(overlaps(cube.blob, Box{{at, -0.5f, -0.5f}, {9.0f, 0.5f, 0.5f}}).yes() == touches);
        CHECK(overlaps(cube.blob, Box{{at, at, at}, {infinity, infinity, infinity}}).yes() == touches);
        CHECK(overlaps(cube.blob, Box{{at, 0.25f, 0.5f}, {at, 0.25f, 0.5f}}).yes() == touches);
        const Vec3 x = {0.5f, 0.5f, 0.0f}, y = {-0.5f, 0.5f, 0.0f};
        CHECK(overlaps(cube.blob, OrientedBox{{1.0f + at, 0.0f, 0.0f}, {x, y, {0.0f, 0.0f, 0.25f}}}).yes() == touches);
        CHECK(overlaps(cube.blob, OrientedBox{{at, 0.0f, 0.0f}, {{}, {}, {}}}).yes() == touches);
        CHECK(overlaps(cube.blob, OrientedBox{{at, 0.0f, 0.0f}, {{0.0f, 0.125f, 0.0f}, {}, {}}}).yes() == touches);
        CHECK(overlaps(cube.blob, Triangle{{at, 0.0f, 0.0f}, {at, 1.0f, 0.0f}, {at, 0.0f, 0.5f}}).yes() == touches);
        CHECK(overlaps(cube.blob, Triangle{{at, 0.0f, 0.0f}, {2.0f, 1.0f, 0.0f}, {3.0f, 0.0f, 0.5f}}).yes() == touches);
        CHECK(overlaps(cube.blob, Capsule{{1.0f + at, 0.0f, 0.0f}, {1.0f + at, 9.0f, 0.0f}, 1.0f}).yes() == touches);
        CHECK(overlaps(cube.blob, Capsule{{at, 0.0f, 0.0f}, {9.0f, 0.0f, 0.0f}, 0.0f}).yes() == touches);
        const std::vector<Plane> corner = {Plane{{-1.0f, -1.0f, -1.0f}, -3.0f * at}};
        CHECK(overlaps(cube.blob, ConvexVolume{corner}).yes() == touches);
        const std::vector<Plane> needle = {Plane{{1.0f, 0.0f, 0.0f}, at}, Plane{{-1.0f, 0.0f, 0.0f}, -at},
                                           Plane{{0.0f, 1.0f, 0.0f}, 0.25f}, Plane{{0.0f, -1.0f, 0.0f}, -0.25f}};
        CHECK(overlaps(cube.blob, ConvexVolume{needle}).yes() == touches);
    }
}

TEST_CASE("overlap: a capsule a hair too thin overlaps nothing where the squares of floats overflow") {
    const float end = 0x1p24f - 1.0f;
    const OpenedBlob slope(
        {.positions = {{0.0f, 0.0f, 0.0f}, {end, 0.0f, 0.0f}, {0.0f, end, end}}, .triangles = {{0, 1, 2}}},
        {.resolution = Resolution::bits(24)});
    REQUIRE(slope.blob.lattice().step_exponent == 0);
    const Vec3 above = {0x1p22f, 0x1p22f, 0x1p22f + 0x1p17f};  // by 92,681.9 steps
    on_each_instruction_set([&] {
        CHECK(overlaps(slope.blob, Capsule{above, above, 92'681.0f}).no());
        CHECK(overlaps(slope.blob, Capsule{above, above, 92'682.0f}).yes());
    });
}

TEST_CASE("overlap: a triangle that a pose made a point overlaps a capsule by its corners alone") {
    DeformedMesh mesh(make_cube(0.0f, 200.0f));
    mesh.move_to(std::vector<Vec3>(8, Vec3{100.0f, 0.0f, 0.0f}));
    on_each_instruction_set([&] {
        CHECK(overlaps(mesh.deformable.blob(), Capsule{{}, {}, 99.9999f}).no());
        CHECK(overlaps(mesh.deformable.blob(), Capsule{{}, {1.0f, 0.0f, 0.0f}, 99.0001f}).yes());
    });
}

TEST_CASE("overlap: no shape inside a closed mesh overlaps the surface") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    CHECK(overlaps(cube.blob, Box{{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}}).no());
    CHECK(overlaps(cube.blob, Capsule{{-0.25f, 0.0f, 0.0f}, {0.25f, 0.0f, 0.0f}, 0.5f}).no());
    CHECK(overlaps(cube.blob, Triangle{{-0.5f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.5f}}).no());
    CHECK(overlaps(cube.blob, OrientedBox{{}, {{0.4f, 0.4f, 0.0f}, {-0.4f, 0.4f, 0.0f}, {0, 0, 0.5f}}}).no());
}

TEST_CASE("overlap: an infinite shape overlaps everything and an empty one nothing") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    std::array<TriangleId, 12> all;
    const auto is_all = [&](const auto& shape) {
        const Filled page = collect_overlaps(cube.blob, shape, all);
        return page.status == QueryStatus::ok && page.count == 12;
    };
    CHECK(is_all(Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}));
    CHECK(is_all(Box{{-1e30f, -1e38f, -9.0f}, {1e30f, 3e38f, 9.0f}}));
    CHECK(is_all(Capsule{{}, {1.0f, 0.0f, 0.0f}, infinity}));
    CHECK(is_all(OrientedBox{{}, {{1e5f, 0.0f, 0.0f}, {0.0f, 1e5f, 0.0f}, {0.0f, 0.0f, 1e5f}}}));
    CHECK(is_all(ConvexVolume{}));
    CHECK(is_all(planes({Plane{{1.0f, 2.0f, 3.0f}, infinity}, Plane{{0.0f, 1.0f, 0.0f}, 1e30f}})));
    CHECK(status_of(cube.blob, Box{{0.5f, -9.0f, -9.0f}, {-0.5f, 9.0f, 9.0f}}) == no);
    CHECK(status_of(cube.blob, planes({Plane{{1.0f, 2.0f, 3.0f}, -infinity}})) == no);
    CHECK(status_of(cube.blob, planes({Plane{{1.0f, 0.0f, 0.0f}, -1e30f}})) == no);
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
    CHECK(status_of(blob, Triangle{{0, 0, 0}, {0, 0, not_a_number}, {0, 0, 0}}) == invalid);
    CHECK(status_of(blob, planes({Plane{{0, 0, 0}, 1.0f}})) == invalid);
    CHECK(status_of(blob, planes({Plane{{infinity, 0, 0}, 1.0f}})) == invalid);
    CHECK(status_of(blob, ConvexVolume{std::vector<Plane>(max_planes + 1, Plane{{1.0f, 0.0f, 0.0f}, 0.0f})}) ==
          invalid);
    // Far away is no overlap, and too large to say is not.
    CHECK(status_of(blob, OrientedBox{{1e20f, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) == no);
    CHECK(status_of(blob, OrientedBox{{}, {{1e20f, 0, 0}, {0, 1, 0}, {0, 0, 1}}}) == QueryStatus::out_of_range);
    CHECK(status_of(blob, Triangle{{1e20f, 0, 0}, {1e20f, 1, 0}, {1e20f, 0, 1}}) == no);
    CHECK(status_of(blob, Triangle{{-1e20f, 0, 0}, {1e20f, 1, 0}, {1e20f, 0, 1}}) == QueryStatus::out_of_range);
    CHECK(status_of(blob, Capsule{{}, {1e20f, 1, 0}, 0.5f}) == QueryStatus::out_of_range);
    // Beyond 2^120 steps nothing is rounded, although this radius reaches back.
    CHECK(status_of(blob, Sphere{{3e38f, 0, 0}, infinity}) == QueryStatus::out_of_range);
    CHECK(status_of(blob, Sphere{{1e30f, 0, 0}, 1.0f}) == no);
    int visited = 0;
    const auto count = [&](TriangleId) { return ++visited, Visit::next; };
    CHECK(for_each_overlap(blob, OrientedBox{{}, {{1e20f, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, count) ==
          QueryStatus::out_of_range);
    CHECK(for_each_overlap(blob, Box{{not_a_number, 0, 0}, {9, 9, 9}}, count) == invalid);
    CHECK(visited == 0);
}

TEST_CASE("overlap: a page without room reports more and where it starts") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Box top = {{-9.0f, -9.0f, 0.5f}, {9.0f, 9.0f, 9.0f}};
    std::array<TriangleId, 4> room;
    const Filled first = collect_overlaps(cube.blob, top, room);
    REQUIRE(first.status == QueryStatus::output_full);
    CHECK(first.count == 4);
    const Filled asked = collect_overlaps(cube.blob, top, std::span<TriangleId>(), first.next);
    CHECK(asked.status == QueryStatus::output_full);
    CHECK(asked.next == first.next);
    CHECK(collect_overlaps(cube.blob, top, room, {{12}}).status == QueryStatus::ok);
    const Cursor beyond = {{0xFFFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFFFu}};
    CHECK(collect_overlaps(cube.blob, top, room, beyond).count == 0);
}

TEST_CASE("overlap: a blob that was never opened refuses and an opened one without triangles overlaps nothing") {
    const Box all = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    TriangleId room[2];
    const auto status_of_all = [&](const Blob& blob, const auto& shape) {
        const QueryStatus status = overlaps(blob, shape).status();
        const Filled page = collect_overlaps(blob, shape, room, {{7, 8, 9}});
        CHECK(page.count == 0);
        CHECK((page.next == Cursor{{7, 8, 9}}) == is_refused(page.status));
        const QueryStatus visited = for_each_overlap(blob, shape, [](TriangleId) { FAIL("there is a triangle"); });
        CHECK(visited == page.status);
        CHECK((status == QueryStatus::not_found ? QueryStatus::ok : status) == page.status);
        return status;
    };
    const Blob never;
    CHECK(status_of_all(never, all) == QueryStatus::not_open);
    CHECK(status_of_all(never, Sphere{{}, 1.0f}) == QueryStatus::not_open);
    CHECK(status_of_all(never, Capsule{{}, {}, -1.0f}) == QueryStatus::not_open);
    CHECK(status_of_all(never, ConvexVolume{}) == QueryStatus::not_open);
    CHECK(status_of_all(never, LatticeBox{}) == QueryStatus::not_open);
    CHECK(overlaps(never, all, Accuracy{1.0f}).status() == QueryStatus::not_open);
    const OpenedBlob empty(Mesh{});
    CHECK(status_of_all(empty.blob, all) == QueryStatus::not_found);
    CHECK(status_of_all(empty.blob, Sphere{{}, 1.0f}) == QueryStatus::not_found);
    CHECK(status_of_all(empty.blob, Sphere{{}, -1.0f}) == QueryStatus::invalid_argument);
    CHECK(status_of_all(empty.blob, ConvexVolume{}) == QueryStatus::not_found);
    CHECK(status_of_all(empty.blob, LatticeBox{{-9, -9, -9}, {9, 9, 9}}) == QueryStatus::not_found);
    CHECK(overlaps(empty.blob, all, Accuracy{1.0f}).no());
}

TEST_CASE("overlap: a visitor of corners receives those of the triangle and another one costs no corners") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Box top = {{-9.0f, -9.0f, 0.5f}, {9.0f, 9.0f, 9.0f}};
    std::vector<std::uint32_t> with, without;
    CHECK(for_each_overlap(cube.blob, top, [&](TriangleId triangle, const Triangle& corners) {
              with.push_back(triangle.index);
              CHECK(corners.b == triangle_at(cube.blob, triangle)->b);
          }) == QueryStatus::ok);
    CHECK(for_each_overlap(cube.blob, top, [&](TriangleId triangle) {
              without.push_back(triangle.index);
              return without.size() == 3 ? Visit::stop : Visit::next;
          }) == QueryStatus::stopped);
    CHECK(without.size() == 3);
    CHECK(with.size() > 3);
    static_assert(!std::is_constructible_v<TriangleVisitor, bool (*)(TriangleId)>);
    static_assert(!std::is_constructible_v<TriangleVisitor, bool (*)(TriangleId, const Triangle&)>);
    static_assert(!std::is_constructible_v<Visitor<TriangleId>, bool (*)(TriangleId)>);
    static_assert(std::is_constructible_v<TriangleVisitor, void (*)(TriangleId)>);
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
        const detail::BlobData& data = detail::data_of(blob.opened.blob);
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

}  // namespace
}  // namespace espalier::tests::volume_edges_test
