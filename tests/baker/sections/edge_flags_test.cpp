// Claims about edge flags: each is what the triangles that share the edge say, worked out anew without limits of width.
#include "support/testing.hpp"

#include <Eigen/Geometry>

#include "baker/baking_support.hpp"
#include "support/exact/as_rationals.hpp"
#include "support/meshes/files.hpp"

namespace espalier::tests::edge_flags_test {
namespace {

using oracle::Point;

Point between(const GridPoint& from, const GridPoint& to) { return exact_point(to) - exact_point(from); }

using Corners3 = std::array<GridPoint, 3>;

EdgeKind kind_of(const Corners3& here, unsigned edge, const Corners3& there, unsigned other_edge,
                 std::uint32_t flat_limit) {
    const Point normal = between(here[0], here[1]).cross(between(here[0], here[2]));
    const Point other = between(there[0], there[1]).cross(between(there[0], there[2]));
    const Point turn = normal.cross(other);
    const Rational unit(std::int64_t{1} << 24);
    if (normal.dot(other).sign() > 0 &&
        turn.dot(turn) * unit <= Rational(std::int64_t{flat_limit}) * normal.dot(normal) * other.dot(other))
        return EdgeKind::flat;
    const Rational height = normal.dot(between(here[edge], there[(other_edge + 2) % 3]));
    return height.sign() > 0 ? EdgeKind::concave : EdgeKind::convex;
}

/// The flags of every triangle of the blob, by its own decoder, a map of edges and unlimited integers.
std::vector<std::array<EdgeKind, 3>> expected_kinds(const DecodedBlob& decoded) {
    std::vector<Corners3> triangles;
    for (const GridTriangle& t : decoded.triangles) triangles.push_back({t.a, t.b, t.c});
    using Use = std::pair<std::uint32_t, unsigned>;
    std::map<std::pair<GridPoint, GridPoint>, std::vector<Use>> uses;  // by ends, as the triangle runs along it
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (decoded.owners[i] != i) continue;
        for (unsigned e = 0; e < 3; ++e) uses[{triangles[i][e], triangles[i][(e + 1) % 3]}].push_back({i, e});
    }
    std::vector<std::array<EdgeKind, 3>> kinds(triangles.size(),
                                               {EdgeKind::boundary, EdgeKind::boundary, EdgeKind::boundary});
    for (const auto& [ends, along] : uses) {
        const auto back = uses.find({ends.second, ends.first});
        if (along.size() != 1 || back == uses.end() || back->second.size() != 1) continue;
        const Use here = along[0];
        const Use there = back->second[0];
        kinds[here.first][here.second] =
            kind_of(triangles[here.first], here.second, triangles[there.first], there.second, decoded.flat_limit);
    }
    for (std::uint32_t i = 0; i < triangles.size(); ++i) kinds[i] = kinds[decoded.owners[i]];
    return kinds;
}

/// How often each kind was found.
std::array<std::uint64_t, 4> check_kinds(const OpenedBlob& opened) {
    const DecodedBlob decoded = decode(opened.bytes);
    const auto expected = expected_kinds(decoded);
    std::array<std::uint64_t, 4> counts{};
    REQUIRE(decoded.edge_flags.size() == expected.size());
    for (std::uint32_t i = 0; i < expected.size(); ++i) {
        const Result<EdgeKinds> kinds = edge_kinds(opened.blob, TriangleId{i});
        REQUIRE(kinds);
        const std::array<EdgeKind, 3> found = {kinds->ab, kinds->bc, kinds->ca};
        for (std::size_t edge = 0; edge < 3; ++edge) {
            CAPTURE(i);
            CAPTURE(edge);
            REQUIRE(found[edge] == expected[i][edge]);
            REQUIRE(decoded.edge_flags[i][edge] == static_cast<std::uint8_t>(expected[i][edge]));
            ++counts[decoded.edge_flags[i][edge]];
        }
    }
    return counts;
}

BakeOptions with_flags(Profile profile, double degrees = 5.0, unsigned bits = 16) {
    BakeOptions options = {.resolution = Resolution::bits(bits), .profile = profile, .flat_angle = degrees};
    return options;
}

using Counts = std::array<std::uint64_t, 4>;

TEST_CASE("edge flags: a cube has flat diagonals and convex edges and inside out concave ones") {
    for_each_profile([](Profile profile) {
        Mesh cube = make_cube(0.0f, 1.0f);
        CHECK(check_kinds(OpenedBlob(cube, with_flags(profile))) == Counts{12, 24, 0, 0});
        for (auto& triangle : cube.triangles) std::swap(triangle[0], triangle[1]);
        CHECK(check_kinds(OpenedBlob(cube, with_flags(profile))) == Counts{12, 0, 24, 0});
    });
}

TEST_CASE("edge flags: every mesh and lattice and profile gives the flags of unbounded arithmetic") {
    Counts all{};
    for (const Mesh& mesh :
         {make_terrain(20, 7), make_soup(300, 2), make_slivers(200, 3), make_needle_fan(200),
          make_coplanar_stacks(200, 5), make_icosphere(3, 1.0, {0, 0, 0}), make_torus(24, 12, 2.0, 0.7)}) {
        CAPTURE(mesh.name);
        for_each_profile([&](Profile profile) {
            for (const unsigned bits : {4u, 16u, 24u}) {
                CAPTURE(bits);
                for (const double degrees : {0.0, 5.0, 60.0}) {
                    const Counts counts = check_kinds(OpenedBlob(mesh, with_flags(profile, degrees, bits)));
                    for (std::size_t k = 0; k < 4; ++k) all[k] += counts[k];
                }
            }
        });
    }
    for (const std::uint64_t count : all) CHECK(count > 1000);
}

TEST_CASE("edge flags: meshes from files give the flags of unbounded arithmetic") {
    for (const char* file : {"fandisk.obj", "house.obj"}) {
        const auto path = mesh_file(file);
        if (!path) {
            MESSAGE("SKIPPED: no mesh ", std::string(file));
            continue;
        }
        const Mesh mesh = read_mesh(*path);
        for_each_profile([&](Profile profile) { CHECK(check_kinds(OpenedBlob(mesh, with_flags(profile)))[0] > 0); });
    }
}

TEST_CASE("edge flags: a blob without an open edge is closed and without slivers and fins the reverse holds") {
    for (const Mesh& mesh : {make_cube(0.0f, 1.0f), make_terrain(5, 1), make_torus(20, 12, 3.0, 1.0), make_soup(50, 1),
                             make_coplanar_stacks(50, 5)}) {
        CAPTURE(mesh.name);
        const OpenedBlob opened(mesh, with_flags(Profile::balanced));
        CHECK(opened.blob.is_closed() == (check_kinds(opened)[3] == 0));
    }
    Mesh fin = make_cube(0.0f, 1.0f);  // a third triangle on an edge of the first triangle
    fin.positions.push_back({2.0f, 3.0f, 4.0f});
    fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1], 8});
    CHECK(check_kinds(OpenedBlob(fin, with_flags(Profile::fast)))[3] == 5);
}

TEST_CASE("edge flags: a copy has the flags of its owner") {
    BakeOptions options = with_flags(Profile::fast);
    options.build.builder = Builder::spatial_splits;
    options.build.duplicate_budget = 1.0;
    const OpenedBlob opened(make_soup(500, 4), options);
    REQUIRE(opened.blob.duplicate_reference_count() > 0);
    check_kinds(opened);
}

TEST_CASE("edge flags: the flat angle decides to the lattice step which edges are flat") {
    // Two triangles over an edge of 4096 steps, the second lifted by one step at a time: tan(angle) = lift / 4096.
    for (const double degrees : {0.0, 0.1, 1.0, 5.0, 45.0}) {
        CAPTURE(degrees);
        std::uint32_t flat = 0;
        const auto is_flat = [&](std::uint32_t lift) {
            Mesh roof = {.positions = {{0, 0, 0}, {4096, 0, 0}, {0, 4096, 0}, {0, -4096, -static_cast<float>(lift)}},
                         .triangles = {{0, 1, 2}, {1, 0, 3}}};
            BakeOptions options = with_flags(Profile::fast, degrees, 14);
            const OpenedBlob opened(roof, options);
            REQUIRE(opened.blob.lattice().step_exponent == 0);
            return check_kinds(opened)[0] == 2;
        };
        REQUIRE(is_flat(0));
        for (std::uint32_t step = 2048; step != 0; step /= 2)
            if (flat + step <= 8000 && is_flat(flat + step)) flat += step;
        const double angle = std::atan2(flat, 4096.0) * 180.0 / 3.14159265358979323846;
        const double next = std::atan2(flat + 1.0, 4096.0) * 180.0 / 3.14159265358979323846;
        if (degrees < 45.0) {
            CHECK(angle <= degrees);
            CHECK(next > degrees * 0.98 - 0.001);  // the squared sine is stored in 2^-24
        }
    }
}

TEST_CASE("edge flags: a blob without them has no byte for them and the same tree") {
    for_each_profile([](Profile profile) {
        const Mesh mesh = make_terrain(10, 1);
        BakeOptions options = with_profile(profile);
        const auto without = bake_or_throw(mesh, options);
        options.flat_angle = 5.0;
        options.bounds = {true, true, true};
        const auto with = bake_or_throw(mesh, options);
        CHECK(!OpenedBlob(without).blob.has_edge_flags());
        CHECK(edge_kinds(OpenedBlob(without).blob, {0}).status == QueryStatus::no_data);
        CHECK(std::equal(without.begin() + format::header::bytes, without.end(), with.begin() + format::header::bytes));
        const std::size_t flag_bits = OpenedBlob(with).blob.triangle_count() * format::edge_flags::triangle_bits;
        const std::size_t more = format::edge_flags::fields_at + ((flag_bits + 7) / 8 + 3) / 4 * 4 + 32 + 16 + 80;
        CHECK(with.size() == without.size() + more);
        CHECK(with == bake_or_throw(mesh, options));
    });
}

TEST_CASE("edge flags: an empty mesh has no flags and no bounds and senseless angles are refused") {
    BakeOptions options = {.flat_angle = 5.0, .bounds = {true, true, true}};
    const OpenedBlob empty(bake({}, options).bytes);
    CHECK(!empty.blob.has_edge_flags());
    CHECK(detail::data_of(empty.blob).bounds == nullptr);
    for (const double degrees : {-1.0, 90.0, 1e300, std::nan("")}) {
        options.flat_angle = degrees;
        check_refused(bake({}, options), BakeStatus::invalid_options, {"degrees"});
    }
}

}  // namespace
}  // namespace espalier::tests::edge_flags_test
