// Claims about the borders of blobs on one lattice: joined, their edges have the kinds that one blob of the whole has,
// and a body over a seam has the contacts of a floor without one.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"

namespace espalier::tests::join_borders_test {
namespace {

using Corners = std::array<std::array<float, 3>, 3>;

Corners corners_of(const Blob& blob, std::uint32_t index, Vec3 translation = {}) {
    const Triangle t = *triangle_at(blob, TriangleId{index});
    const auto moved = [&](Vec3 p) {
        return std::array<float, 3>{p.x + translation.x, p.y + translation.y, p.z + translation.z};
    };
    return {moved(t.a), moved(t.b), moved(t.c)};
}

/// The kinds of all edges of a blob, by the ends of each.
using KindsByEnds = std::map<std::array<std::array<float, 3>, 2>, EdgeKind>;

void add_kinds(const Blob& blob, Vec3 translation, KindsByEnds& kinds) {
    for (std::uint32_t index = 0; index < blob.triangle_count(); ++index) {
        const Corners at = corners_of(blob, index, translation);
        const EdgeKinds of_edges = *edge_kinds(blob, TriangleId{index});
        const EdgeKind each[] = {of_edges.ab, of_edges.bc, of_edges.ca};
        for (unsigned e = 0; e < 3; ++e) {
            const auto [place, is_new] = kinds.insert({{at[e], at[(e + 1) % 3]}, each[e]});
            REQUIRE((is_new || place->second == each[e]));  // the copies of a triangle are alike
        }
    }
}

/// The part of a mesh with the triangles whose middle is in one quadrant, moved.
Mesh quadrant_of(const Mesh& mesh, bool is_right, bool is_back, Vec3 way) {
    Mesh part = mesh;
    std::erase_if(part.triangles, [&](const auto& t) {
        float x = 0.0f, y = 0.0f;
        for (std::size_t k = 0; k < 3; ++k) {
            x += mesh.positions[t[k]].x;
            y += mesh.positions[t[k]].y;
        }
        return (x > 0.0f) != is_right || (y > 0.0f) != is_back;
    });
    return moved_by(part, way);
}

Mesh centred(Mesh mesh) {
    Vec3 low = mesh.positions[0], high = low;
    for (const Vec3& p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0.0f};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0.0f};
    }
    return moved_by(mesh, {-0.5f * (low.x + high.x), -0.5f * (low.y + high.y), 0.0f});
}

/// Four tiles of a ground, of which one lies elsewhere and is moved by its instance.
struct Tiles {
    std::vector<std::vector<std::byte>> bytes;
    std::vector<JoinedBlob> placed;

    Tiles(const Mesh& ground, const BakeOptions& options) {
        for (unsigned i = 0; i < 4; ++i) {
            const Vec3 way = i == 2 ? Vec3{-64.0f, 32.0f, 8.0f} : Vec3{};
            const BakeResult baked = bake_mesh(quadrant_of(ground, (i & 1u) != 0, (i & 2u) != 0, way), options);
            REQUIRE_MESSAGE(baked.status == BakeStatus::ok, baked.message);
            bytes.push_back(baked.bytes);
        }
        for (unsigned i = 0; i < 4; ++i) placed.push_back({bytes[i], i == 2 ? Vec3{64.0f, -32.0f, -8.0f} : Vec3{}});
    }
};

TEST_CASE("edge flags: the joined edges of tiles have the kinds that one blob of all has") {
    const Mesh ground = centred(make_terrain(16, 5));
    for_each_profile([&](Profile profile) {
        BakeOptions options = {.resolution = Resolution::step(-12), .profile = profile, .flat_angle = 5.0};
        if (profile == Profile::fast) options.build.builder = Builder::spatial_splits;
        const BakeResult whole = bake_mesh(ground, options);
        KindsByEnds expected, before, after;
        add_kinds(open(whole.bytes), {}, expected);
        Tiles tiles(ground, options);
        for (const JoinedBlob& tile : tiles.placed) add_kinds(open(tile.bytes), tile.translation, before);
        const JoinReport report = join_borders(tiles.placed);
        REQUIRE_MESSAGE(report.status == BakeStatus::ok, report.message);
        for (const JoinedBlob& tile : tiles.placed) {
            const VerifyReport verified = verify(tile.bytes);
            CHECK_MESSAGE(verified.sound, verified.message);
            add_kinds(open(tile.bytes), tile.translation, after);
        }
        std::uint64_t changed = 0;
        for (const auto& [ends, kind] : before) changed += kind != expected.at(ends) ? 1u : 0u;
        CHECK(changed == 2 * report.edges);
        CHECK(report.edges > 20);
        CHECK((after == expected));

        // Joined again, in another order, nothing changes; alone, a tile has its borders back.
        const auto joined = tiles.bytes;
        std::vector<JoinedBlob> turned(tiles.placed.rbegin(), tiles.placed.rend());
        CHECK(join_borders(turned).edges == report.edges);
        CHECK((tiles.bytes == joined));
        CHECK(join_borders(std::span(tiles.placed).first(1)).edges == 0);
        KindsByEnds alone;
        add_kinds(open(tiles.bytes[0]), {}, alone);
        for (const auto& [ends, kind] : alone) REQUIRE(kind == before.at(ends));
    });
}

/// A pyramid of 24 faces, whose edges are much flatter than its tip.
Mesh make_tip() {
    Mesh tip;
    tip.positions.push_back({});
    for (std::uint32_t i = 0; i < 24; ++i) {
        const double angle = 3.14159265358979 / 12.0 * i;
        tip.positions.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), -0.315f});
        tip.triangles.push_back({0, 1 + i, 1 + (i + 1) % 24});
    }
    return tip;
}

TEST_CASE("edge flags: a body over a seam of tiles has contacts as deep as over one blob and none leans on a floor") {
    Mesh ridge = centred(make_plane_grid(8));
    for (Vec3& p : ridge.positions) p.z = -0.364f * std::abs(p.x);
    const struct {
        Mesh mesh;
        double flat_angle;
        bool is_level;
    } grounds[] = {{centred(make_plane_grid(8)), 5.0, true}, {ridge, 45.0, false}, {make_tip(), 5.0, false}};
    for (const auto& ground : grounds) {
        CAPTURE(ground.flat_angle);
        const BakeOptions options = {.resolution = Resolution::step(-12), .flat_angle = ground.flat_angle};
        const OpenedBlob whole(ground.mesh, options);
        Tiles tiles(ground.mesh, options);
        const auto count_leaning = [&] {
            std::uint64_t leaning = 0;
            Random random(8);
            for (std::uint64_t i = 0; i < 2'000; ++i) {
                const float along = 0.3f * random.signed_unit(), off = i % 4 == 0 ? 0.0f : 0.05f * random.signed_unit();
                const Vec3 at = i % 2 == 0 ? Vec3{off, along, 1.0f} : Vec3{i % 3 == 0 ? off : along, off, 1.0f};
                const RayHit below = raycast(whole.blob, Ray{at, {0.0f, 0.0f, -1.0f}});
                REQUIRE(below);
                const Vec3 middle = {at.x, at.y, 1.09f - below.t};
                const Vec3 half =
                    i % 5 == 0 ? Vec3{} : Vec3{0.2f * random.signed_unit(), 0.2f * random.signed_unit(), 0.0f};
                const auto contacts = [&](const Blob& blob, Vec3 from, std::span<Contact> room) {
                    const Vec3 own = {middle.x - from.x, middle.y - from.y, middle.z - from.z};
                    const Capsule capsule = {
                        {own.x - half.x, own.y - half.y, own.z}, {own.x + half.x, own.y + half.y, own.z}, 0.1f};
                    return find_contacts(blob, capsule, 0.02f, room);
                };
                std::array<Contact, 128> room;
                REQUIRE(contacts(whole.blob, {}, room).count > 0);
                const float expected = room[0].distance;
                float deepest = 1.0f;
                for (const JoinedBlob& tile : tiles.placed) {
                    const Filled found = contacts(open(tile.bytes), tile.translation, room);
                    for (const Contact& contact : found.in(room)) {
                        leaning += contact.normal.z < 0.9999f ? 1u : 0u;
                        deepest = std::min(deepest, contact.distance);
                    }
                }
                CAPTURE(i);
                REQUIRE(std::abs(deepest - expected) < 1e-5f);
            }
            return leaning;
        };
        CHECK(count_leaning() > 100);
        REQUIRE(join_borders(tiles.placed).edges > 0);
        const std::uint64_t leaning = count_leaning();
        if (ground.is_level) CHECK(leaning == 0);
    }
}

TEST_CASE("edge flags: an edge at which four triangles meet is no border between two of their blobs") {
    const auto wing = [](float y, float z, bool is_turned) {
        Mesh mesh;
        mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.5f, y, z}};
        mesh.triangles = {{is_turned ? 1u : 0u, is_turned ? 0u : 1u, 2u}};
        return mesh;
    };
    Mesh roof = wing(0.0f, 1.0f, false);
    roof.positions.push_back({0.5f, 0.5f, 1.0f});
    roof.triangles.push_back({1, 0, 3});
    const BakeOptions options = {.resolution = Resolution::step(-8), .flat_angle = 5.0};
    auto left = must_bake_mesh(wing(-1.0f, 0.0f, true), options).bytes,
         right = must_bake_mesh(wing(1.0f, 0.0f, false), options).bytes, above = must_bake_mesh(roof, options).bytes;
    const JoinedBlob all[] = {{left, {}}, {right, {}}, {above, {}}};
    CHECK(join_borders(std::span(all).first(2)).edges == 1);
    CHECK(join_borders(all).edges == 0);
    const EdgeKinds kinds = *edge_kinds(open(left), TriangleId{0});
    CHECK((kinds.ab == EdgeKind::boundary && kinds.bc == EdgeKind::boundary && kinds.ca == EdgeKind::boundary));
}

TEST_CASE("edge flags: a blob that cannot be joined is refused by number and nothing is changed") {
    const Mesh ground = centred(make_terrain(8, 5));
    const BakeOptions options = {.resolution = Resolution::step(-8), .flat_angle = 5.0};
    const auto refused = [&](BakeOptions other, Vec3 off, const char* what) {
        Tiles tiles(ground, options);
        other.resolution = other.resolution.kind() == Resolution::Kind::step ? other.resolution : options.resolution;
        auto odd = bake_mesh(quadrant_of(ground, true, true, {}), other).bytes;
        tiles.placed[3] = {odd, off};
        const auto before = tiles.bytes;
        const JoinReport report = join_borders(tiles.placed);
        CHECK(report.status == BakeStatus::invalid_mesh);
        CHECK(report.message.find("blob 3") == 0);
        CHECK_MESSAGE(report.message.find(what) != std::string::npos, report.message);
        CHECK((tiles.bytes == before));
    };
    refused({}, {}, "flat_angle");
    refused({.flat_angle = 4.0}, {}, "another flat_angle");
    refused({.resolution = Resolution::step(-7), .flat_angle = 5.0}, {}, "step");
    refused(options, {0x1p-9f, 0.0f, 0.0f}, "whole number of lattice steps");
    refused(options, {not_a_number, 0.0f, 0.0f}, "whole number of lattice steps");
    Tiles tiles(ground, options);
    tiles.bytes[1][20] ^= std::byte{1};
    CHECK(join_borders(tiles.placed).message.find("blob 1") == 0);
    CHECK(join_borders({}).status == BakeStatus::ok);
}

}  // namespace
}  // namespace espalier::tests::join_borders_test
