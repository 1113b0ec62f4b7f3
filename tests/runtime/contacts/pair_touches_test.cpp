// Claims about where two placed blobs touch: the pairs of the list of contacts, each with the places and the depth of
// the reference in double.
#include "support/testing.hpp"

#include "support/queries/placement_maker.hpp"

#include "touched.hpp"

namespace espalier::tests::pair_touches_test {
namespace {

constexpr WorkLimit unlimited = WorkLimit::unlimited();

std::vector<PairTouch> all_touches(const PlacedBlob& a, const PlacedBlob& b) {
    std::vector<PairTouch> touches;
    REQUIRE(for_each_touch(
                a, b, [&](const PairTouch& touch) { touches.push_back(touch); }, unlimited) == QueryStatus::ok);
    return touches;
}

bool are_same(const PairTouch& x, const PairTouch& y) {
    bool same = x.a == y.a && x.b == y.b && x.count == y.count && x.status == y.status && same_bits(x.depth, y.depth) &&
                same_bits(x.normal, y.normal);
    for (std::size_t i = 0; i < max_touch_points; ++i) same = same && same_bits(x.points[i], y.points[i]);
    return same;
}

/// The corners of a triangle in the world, and the largest of their coordinates.
Points world_corners(const PlacedBlob& placed, TriangleId triangle, double& largest) {
    const Result<Triangle> corners = triangle_at(placed.blob(), triangle);
    REQUIRE(corners.status == QueryStatus::ok);
    Points points;
    for (const Vec3& corner : {corners->a, corners->b, corners->c}) {
        points.push_back(to_point(to_world(placed.transform(), corner)));
        const Point& p = points.back();
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return points;
}

TEST_CASE("pair: the places and depths of contacts are those of the reference") {
    const std::uint64_t count = scaled_share(8);
    std::uint64_t checked = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        if (blob.decoded.triangles.empty()) continue;
        CAPTURE(blob.name);
        PlacementMaker maker(blob.decoded, blob.decoded, 77);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Transform own = i % 3 == 0 ? maker.random() : Transform{};
            const PlacedBlob a(blob.opened.blob, own), b(blob.opened.blob, maker.random());
            const double step = std::ldexp(1.0, blob.opened.blob.lattice().step_exponent) *
                                static_cast<double>(std::max(own.scale, b.transform().scale));
            std::vector<PairContact> contacts;
            const QueryStatus listed = for_each_contact(
                a, b, [&](const PairContact& contact) { contacts.push_back(contact); }, unlimited);
            if (is_refused(listed)) continue;
            const std::vector<PairTouch> touches = all_touches(a, b);
            REQUIRE(touches.size() == contacts.size());
            for (std::size_t k = 0; k < touches.size(); ++k) {
                const PairTouch& touch = touches[k];
                REQUIRE(touch.a == contacts[k].a);
                REQUIRE(touch.b == contacts[k].b);
                REQUIRE(touch.status == QueryStatus::ok);
                if (k >= 20) continue;
                REQUIRE(are_same(pair_touch(a, b, contacts[k]), touch));
                double size = 0.0;
                const Points of_a = world_corners(a, touch.a, size), of_b = world_corners(b, touch.b, size);
                const double error = step + size * 0x1p-18;
                REQUIRE(touch.count >= 1);
                for (unsigned p = 0; p < touch.count; ++p) {
                    const Point place = to_point(touch.points[p]);
                    REQUIRE(reference::squared_distance(place, {of_a[0], of_a[1], of_a[2]}) <= error * error);
                    REQUIRE(reference::squared_distance(place, {of_b[0], of_b[1], of_b[2]}) <= error * error);
                }
                const double depth = static_cast<double>(touch.depth);
                const double expected = -reference::signed_separation(of_a, of_b);
                REQUIRE(std::abs(depth - expected) <= error);
                REQUIRE(reference::gap_along(to_point(touch.normal), of_b, of_a) >= -depth - error);
                ++checked;
            }
        }
    }
    CHECK(checked > 100);
    MESSAGE(checked, " pairs");
}

TEST_CASE("pair: a list of places comes in pages and ends as that of contacts") {
    const OpenedBlob ball(make_icosphere(3, 1.0, {}));
    const Transform placement = {{0.1f, 0.2f, 0.3f, 0.9f}, {0.7f, 0.2f, 0.1f}, 0.8f};
    const PlacedBlob a(ball.blob), b(ball.blob, placement);
    const std::vector<PairTouch> all = all_touches(a, b);
    REQUIRE(all.size() > 20);
    std::vector<PairTouch> paged;
    Cursor from;
    for (;;) {
        std::array<PairTouch, 7> page;
        const Filled filled = collect_touches(a, b, page, unlimited, from);
        for (const PairTouch& touch : filled.in(page)) paged.push_back(touch);
        if (filled.status == QueryStatus::ok) break;
        REQUIRE(filled.status == QueryStatus::output_full);
        from = filled.next;
    }
    REQUIRE(paged.size() == all.size());
    for (std::size_t i = 0; i < all.size(); ++i) REQUIRE(are_same(paged[i], all[i]));
    std::size_t visits = 0;
    const auto stop = [&](const PairTouch&) { return ++visits == 3 ? Visit::stop : Visit::next; };
    CHECK(for_each_touch(a, b, stop, unlimited) == QueryStatus::stopped);
    CHECK(visits == 3);
    CHECK(for_each_touch(a, b, stop, WorkLimit(0)) == QueryStatus::work_limit);
}

TEST_CASE("pair: a box that stands in a floor leaves it upward after its depth") {
    for_each_profile([](Profile profile) {
        const OpenedBlob floor(make_plane_grid(4), with_profile(profile)), box(make_cube(-0.5f, 0.5f));
        const Vec3 low = floor.blob.bounds().min, high = floor.blob.bounds().max;
        const Vec3 middle = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), low.z};
        const float size = 0.3f * (high.x - low.x), depth = 0.01f * size;
        const Transform placement = {
            {0.0f, 0.0f, 0.1f, 1.0f}, {middle.x, middle.y, middle.z + 0.5f * size - depth}, size};
        std::vector<Contact> contacts;
        for (const PairTouch& touch : all_touches(floor.blob, {box.blob, placement})) {
            REQUIRE(touch.count >= 1);
            REQUIRE(touch.count <= 2);
            for (unsigned i = 0; i < touch.count; ++i) contacts.push_back(touch.contact(i));
        }
        REQUIRE(contacts.size() > 8);
        REQUIRE(reduce_contacts(contacts) == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            REQUIRE(contacts[i].normal.z > 0.999f);
            REQUIRE(static_cast<double>(contacts[i].distance / size) == doctest::Approx(-0.01).epsilon(0.01));
            // At the corners of the box.
            REQUIRE(std::hypot(contacts[i].point.x - middle.x, contacts[i].point.y - middle.y) > 0.6f * size);
        }
    });
}

TEST_CASE("pair: faces in one plane touch in a polygon of depth 0") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    const PlacedBlob a(cube.blob), b(cube.blob, {{}, {0.25f, 0.125f, 1.0f}, 1.0f});
    std::size_t polygons = 0;
    float area = 0.0f;
    for (const PairTouch& touch : all_touches(a, b)) {
        CHECK(touch.depth == 0.0f);
        for (unsigned i = 0; i < touch.count; ++i) REQUIRE(touch.points[i].z == 1.0f);
        if (touch.count < 3 || std::abs(touch.normal.z) < 1.0f) continue;
        ++polygons;
        // The points come in no order: each triangle of three of them is within the polygon.
        float largest = 0.0f;
        for (unsigned i = 0; i < touch.count; ++i) {
            for (unsigned j = 0; j < i; ++j) {
                for (unsigned k = 0; k < j; ++k) {
                    const Vec3 &p = touch.points[i], &q = touch.points[j], &r = touch.points[k];
                    largest = std::max(largest, std::abs((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) * 0.5f);
                }
            }
        }
        area += largest;
    }
    CHECK(polygons >= 3);
    CHECK(area <= 0.75f * 0.875f + 0.001f);
    CHECK(area > 0.3f);
}

TEST_CASE("pair: places are refused as contacts are and for triangles that do not exist or touch") {
    const OpenedBlob cube(make_cube(0.0f, 1.0f));
    const PlacedBlob a(cube.blob), b(cube.blob, {{}, {3.0f, 0.0f, 0.0f}, 1.0f});
    const Blob closed;
    CHECK(pair_touch(closed, b, {{0}, {0}, QueryStatus::ok}).status == QueryStatus::not_open);
    CHECK(pair_touch(a, b, {{0}, {0}, QueryStatus::ok}).status == QueryStatus::not_found);
    CHECK(pair_touch(a, b, {{12}, {0}, QueryStatus::ok}).status == QueryStatus::invalid_argument);
    CHECK(pair_touch(a, b, {{0}, no_triangle, QueryStatus::ok}).status == QueryStatus::invalid_argument);
    const PlacedBlob flat(cube.blob, {{}, {}, 0.0f});
    CHECK(pair_touch(a, flat, {{0}, {0}, QueryStatus::ok}).status == QueryStatus::invalid_argument);
    CHECK(collect_touches(a, flat, {}, unlimited).status == QueryStatus::invalid_argument);
    CHECK(collect_touches(a, a, {}, unlimited).status == QueryStatus::output_full);
    CHECK(collect_touches(closed, a, {}, unlimited).status == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::pair_touches_test
