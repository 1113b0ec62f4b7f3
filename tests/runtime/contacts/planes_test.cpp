// Claims about the planes that hold a capsule back, and about the way along them.
#include "support/testing.hpp"

#include "oracle/minkowski.hpp"
#include "oracle/surfaces.hpp"
#include "support/queries/shape_maker.hpp"

namespace espalier::tests::planes_test {
namespace {

using reference::Point;
using reference::to_point;
using Points = std::vector<Point>;

constexpr float skin = 0.01f;

void add_quad(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& p : {a, b, c, d}) mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A floor of cells, z = 0, and a wall on it, y = 1.
Mesh make_yard() {
    Mesh mesh;
    for (int x = -4; x < 4; ++x) {
        const auto low = static_cast<float>(x), high = low + 1.0f;
        for (int y = -4; y < 1; ++y) {
            const auto front = static_cast<float>(y), back = front + 1.0f;
            add_quad(mesh, {low, front, 0}, {high, front, 0}, {high, back, 0}, {low, back, 0});
        }
        for (int z = 0; z < 3; ++z) {
            const auto foot = static_cast<float>(z), top = foot + 1.0f;
            add_quad(mesh, {low, 1, foot}, {high, 1, foot}, {high, 1, top}, {low, 1, top});
        }
    }
    return mesh;
}

Capsule standing(float x, float y, float foot) { return {{x, y, foot + 0.3f}, {x, y, foot + 1.5f}, 0.3f}; }

std::vector<ContactPlane> planes_of(const Blob& blob, const Capsule& capsule, float margin, std::size_t room = 64) {
    std::vector<ContactPlane> planes(room);
    const Filled found = collect_planes(blob, capsule, margin, planes);
    REQUIRE(found.status == QueryStatus::ok);
    planes.resize(found.count);
    return planes;
}

double number(float x) { return static_cast<double>(x); }

TEST_CASE("planes: an even floor of many triangles has one wherever the capsule stands") {
    const OpenedBlob yard(make_yard(), {.resolution = Resolution::bits(16)});
    Random random(3);
    for (int i = 0; i < 2'000; ++i) {
        // Every fourth stands on an edge of the floor, and some of these on a corner.
        const float x = i % 4 == 0 ? 1.0f : 3.0f * random.signed_unit(),
                    y = i % 8 == 0 ? -1.0f : -0.5f - 2.0f * random.unit();
        CAPTURE(x);
        CAPTURE(y);
        const auto planes = planes_of(yard.blob, standing(x, y, 0.02f), 0.25f);
        REQUIRE(planes.size() == 1);
        CHECK(number(planes[0].normal.z) == doctest::Approx(1.0).epsilon(1e-4));
        CHECK(number(planes[0].distance) == doctest::Approx(0.02).epsilon(0.05));
    }
}

TEST_CASE("planes: a wall stays where the axis of the capsule is partly below the floor") {
    const OpenedBlob yard(make_yard(), {.resolution = Resolution::bits(16)});
    for (const float foot : {0.02f, -0.2f, -0.4f, -0.8f}) {
        CAPTURE(foot);
        const auto planes = planes_of(yard.blob, standing(0.3f, 0.6f, foot), 0.25f);
        REQUIRE(planes.size() == 2);
        const bool floor_first = planes[0].normal.z > 0.5f;
        const ContactPlane &floor = planes[floor_first ? 0 : 1], &wall = planes[floor_first ? 1 : 0];
        CHECK(number(floor.normal.z) == doctest::Approx(1.0).epsilon(1e-4));
        CHECK(number(floor.distance) == doctest::Approx(number(foot)).epsilon(0.01));
        CHECK(number(wall.normal.y) == doctest::Approx(-1.0).epsilon(1e-4));
        CHECK(number(wall.distance) == doctest::Approx(0.1).epsilon(0.01));
        // Into the wall: up, out of the floor, and along the wall.
        const Result<Vec3> way = solve_planes(planes, {0.1f, 0.4f, 0.0f}, skin);
        REQUIRE(way);
        CHECK(number(way->x) == doctest::Approx(0.1).epsilon(1e-3));
        CHECK(number(way->y) == doctest::Approx(0.09).epsilon(0.01));
        CHECK(number(way->z) == doctest::Approx(std::max(0.0, number(skin - foot))).epsilon(0.01));
    }
}

TEST_CASE("planes: the edge of a step has one that leans and a ridge of two faces has one between them") {
    Mesh mesh;
    add_quad(mesh, {-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0});
    add_quad(mesh, {1, -3, 0}, {1, -3, 0.2f}, {1, 3, 0.2f}, {1, 3, 0});
    add_quad(mesh, {1, -3, 0.2f}, {3, -3, 0.2f}, {3, 3, 0.2f}, {1, 3, 0.2f});
    const OpenedBlob step(mesh, {.resolution = Resolution::bits(16)});
    const auto planes = planes_of(step.blob, standing(0.72f, 0.1f, 0.02f), 0.1f);
    REQUIRE(planes.size() == 2);
    const ContactPlane& edge = planes[0].normal.z > 0.99f ? planes[1] : planes[0];
    CHECK(edge.normal.x < -0.8f);
    CHECK(edge.normal.z > 0.2f);
}

/// The distance of a capsule from a triangle, below 0 the depth, by the reference.
double distance_of(const Points& axis, const reference::PointTriangle& t, float radius) {
    return reference::signed_separation(axis, {t[0], t[1], t[2]}) - static_cast<double>(radius);
}

/// The shortest way from a triangle to an axis, which does not touch it.
Point way_from(const reference::PointTriangle& t, const Points& axis) {
    const reference::Differences ways(axis, {t[0], t[1], t[2]});
    Point best = ways.points[0];
    ways.for_each_triangle([&](const reference::PointTriangle& three) {
        const Point way = reference::closest_to_origin(three);
        if (reference::length(way) < reference::length(best)) best = way;
    });
    return best;
}

TEST_CASE("planes: each is that of its triangle and every triangle nearby has one or a nearer neighbour") {
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        const auto surface = reference::baked_surface(blob.opened.bytes);
        if (surface.empty()) continue;
        double extent = 0.0;
        for (const auto& t : surface)
            for (const Point& c : t) extent = std::max({extent, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
        const double step = std::ldexp(1.0, blob.opened.blob.lattice().step_exponent);
        ShapeMaker maker(blob.decoded, 5);
        for (std::uint64_t i = 0; i < scaled(20); ++i) {
            const Capsule capsule = maker.capsule(i % 2 == 0);
            const float margin = capsule.radius * 0.5f;
            std::vector<ContactPlane> planes(surface.size() + 1);
            const Filled found = collect_planes(blob.opened.blob, capsule, margin, planes);
            if (is_refused(found.status)) continue;
            REQUIRE(found.status == QueryStatus::ok);
            planes.resize(found.count);
            const Points axis = {to_point(capsule.from), to_point(capsule.to)};
            const double reach = number(capsule.radius + margin), size = reference::length(axis[1] - axis[0]) + reach;
            const double error = step / 8.0 + 0x1p-16 * (size + extent);
            if (size < 64.0 * error) continue;  // only rounding tells directions
            for (const ContactPlane& plane : planes) {
                const auto& t = surface[plane.triangle.index];
                const double expected = distance_of(axis, t, capsule.radius);
                if (expected > -number(capsule.radius) + error)
                    REQUIRE(std::abs(number(plane.distance) - expected) <= error);
            }
            for (std::uint32_t t = 0; t < surface.size(); ++t) {
                if (blob.decoded.owners.size() > t && blob.decoded.owners[t] != t) continue;
                const double distance = distance_of(axis, surface[t], capsule.radius);
                if (distance > number(margin) - error) continue;
                const Point own = way_from(surface[t], axis);
                const double apart = reference::length(own), turned = 4.0 * error / apart;
                // What contact.hpp says of planes that are left out: a nearer one says the same but for a 256th.
                const auto holds_off = [&](const ContactPlane& plane) {
                    if (plane.triangle.index == t) return true;
                    const double most = reach + std::max(-number(plane.distance), 0.0);
                    const double turn = reference::length((1.0 / apart) * own - to_point(plane.normal)) - turned;
                    const double farther = distance - number(plane.distance);
                    return farther >= -error && (turn - 1.0 / 256.0) * most <= farther + error;
                };
                const auto is_nearer_neighbour = [&](std::size_t other) {
                    if (other == t) return false;
                    bool is_joined = false;
                    for (const Point& a : surface[other])
                        for (const Point& b : surface[t])
                            is_joined = is_joined || (a.x == b.x && a.y == b.y && a.z == b.z);
                    return is_joined && distance_of(axis, surface[other], capsule.radius) <= distance + error;
                };
                bool is_explained = std::any_of(planes.begin(), planes.end(), holds_off);
                for (std::size_t other = 0; other < surface.size() && !is_explained; ++other)
                    is_explained = is_nearer_neighbour(other);
                CAPTURE(t);
                REQUIRE((is_explained || distance <= -number(capsule.radius) + error));
            }
        }
    }
}

TEST_CASE("planes: a small array has the nearest of a large one") {
    for (const TestBlob& blob : small_test_blobs()) {
        CAPTURE(blob.name);
        ShapeMaker maker(blob.decoded, 8);
        for (std::uint64_t i = 0; i < scaled(200); ++i) {
            const Capsule capsule = maker.capsule(i % 2 == 0);
            std::vector<ContactPlane> many(blob.decoded.triangles.size() + 1), few(i % 7);
            const Filled all = collect_planes(blob.opened.blob, capsule, capsule.radius, many);
            const Filled some = collect_planes(blob.opened.blob, capsule, capsule.radius, few);
            if (is_refused(all.status)) {
                CHECK(some.status == all.status);
                continue;
            }
            REQUIRE(all.status == QueryStatus::ok);
            REQUIRE(some.count == std::min(all.count, few.size()));
            CHECK(some.status == (all.count > few.size() ? QueryStatus::output_full : QueryStatus::ok));
            for (std::size_t k = 0; k < some.count; ++k) REQUIRE(same_bits(few[k], many[k]));
            for (std::size_t k = 1; k < all.count; ++k) REQUIRE(many[k - 1].distance <= many[k].distance);
        }
    }
}

TEST_CASE("planes: what is no capsule is refused") {
    const OpenedBlob yard(make_yard());
    ContactPlane planes[4];
    const float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(collect_planes(Blob(), standing(0, 0, 0), 0.1f, planes).status == QueryStatus::not_open);
    for (const float bad : {-1.0f, infinite, nan}) {
        CHECK(collect_planes(yard.blob, standing(0, 0, 0), bad, planes).status == QueryStatus::invalid_argument);
        CHECK(collect_planes(yard.blob, {{0, 0, 0}, {0, 0, 1}, bad}, 0.1f, planes).status ==
              QueryStatus::invalid_argument);
        CHECK(solve_planes({}, {0, 0, 0}, bad).status == QueryStatus::invalid_argument);
    }
    CHECK(solve_planes({}, {nan, 0, 0}, 0.0f).status == QueryStatus::invalid_argument);
    CHECK(solve_planes({}, {infinite, 0, 0}, 0.0f).status == QueryStatus::invalid_argument);
    for (const float bad : {nan, infinite, -infinite}) {
        const ContactPlane turned = {{0, 0, bad}, 1.0f, {}}, far = {{0, 0, 1}, bad, {}};
        CHECK(solve_planes({&turned, 1}, {0, 0, -1}, 0.0f).status == QueryStatus::invalid_argument);
        CHECK(solve_planes({&far, 1}, {0, 0, -1}, 0.0f).status == QueryStatus::invalid_argument);
    }
    const Result<Vec3> free = solve_planes({}, {1, 2, 3}, 0.5f);
    REQUIRE(free);
    CHECK(free->y == 2.0f);
}

/// The nearest way of all that lie in up to three of the planes and are allowed by all, in double.
std::optional<Point> nearest_way(const std::vector<ContactPlane>& planes, Point wish, double slack) {
    std::optional<Point> best;
    const auto missing = [&](std::size_t i, Point way) {
        return number(skin) - number(planes[i].distance) - reference::dot(to_point(planes[i].normal), way);
    };
    const auto offer = [&](Point way) {
        for (std::size_t i = 0; i < planes.size(); ++i)
            if (missing(i, way) > slack) return;
        if (!best || reference::length(way - wish) < reference::length(*best - wish)) best = way;
    };
    offer(wish);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const Point a = to_point(planes[i].normal);
        const Point in_a = wish + (missing(i, wish) / reference::dot(a, a)) * a;
        offer(in_a);
        for (std::size_t k = 0; k < i; ++k) {
            const Point b = to_point(planes[k].normal), along = reference::cross(a, b);
            if (reference::length(along) < 1e-3) continue;
            const Point across = reference::cross(along, a);  // in plane a, toward or from b
            const Point in_both = in_a + (missing(k, in_a) / reference::dot(across, b)) * across;
            offer(in_both);
            for (std::size_t j = 0; j < k; ++j) {
                const double slope = reference::dot(to_point(planes[j].normal), along);
                if (std::abs(slope) > 1e-3) offer(in_both + (missing(j, in_both) / slope) * along);
            }
        }
    }
    return best;
}

TEST_CASE("planes: the solved way is the nearest that all planes allow") {
    Random random(11);
    std::uint64_t none = 0, blocked = 0;
    const std::uint64_t count = scaled(20'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        std::vector<ContactPlane> planes(random.below(9));
        for (ContactPlane& plane : planes) {
            Vec3 n = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
            if (random.below(3) == 0) n = {0, 0, 1};
            const float length = std::sqrt(dot(n, n));
            plane.normal = {n.x / length, n.y / length, n.z / length};
            plane.distance = 0.2f * random.signed_unit();
        }
        const Vec3 wish = {random.signed_unit(), random.signed_unit(), random.signed_unit()};
        const std::optional<Point> expected = nearest_way(planes, to_point(wish), 1e-6);
        const Result<Vec3> way = solve_planes(planes, wish, skin);
        // A way keeps off all planes, also where they are nearly parallel and the reference finds none.
        const double far = way ? 1.0 + reference::length(to_point(*way)) : 0.0;
        for (const ContactPlane& plane : planes) {
            if (!way) break;
            const double room = reference::dot(to_point(plane.normal), to_point(*way)) + number(plane.distance);
            REQUIRE(room >= number(skin) - 1e-4 * far);
        }
        if (!expected) {
            ++none;
            continue;
        }
        const double asked = reference::length(*expected - to_point(wish));
        blocked += asked > 1e-3;
        if (!way) {
            REQUIRE(!nearest_way(planes, to_point(wish), -1e-4).has_value());
            continue;
        }
        if (asked > 8.0) continue;  // the planes are nearly parallel, and rounding decides
        REQUIRE(reference::length(to_point(*way) - to_point(wish)) <= asked + 1e-3);
    }
    CHECK(none > count / 100);
    CHECK(blocked > count / 4);
}

}  // namespace
}  // namespace espalier::tests::planes_test
