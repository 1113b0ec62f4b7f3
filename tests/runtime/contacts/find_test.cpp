// Claims about contacts: those of a body are those of a loop over all triangles, each by the reference in double.
#include "support/testing.hpp"

#include "support/queries/shape_maker.hpp"
#include "support/queries/sweep_maker.hpp"
#include "support/queries/winding_points.hpp"

#include "touched.hpp"

namespace espalier::tests::find_test {
namespace {

/// A body as the reference has it: the hull of points, grown by a radius.
struct Body {
    Points points;
    double radius = 0.0;

    [[nodiscard]] Point middle() const {
        Point sum;
        for (const Point& p : points) sum = sum + p;
        return (1.0 / static_cast<double>(points.size())) * sum;
    }
    [[nodiscard]] double reach() const {
        double most = 0.0;
        for (const Point& p : points) most = std::max(most, reference::length(p - middle()));
        return most + radius;
    }
};
Body body_of(const Sphere& sphere) { return {{to_point(sphere.center)}, static_cast<double>(sphere.radius)}; }
Body body_of(const Capsule& capsule) {
    return {{to_point(capsule.from), to_point(capsule.to)}, static_cast<double>(capsule.radius)};
}
Body body_of(const OrientedBox& box) { return {corners_of(to_point(box.center), box.half_axes)}; }

Body body_of(const OwnedHull& hull) {
    Body body;
    for (const Vec3& vertex : hull.vertices) body.points.push_back(to_point(vertex));
    return body;
}

/// The triangles of a blob in the world, and what its lattice lets a shape be off.
struct Surface {
    std::vector<Points> triangles;
    double step;
    double extent = 0.0;  ///< no coordinate is larger

    explicit Surface(const TestBlob& blob) : step(std::ldexp(1.0, blob.opened.blob.lattice().step_exponent)) {
        for (const reference::PointTriangle& t : reference::baked_surface(blob.opened.bytes)) {
            for (const Point& c : t) extent = std::max({extent, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
            triangles.emplace_back(t.begin(), t.end());
        }
    }
    [[nodiscard]] double tolerance(const Body& body) const {
        double size = body.reach() + reference::length(body.middle() - triangles[0][0]) + extent;
        return step / 8.0 + 0x1p-16 * size;
    }
};

/// Compares the contacts of a body whose middle is not inside a closed surface with the loop over all triangles.
template <class Shape>
std::uint64_t require_contacts_of_the_loop(const TestBlob& blob, const Surface& surface, const Shape& shape,
                                           float margin) {
    const Body body = body_of(shape);
    std::vector<Contact> contacts(surface.triangles.size() * 9);
    const Filled found = find_contacts(blob.opened.blob, query_shape(shape), margin, contacts);
    if (is_refused(found.status)) return 0;
    REQUIRE(found.status == QueryStatus::ok);
    contacts.resize(found.count);
    for (std::size_t i = 1; i < contacts.size(); ++i) REQUIRE(contacts[i - 1].distance <= contacts[i].distance);
    const double error = surface.tolerance(body), within = static_cast<double>(margin);
    std::uint64_t decided = 0;
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        if (blob.decoded.owners.size() > t && blob.decoded.owners[t] != t) continue;
        const auto of_triangle = [t](const Contact& contact) { return contact.triangle.index == t; };
        const auto first = std::find_if(contacts.begin(), contacts.end(), of_triangle);
        // Far triangles are far from the middle: most need no reference.
        const reference::PointTriangle corners = {surface.triangles[t][0], surface.triangles[t][1],
                                                  surface.triangles[t][2]};
        const double from_middle = std::sqrt(reference::squared_distance(body.middle(), corners));
        if (from_middle > body.reach() + within + error) {
            REQUIRE(first == contacts.end());
            continue;
        }
        const double separation = reference::signed_separation(body.points, surface.triangles[t]);
        const double expected = separation - body.radius;
        CAPTURE(t);
        CAPTURE(expected);
        if (expected > within + error) REQUIRE(first == contacts.end());
        // With edge flags some are left to a neighbor, and some normals are those of the face: internal_edges_test.cpp.
        if (expected < within - error && !edge_kinds(blob.opened.blob, {t})) REQUIRE(first != contacts.end());
        const bool is_turned = edge_kinds(blob.opened.blob, {t}) &&
                               std::any_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
                                   return of_triangle(contact) && contact.feature != Feature::face;
                               });
        if (first == contacts.end() || is_turned) continue;
        ++decided;
        const double distance = static_cast<double>(first->distance);
        // No way out is longer than the longest of the shortest ways.
        const bool is_limited = distance <= expected + error && distance == static_cast<double>(contacts[0].distance);
        const Beside beside = {body.points, surface.triangles[t], body.middle(), error,
                               static_cast<bool>(edge_kinds(blob.opened.blob, {t}))};
        REQUIRE((is_limited || beside.is_distance(distance + body.radius, separation)));
        REQUIRE(std::sqrt(reference::squared_distance(to_point(first->point), corners)) <= error);
    }
    // Fewer places than contacts: the deepest are kept.
    for (const std::size_t places : {std::size_t{0}, std::size_t{1}, contacts.size() / 2}) {
        std::vector<Contact> few(places);
        const Filled part = find_contacts(blob.opened.blob, query_shape(shape), margin, few);
        REQUIRE(part.count == std::min(places, contacts.size()));
        REQUIRE(part.status ==
                (!contacts.empty() && contacts.size() >= places ? QueryStatus::output_full : QueryStatus::ok));
        for (std::size_t i = 0; i < part.count; ++i) REQUIRE(few[i].distance == contacts[i].distance);
    }
    return decided;
}

/// Whether a point is inside a solid. Where triangles face inward, as in a room, surfaces wind the other way.
bool is_inside(const Blob& blob, const Point& middle) {
    const Vec3 at = {static_cast<float>(middle.x), static_cast<float>(middle.y), static_cast<float>(middle.z)};
    return blob.is_closed() && contains(blob, at).yes() && *winding_number(blob, at) > 0.0f;
}

TEST_CASE("contact: the contacts of a body are those of the loop over all triangles") {
    const std::uint64_t count = scaled_share(20);
    std::uint64_t decided = 0;
    for (const TestBlob& blob : small_test_blobs()) {
        if (blob.decoded.triangles.empty()) continue;
        CAPTURE(blob.name);
        const Surface surface(blob);
        ShapeMaker maker(blob.decoded, 99);
        SweepMaker hull_maker(blob.decoded, 98);
        for (std::uint64_t i = 0; i < count; ++i) {
            const bool awkward = i % 2 == 0;
            const float margin = i % 3 == 0 ? 0.0f : maker.size() * 0.01f * static_cast<float>(i % 5);
            const Capsule capsule = maker.capsule(awkward);
            const Sphere sphere = {capsule.from, capsule.radius};
            const OrientedBox box = maker.oriented_box(awkward);
            const auto check = [&](const auto& shape) {
                const Body body = body_of(shape);
                const bool is_of_use = std::isfinite(body.reach()) && body.reach() < 1e3 * surface.extent &&
                                       reference::length(body.middle()) < 1e3 * surface.extent;
                if (is_of_use && !is_inside(blob.opened.blob, body.middle()))
                    decided += require_contacts_of_the_loop(blob, surface, shape, margin);
            };
            check(sphere);
            check(capsule);
            check(box);
            OwnedHull hull = hull_maker.hull(awkward).shape;
            if (hull.vertices.size() > 10) hull.vertices.resize(10);  // the reference takes the cube of them
            check(hull);
        }
    }
    CHECK(decided > 100);
    MESSAGE(decided, " contacts");
}

TEST_CASE("contact: a body whose middle is inside a closed surface has one contact and leaves along it") {
    const std::uint64_t count = scaled_share(20);
    std::uint64_t inside = 0;
    for (const TestBlob& blob : closed_blobs()) {
        CAPTURE(blob.name);
        const Surface surface(blob);
        ShapeMaker maker(blob.decoded, 41);
        for (std::uint64_t i = 0; i < count; ++i) {
            Capsule capsule = maker.capsule(false);
            if (!std::isfinite(capsule.radius) || capsule.radius > maker.size()) continue;
            const Body body = body_of(capsule);
            if (!is_inside(blob.opened.blob, body.middle())) continue;
            std::vector<Contact> contacts(4);
            const Filled found = find_contacts(blob.opened.blob, capsule, 0.0f, contacts);
            if (is_refused(found.status)) continue;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Points& t : surface.triangles)
                nearest = std::min(nearest, reference::squared_distance(body.middle(), {t[0], t[1], t[2]}));
            const double error = surface.tolerance(body);
            if (std::sqrt(nearest) <= error) continue;  // on the surface, but for rounding
            ++inside;
            REQUIRE(found.count == 1);
            const Point normal = to_point(contacts[0].normal);
            const Point half = 0.5 * (body.points[1] - body.points[0]);
            const double reach = std::abs(reference::dot(half, normal)) + body.radius;
            REQUIRE(std::abs(static_cast<double>(contacts[0].distance) + std::sqrt(nearest) + reach) <= error);
        }
    }
    if (asks_enough()) CHECK(inside > count);
}

TEST_CASE("contact: in a room that is a closed surface of its own bodies meet the walls") {
    const std::uint64_t count = scaled_share(20);
    std::uint64_t decided = 0, in_rooms = 0;
    for (const TestBlob& blob : closed_blobs()) {
        CAPTURE(blob.name);
        const Surface surface(blob);
        ShapeMaker maker(blob.decoded, 43);
        for (std::uint64_t i = 0; i < count; ++i) {
            const Capsule capsule = maker.capsule(false);
            const Body body = body_of(capsule);
            if (!std::isfinite(capsule.radius) || capsule.radius > maker.size()) continue;
            if (is_inside(blob.opened.blob, body.middle())) continue;
            if (contains(blob.opened.blob, capsule.from).yes()) ++in_rooms;
            decided += require_contacts_of_the_loop(blob, surface, capsule, 0.0f);
        }
    }
    if (asks_enough()) CHECK(in_rooms > count);
    CHECK(decided > 20);
}

TEST_CASE("contact: a hull whose middle is inside a closed surface leaves along the way to its closest point") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    // The middle is that of the vertices: 0.75 at x.
    const Vec3 vertices[] = {{0.5f, 0.0f, 0.0f}, {0.5f, 0.25f, 0.0f}, {0.5f, 0.0f, 0.25f}, {1.5f, 0.0f, 0.0f}};
    std::vector<Contact> contacts(4);
    const Filled found = find_contacts(cube.blob, ConvexHull{vertices}, 0.0f, contacts);
    REQUIRE(found.status == QueryStatus::ok);
    REQUIRE(found.count == 1);
    CHECK(contacts[0].normal == Vec3{1.0f, 0.0f, 0.0f});
    CHECK(static_cast<double>(contacts[0].distance) == doctest::Approx(-0.5).epsilon(0.001));
}

TEST_CASE("contact: a hull on a floor keeps the rim that it stands on") {
    for_each_profile([](Profile profile) {
        const OpenedBlob floor(make_plane_grid(6), with_profile(profile));
        const Vec3 low = floor.blob.bounds().min, high = floor.blob.bounds().max;
        const float size = high.x - low.x, radius = 0.2f * size;
        const Vec3 middle = {low.x + 0.5f * size, low.y + 0.5f * size, low.z};
        // A prism of 16 sides.
        std::vector<Vec3> vertices;
        for (int i = 0; i < 32; ++i) {
            const float angle = static_cast<float>(i / 2) * 0.39269908f;
            vertices.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle),
                                middle.z + (i % 2 == 0 ? -0.01f : 0.3f) * size});
        }
        std::vector<Contact> contacts(500);
        const Filled found = find_contacts(floor.blob, ConvexHull{vertices}, 0.01f * size, contacts);
        REQUIRE(found.status == QueryStatus::ok);
        REQUIRE(found.count > 8);
        REQUIRE(reduce_contacts(found.in(contacts)) == 4);
        for (const Contact& contact : std::span(contacts).first(4)) {
            REQUIRE(contact.normal.z > 0.999f);
            REQUIRE(static_cast<double>(contact.distance / size) == doctest::Approx(-0.01).epsilon(0.01));
            REQUIRE(std::hypot(contact.point.x - middle.x, contact.point.y - middle.y) > 0.9f * radius);
        }
    });
}

TEST_CASE("contact: on a floor with edge flags every contact has the normal of the floor") {
    for_each_profile([](Profile profile) {
        const OpenedBlob floor(make_plane_grid(6), {.profile = profile, .flat_angle = 5.0});
        const Vec3 low = floor.blob.bounds().min, high = floor.blob.bounds().max;
        std::uint64_t inner = 0;
        for (int step = 1; step < 100; ++step) {
            const float share = static_cast<float>(step) / 100.0f;
            const Vec3 at = {low.x + share * (high.x - low.x), low.y + share * (high.y - low.y), low.z + 0.05f};
            std::vector<Contact> contacts(100);
            const Filled found = find_contacts(floor.blob, Sphere{at, 0.2f}, 0.0f, contacts);
            REQUIRE(found.status == QueryStatus::ok);
            REQUIRE(found.count > 0);
            for (const Contact& contact : found.in(contacts)) {
                const Result<EdgeKinds> kinds = edge_kinds(floor.blob, contact.triangle);
                const bool is_at_border = kinds->ab == EdgeKind::boundary || kinds->bc == EdgeKind::boundary ||
                                          kinds->ca == EdgeKind::boundary;
                if (is_at_border) continue;
                ++inner;
                REQUIRE(contact.normal == Vec3{0.0f, 0.0f, 1.0f});
                REQUIRE(static_cast<double>(contact.distance) == doctest::Approx(-0.15).epsilon(0.001));
                // Below the middle, so that the floor does not turn the ball.
                REQUIRE(std::abs(contact.point.x - at.x) + std::abs(contact.point.y - at.y) < 1e-4f);
                REQUIRE(std::abs(contact.point.z - low.z) < 1e-4f);
            }
        }
        CHECK(inner > 30);
    });
}

TEST_CASE("contact: every normal has length 1 where a leaning capsule has its middle in a floor") {
    Mesh ground = make_plane_grid(9);
    for (Vec3& p : ground.positions) p = {1.1f * p.x - 4.95f, 0.9f * p.y - 4.05f, 0.0f};  // no multiples of a step
    const OpenedBlob floor(ground, {.resolution = Resolution::bits(20), .flat_angle = 5.0});
    Random random(5);
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        Vec3 middle = triangle_at(floor.blob, {random.below(floor.blob.triangle_count())})->a;
        middle.z += 1e-6f * random.signed_unit();
        const Vec3 half = random.in_cube(0.3f);
        const Capsule capsule = {{middle.x - half.x, middle.y - half.y, middle.z - half.z},
                                 {middle.x + half.x, middle.y + half.y, middle.z + half.z},
                                 0.1f};
        std::array<Contact, 64> room;
        const Filled found = find_contacts(floor.blob, capsule, 0.05f, room);
        REQUIRE(found.count > 0);
        for (const Contact& contact : found.in(room)) {
            const Vec3& n = contact.normal;
            REQUIRE(std::abs(n.x * n.x + n.y * n.y + n.z * n.z - 1.0f) < 1e-5f);
        }
    }
}

TEST_CASE("contact: a reduction keeps a contact where no lever is a number") {
    std::vector<Contact> contacts(3);
    contacts[1].point.x = not_a_number;
    contacts[2].distance = -1.0f;
    const std::size_t kept = reduce_contacts(contacts);
    CHECK(kept > 0);
    CHECK(kept <= contacts.size());
    CHECK(contacts[0].distance == -1.0f);
}

TEST_CASE("contact: a box on a floor keeps its four corners and a capsule its two ends") {
    for_each_profile([](Profile profile) {
        const OpenedBlob floor(make_plane_grid(6), with_profile(profile));
        const Vec3 low = floor.blob.bounds().min, high = floor.blob.bounds().max;
        const float size = high.x - low.x;
        const Vec3 middle = {low.x + 0.5f * size, low.y + 0.5f * size, low.z};
        const Vec3 u = {0.21f * size, 0.05f * size, 0.0f}, v = {-0.04f * size, 0.17f * size, 0.0f};
        const OrientedBox box = {{middle.x, middle.y, middle.z + 0.1f * size}, {u, v, {0.0f, 0.0f, 0.1f * size}}};
        std::vector<Contact> contacts(500);
        const Filled found = find_contacts(floor.blob, box, 0.01f * size, contacts);
        REQUIRE(found.status == QueryStatus::ok);
        REQUIRE(found.count > 8);
        REQUIRE(reduce_contacts(found.in(contacts)) == 4);
        for (const Contact& contact : std::span(contacts).first(4)) {
            REQUIRE(contact.normal.z > 0.999f);
            const float across_u = std::abs((contact.point.x - middle.x) * u.x + (contact.point.y - middle.y) * u.y);
            const float across_v = std::abs((contact.point.x - middle.x) * v.x + (contact.point.y - middle.y) * v.y);
            // Not far from a corner: on a floor of triangles a neighbour may be nearer to none of those kept.
            REQUIRE(across_u > 0.8f * (u.x * u.x + u.y * u.y));
            REQUIRE(across_v > 0.8f * (v.x * v.x + v.y * v.y));
        }
        const float radius = 0.05f * size;
        const Capsule capsule = {{middle.x - u.x, middle.y - u.y, middle.z + radius},
                                 {middle.x + u.x, middle.y + u.y, middle.z + radius},
                                 radius};
        const Filled ends = find_contacts(floor.blob, capsule, 0.001f * size, contacts);
        REQUIRE(ends.count > 2);
        const std::size_t kept = reduce_contacts(ends.in(contacts));
        REQUIRE(kept >= 2);
        float least = 1.0f, most = -1.0f;
        for (const Contact& contact : std::span(contacts).first(kept)) {
            const float share =
                ((contact.point.x - middle.x) * u.x + (contact.point.y - middle.y) * u.y) / (u.x * u.x + u.y * u.y);
            least = std::min(least, share);
            most = std::max(most, share);
        }
        REQUIRE(least < -0.95f);
        REQUIRE(most > 0.95f);
    });
}

TEST_CASE("contact: a body in a corner keeps a contact with each wall") {
    // Three faces of a cube from inside: an open mesh, so that each is a sheet.
    Mesh corner = make_cube(0.0f, 2.0f);
    corner.triangles.erase(std::remove_if(corner.triangles.begin(), corner.triangles.end(),
                                          [&](const auto& t) {
                                              int walls = 0;
                                              for (int axis = 0; axis < 3; ++axis) {
                                                  const auto at = [&](std::uint32_t number) {
                                                      const Vec3& p = corner.positions[t[number]];
                                                      return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
                                                  };
                                                  walls += at(0) == 0.0f && at(1) == 0.0f && at(2) == 0.0f ? 1 : 0;
                                              }
                                              return walls == 0;
                                          }),
                           corner.triangles.end());
    const OpenedBlob walls(corner, {.flat_angle = 5.0});
    std::vector<Contact> contacts(50);
    const Filled found = find_contacts(walls.blob, Sphere{{0.4f, 0.45f, 0.48f}, 0.5f}, 0.0f, contacts);
    REQUIRE(found.status == QueryStatus::ok);
    const std::size_t kept = reduce_contacts(found.in(contacts));
    REQUIRE(kept >= 3);
    Vec3 sum;
    for (const Contact& contact : std::span(contacts).first(3)) {
        sum.x += contact.normal.x;
        sum.y += contact.normal.y;
        sum.z += contact.normal.z;
    }
    CHECK(static_cast<double>(sum.x) == doctest::Approx(1.0).epsilon(0.01));
    CHECK(static_cast<double>(sum.y) == doctest::Approx(1.0).epsilon(0.01));
    CHECK(static_cast<double>(sum.z) == doctest::Approx(1.0).epsilon(0.01));
    CHECK(static_cast<double>(contacts[0].distance) == doctest::Approx(-0.1).epsilon(0.01));
}

TEST_CASE("contact: refusals are those of overlaps and of the margin") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    std::vector<Contact> contacts(4);
    const float infinity = std::numeric_limits<float>::infinity();
    const Sphere sphere = {{0.0f, 0.0f, 1.2f}, 0.5f};
    CHECK(find_contacts(Blob(), sphere, 0.0f, contacts).status == QueryStatus::not_open);
    CHECK(find_contacts(Blob(), OrientedBox{}, 0.0f, contacts).status == QueryStatus::not_open);
    CHECK(find_contacts(Blob(), ConvexHull{}, 0.0f, contacts).status == QueryStatus::not_open);
    for (const float margin : {not_a_number, infinity, -1.0f}) {
        CHECK(find_contacts(cube.blob, sphere, margin, contacts).status == QueryStatus::invalid_argument);
        CHECK(find_contacts(cube.blob, Capsule{}, margin, contacts).status == QueryStatus::invalid_argument);
        CHECK(find_contacts(cube.blob, OrientedBox{}, margin, contacts).status == QueryStatus::invalid_argument);
        CHECK(find_contacts(cube.blob, ConvexHull{}, margin, contacts).status == QueryStatus::invalid_argument);
    }
    for (const float radius : {not_a_number, infinity, -1.0f}) {
        CHECK(find_contacts(cube.blob, Sphere{{}, radius}, 0.0f, contacts).status == QueryStatus::invalid_argument);
        CHECK(find_contacts(cube.blob, Capsule{{}, {}, radius}, 0.0f, contacts).status ==
              QueryStatus::invalid_argument);
    }
    CHECK(find_contacts(cube.blob, Sphere{{not_a_number, 0.0f, 0.0f}, 1.0f}, 0.0f, contacts).status ==
          QueryStatus::invalid_argument);
    CHECK(find_contacts(cube.blob, Capsule{{}, {1e30f, 0.0f, 0.0f}, 1.0f}, 0.0f, contacts).status ==
          QueryStatus::out_of_range);
    CHECK(find_contacts(cube.blob, Sphere{{9.0f, 0.0f, 0.0f}, 1.0f}, 0.0f, contacts).count == 0);
    CHECK(find_contacts(cube.blob, OrientedBox{{1e20f, 0.0f, 0.0f}, {}}, 0.0f, contacts).status == QueryStatus::ok);
    CHECK(find_contacts(cube.blob, sphere, 0.0f, {}).status == QueryStatus::output_full);
    std::vector<Vec3> vertices(max_hull_vertices, Vec3{0.0f, 0.0f, 1.0f});
    const auto status_of_hull = [&] { return find_contacts(cube.blob, ConvexHull{vertices}, 0.0f, contacts).status; };
    CHECK(status_of_hull() == QueryStatus::ok);
    vertices[5].y = not_a_number;
    CHECK(status_of_hull() == QueryStatus::invalid_argument);
    vertices[5].y = 1e20f;
    CHECK(status_of_hull() == QueryStatus::out_of_range);
    vertices.assign(max_hull_vertices, Vec3{0.0f, 0.0f, 1e20f});
    CHECK(status_of_hull() == QueryStatus::ok);  // far away
    vertices.assign(max_hull_vertices + 1, Vec3{});
    CHECK(status_of_hull() == QueryStatus::invalid_argument);
    CHECK(find_contacts(cube.blob, ConvexHull{}, 1.0f, contacts).count == 0);
    CHECK(reduce_contacts({}) == 0);
}

}  // namespace
}  // namespace espalier::tests::find_test
