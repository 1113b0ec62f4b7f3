// Claims about contacts: what slides over inner edges does not feel them, and what meets a real one does.
#include "support/testing.hpp"

namespace espalier::tests::contact_test {
namespace {

BakeOptions with_flags(Profile profile) {
    BakeOptions options = {.profile = profile, .flat_angle = 5.0};
    return options;
}

float length(Vec3 a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

/// The contacts of a sphere as a collision engine makes them: with each triangle that it touches, on its own.
std::vector<ClosestPoint> contacts_of(const Blob& blob, const Sphere& sphere) {
    std::vector<ClosestPoint> contacts(blob.triangle_count());
    contacts.resize(closest_triangles(blob, sphere.center, contacts, sphere.radius).count);
    return contacts;
}

Vec3 normal_of(const ClosestPoint& contact, const Sphere& sphere) {
    const Vec3 away = difference(sphere.center, contact.point);
    const float distance = length(away);
    return {away.x / distance, away.y / distance, away.z / distance};
}

TEST_CASE("contact: a sphere that slides over a floor gets the normal of the floor at every contact") {
    for_each_profile([](Profile profile) {
        const OpenedBlob floor(make_plane_grid(6), with_flags(profile));
        const Vec3 low = floor.blob.bounds().min;
        const Vec3 high = floor.blob.bounds().max;
        const Vec3 side = difference(high, low);
        // The grid may lie in any plane: up is where it has no extent.
        const int up = side.x == 0.0f ? 0 : side.y == 0.0f ? 1 : 2;
        const float size = std::max({side.x, side.y, side.z});
        std::uint64_t corrected = 0, slanted = 0;
        for (int step = 0; step <= 200; ++step) {
            const float at = 0.2f + 0.6f * static_cast<float>(step) / 200.0f;
            float center[3] = {low.x + at * side.x, low.y + (0.3f + 0.4f * at) * side.y, low.z + at * side.z};
            const float radius = 0.15f * size;
            center[up] += 0.9f * radius;
            const Sphere sphere = {{center[0], center[1], center[2]}, radius};
            for (const ClosestPoint& each : contacts_of(floor.blob, sphere)) {
                const Vec3 normal = normal_of(each, sphere);
                const Vec3 fixed = fix_internal_edge_normal(floor.blob, each.triangle, each.feature, normal);
                const float before[3] = {normal.x, normal.y, normal.z};
                const float after[3] = {fixed.x, fixed.y, fixed.z};
                slanted += before[up] < 0.99f ? 1u : 0u;
                corrected += fixed == normal ? 0u : 1u;
                REQUIRE(after[up] > 0.9999f);
            }
        }
        CHECK(slanted > 100);  // else there would be nothing to correct
        CHECK(corrected >= slanted);
    });
}

TEST_CASE("contact: a sphere that rolls over the ridge of a box keeps the normal of the contact") {
    for_each_profile([](Profile profile) {
        const OpenedBlob box(make_cube(-1.0f, 1.0f), with_flags(profile));
        for (int step = 1; step < 16; ++step) {
            // Around the ridge at x = 1, z = 1.
            const float angle = static_cast<float>(step) / 16.0f * 1.5707963f;
            const Vec3 away = {std::sin(angle), 0.0f, std::cos(angle)};
            const Vec3 center = {1.0f + 0.45f * away.x, 0.1f, 1.0f + 0.45f * away.z};
            float least = 1.0f;
            Vec3 deepest;
            const Sphere sphere = {center, 0.5f};
            for (const ClosestPoint& each : contacts_of(box.blob, sphere)) {
                const Vec3 normal =
                    fix_internal_edge_normal(box.blob, each.triangle, each.feature, normal_of(each, sphere));
                if (each.distance < least) least = each.distance, deepest = normal;
            }
            CHECK(least < 0.4501f);
            CHECK(length(difference(deepest, away)) < 1e-3f);
        }
    });
}

TEST_CASE("contact: the feature names the edges of a contact and limits its normal") {
    for_each_profile([](Profile profile) {
        const OpenedBlob box(make_cube(-1.0f, 1.0f), with_flags(profile));
        for (std::uint32_t i = 0; i < 12; ++i) {
            const Result<EdgeKinds> found = edge_kinds(box.blob, {i});
            REQUIRE(found);
            const EdgeKinds& kinds = *found;
            const Triangle corners = *triangle_at(box.blob, {i});
            const Vec3 out = {corners.a.x + corners.b.x + corners.c.x, corners.a.y + corners.b.y + corners.c.y,
                              corners.a.z + corners.b.z + corners.c.z};
            struct At {
                Feature feature;
                bool inner;
            };
            const bool ab = kinds.ab == EdgeKind::flat;
            const bool bc = kinds.bc == EdgeKind::flat;
            const bool ca = kinds.ca == EdgeKind::flat;
            REQUIRE(int{ab} + int{bc} + int{ca} == 1);
            // Two of a triangle's edges are ridges, so that each corner is on one.
            for (const At& at : {At{Feature::face, false}, At{Feature::edge_ab, ab}, At{Feature::edge_bc, bc},
                                 At{Feature::edge_ca, ca}, At{Feature::vertex_a, false}, At{Feature::vertex_b, false},
                                 At{Feature::vertex_c, false}, At{static_cast<Feature>(7), false}}) {
                const int feature = static_cast<int>(at.feature);
                CAPTURE(feature);
                const Vec3 normal = fix_internal_edge_normal(box.blob, {i}, at.feature, out);
                REQUIRE((normal != out) == at.inner);
                if (at.inner) {
                    CHECK(length(normal) == 1.0f);
                    CHECK(normal.x * out.x + normal.y * out.y + normal.z * out.z > 2.9f);
                    const Vec3 behind = fix_internal_edge_normal(box.blob, {i}, at.feature, {-out.x, -out.y, -out.z});
                    CHECK(behind == Vec3{-normal.x, -normal.y, -normal.z});
                }
            }
        }
    });
}

TEST_CASE("contact: concave edges are internal and boundaries are not and without flags none is") {
    for_each_profile([](Profile profile) {
        Mesh valley = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}, {0, -1, 1}}, .triangles = {{0, 1, 2}, {1, 0, 3}}};
        const OpenedBlob with(valley, with_flags(profile));
        const OpenedBlob without(valley, with_profile(profile));
        for (std::uint32_t i = 0; i < 2; ++i) {
            const Result<EdgeKinds> found = edge_kinds(with.blob, {i});
            REQUIRE(found);
            const EdgeKinds& kinds = *found;
            const std::array<EdgeKind, 3> all = {kinds.ab, kinds.bc, kinds.ca};
            CHECK(std::count(all.begin(), all.end(), EdgeKind::concave) == 1);
            CHECK(std::count(all.begin(), all.end(), EdgeKind::boundary) == 2);
            constexpr Feature edges[3] = {Feature::edge_ab, Feature::edge_bc, Feature::edge_ca};
            for (std::size_t edge = 0; edge < 3; ++edge) {
                const Vec3 up = {0, 0, 2};
                CHECK((fix_internal_edge_normal(with.blob, {i}, edges[edge], up) != up) ==
                      (all[edge] == EdgeKind::concave));
                CHECK(fix_internal_edge_normal(without.blob, {i}, edges[edge], up) == up);
                CHECK(fix_internal_edge_normal(with.blob, {2}, edges[edge], up) == up);
                CHECK(fix_internal_edge_normal(Blob(), {i}, edges[edge], up) == up);
            }
        }
        CHECK(edge_kinds(with.blob, {2}).status == QueryStatus::invalid_argument);
        CHECK(edge_kinds(with.blob, no_triangle).status == QueryStatus::not_found);
        CHECK(edge_kinds(without.blob, {0}).status == QueryStatus::no_data);
        CHECK(edge_kinds(Blob(), {0}).status == QueryStatus::not_open);
    });
}

TEST_CASE("contact: a corner between two internal edges is internal and one on a boundary is not") {
    for_each_profile([](Profile profile) {
        const OpenedBlob floor(make_plane_grid(4), with_flags(profile));
        std::uint64_t inner = 0, outer = 0;
        for (std::uint32_t i = 0; i < floor.blob.triangle_count(); ++i) {
            const Result<EdgeKinds> found = edge_kinds(floor.blob, {i});
            REQUIRE(found);
            const EdgeKinds& kinds = *found;
            const bool open[3] = {kinds.ab == EdgeKind::boundary, kinds.bc == EdgeKind::boundary,
                                  kinds.ca == EdgeKind::boundary};
            constexpr Feature corners[3] = {Feature::vertex_a, Feature::vertex_b, Feature::vertex_c};
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 normal = {1, 2, 3};
                const bool expected = !open[k] && !open[(k + 2) % 3];
                REQUIRE((fix_internal_edge_normal(floor.blob, {i}, corners[k], normal) != normal) == expected);
                ++(expected ? inner : outer);
            }
        }
        CHECK(inner > 0);
        CHECK(outer > 0);
    });
}

TEST_CASE("contact: a normal of any bits becomes a unit normal or stays") {
    Random random(8);
    for (const TestBlob& blob : small_test_blobs()) {
        for (int i = 0; i < 2'000; ++i) {
            const auto any = [&] { return hostile_values[random.below(hostile_values.size())]; };
            const TriangleId triangle = {random.below(blob.opened.blob.triangle_count() + 2)};
            const auto feature = static_cast<Feature>(random.below(256));
            const Vec3 given = {any(), any(), any()};
            const Vec3 normal = fix_internal_edge_normal(blob.opened.blob, triangle, feature, given);
            if (std::memcmp(&normal, &given, sizeof normal) != 0) CHECK(std::abs(length(normal) - 1.0f) < 1e-6f);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::contact_test
