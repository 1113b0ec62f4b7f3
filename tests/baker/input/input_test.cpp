// Claims about what the baker refuses, drops and counts.
#include "support/testing.hpp"

#include <thread>

#include <baker/input/zero_area.hpp>

#include "baker/baking_support.hpp"

namespace espalier::tests::input_test {
namespace {

Mesh named_cube() {
    Mesh cube = make_cube(0.0f, 1.0f);
    cube.name = "level.obj, mesh 3 (walls)";
    return cube;
}

TEST_CASE("input: no meshes and meshes without triangles give an empty blob") {
    const auto nothing = bake({}, {});
    REQUIRE(nothing);
    CHECK(nothing.report.tree.triangles == 0);
    CHECK(decode(nothing.bytes).triangle_count == 0);

    Mesh only_points = make_cube(0.0f, 1.0f);
    only_points.triangles.clear();
    only_points.positions[0].x = not_a_number;  // used by no triangle, so of no interest
    const auto points = must_bake_meshes({&only_points, &only_points});
    CHECK(points.report.tree.nodes == 0);
    CHECK(points.report.tree.depth == 0);
    CHECK(points.report.lattice.max_error == 0.0);
    CHECK(points.report.source.vertices == 16);
    CHECK(bake_mesh(only_points, with_tolerance(0.001)));
}

TEST_CASE("input: a corner that is not finite is refused with mesh and triangle and coordinate") {
    for (const float broken : {not_a_number, infinity, -infinity}) {
        Mesh cube = named_cube();
        const std::uint32_t vertex = cube.triangles[7][1];
        cube.positions.push_back(cube.positions[vertex]);
        cube.positions.back().y = broken;
        cube.triangles[7][1] = static_cast<std::uint32_t>(cube.positions.size()) - 1;
        check_refused(bake_mesh(cube), BakeStatus::invalid_mesh,
                      {"level.obj, mesh 3 (walls), triangle 7: its second corner", "y = ", "drop_bad_triangles"});
    }
}

TEST_CASE("input: an index out of range is refused with mesh and triangle and index and vertex count") {
    for (const std::uint32_t broken : {8u, 0xFFFFFFFFu}) {
        Mesh cube = named_cube();
        cube.triangles[11][2] = broken;
        check_refused(
            bake_mesh(cube), BakeStatus::invalid_mesh,
            {"level.obj, mesh 3 (walls), triangle 11: its third corner", std::to_string(broken), "8 vertices"});
    }
}

TEST_CASE("input: an index into the vertices of the next mesh is out of range") {
    Mesh first = make_cube(0.0f, 1.0f);
    const Mesh second = make_cube(2.0f, 3.0f);
    first.triangles[0][0] = 8;
    CHECK(!bake_meshes({&first, &second}));
}

TEST_CASE("input: dropping bad triangles counts them and keeps the rest") {
    Mesh cube = named_cube();
    cube.positions.push_back({0.0f, infinity, 0.0f});
    cube.triangles[2][0] = 8;
    cube.triangles[5][1] = 9;
    cube.triangles[6][1] = 10;
    const auto result = must_bake_mesh(cube, {.drop_bad_triangles = true});
    CHECK(result.report.source.triangles == 12);
    CHECK(result.report.tree.triangles == 9);
    CHECK(result.report.findings.not_finite.count == 1);
    CHECK(result.report.findings.not_finite.first == "level.obj, mesh 3 (walls), triangle 2");
    CHECK(result.report.findings.index_out_of_range.count == 2);
    CHECK(result.report.findings.index_out_of_range.first == "level.obj, mesh 3 (walls), triangle 5");
}

TEST_CASE("input: an unnamed mesh is named by its number") {
    Mesh good = make_cube(0.0f, 1.0f);
    Mesh bad = good;
    good.name = bad.name = "";
    bad.triangles[4][0] = 100;
    check_refused(bake_meshes({&good, &bad}), BakeStatus::invalid_mesh, {"mesh 1, triangle 4:"});
}

TEST_CASE("input: source triangles without area are dropped and counted without an option") {
    Mesh cube = named_cube();
    cube.triangles.insert(cube.triangles.begin() + 3, {5, 5, 6});
    cube.triangles.push_back({1, 1, 1});
    const auto result = must_bake_mesh(cube);
    CHECK(result.report.tree.triangles == 12);
    CHECK(result.report.findings.zero_area.count == 2);
    CHECK(result.report.findings.zero_area.first == "level.obj, mesh 3 (walls), triangle 3");
    CHECK(result.report.findings.collapsed.count == 0);
}

TEST_CASE("input: zero area is decided exactly") {
    using baker::has_zero_area;
    CHECK(has_zero_area({1, 2, 3}, {1, 2, 3}, {9, 9, 9}));
    CHECK(has_zero_area({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
    CHECK(!has_zero_area({0, 0, 0}, {1, 2, 3}, {2, 4, 6.0000005}));
    // Far apart in size: differences of these are not exact, even in double.
    CHECK(has_zero_area({0x1p-120, 0, 0}, {0x1p100, 0, 0}, {-0x1p90, 0, 0}));
    CHECK(!has_zero_area({0, 0x1p-120, 0}, {0x1p100, 0, 0}, {-0x1p90, 0, 0}));
    const auto denormal = double(std::numeric_limits<float>::denorm_min());
    CHECK(has_zero_area({0, 0, 0}, {denormal, denormal, 0}, {3 * denormal, 3 * denormal, 0}));
    CHECK(!has_zero_area({0, 0, 0}, {denormal, denormal, 0}, {3 * denormal, 2 * denormal, 0}));
    const auto largest = double(std::numeric_limits<float>::max());
    CHECK(has_zero_area({-largest, -largest, 0}, {largest, largest, 0}, {0, 0, 0}));
    CHECK(!has_zero_area({-largest, -largest, 0}, {largest, largest, 0}, {0, denormal, 0}));
    Random random(7);
    for (int i = 0; i < 20'000; ++i) {
        // Three points on one line, exactly: small integers, shifted alike.
        const Vec3d along = {double(random.between(-999, 999)), double(random.between(-999, 999)),
                             double(random.between(-999, 999))};
        // Of float64: products take more bits than it has.
        const double far = random.coin() ? 0x1p47 : 0.0;
        const Vec3d from = {far + random.between(-99999, 99999), far + 77.0, -5.0};
        const auto at = [&](int share) {
            return Vec3d{from.x + share * along.x, from.y + share * along.y, from.z + share * along.z};
        };
        REQUIRE(has_zero_area(at(random.between(-50, 50)), at(random.between(-50, 50)), at(random.between(-50, 50))));
        Vec3d beside = at(60);
        beside.z += along.x != 0 || along.y != 0 ? 0x1p-30 : 0.0;
        if (along.x != 0 || along.y != 0) REQUIRE(!has_zero_area(at(0), at(1), beside));
    }
}

TEST_CASE("input: the number of materials is the number of triangles or zero") {
    Mesh cube = named_cube();
    cube.materials = {1, 2, 3};
    check_refused(bake_mesh(cube), BakeStatus::invalid_mesh,
                  {"level.obj, mesh 3 (walls): 3 materials for 12 triangles"});
}

TEST_CASE("input: materials take the least width that holds them and beyond 16 bits are refused by name") {
    Mesh cube = named_cube();
    const auto features = [&cube] {
        return decode(bake_or_throw(cube)).features & (format::feature::materials_8 | format::feature::materials_16);
    };
    CHECK(features() == 0);
    cube.materials.assign(12, 0);
    for (const std::uint32_t material : {0u, 1u, 255u, 256u, 65535u}) {
        CAPTURE(material);
        cube.materials[9] = material;
        CHECK(features() == (material == 0    ? 0
                             : material < 256 ? format::feature::materials_8
                                              : format::feature::materials_16));
    }
    cube.materials[9] = 65536;
    const auto refused = bake_mesh(cube);
    check_refused(refused, BakeStatus::too_large, {"level.obj, mesh 3 (walls), triangle 9: material 65536"});
    REQUIRE(refused.place);
    CHECK(refused.place->triangle == 9);
}

TEST_CASE("input: a refusal returns no bytes and no remap and does not convert to true") {
    Mesh cube = named_cube();
    cube.triangles[4][1] = 99;
    const BakeResult refused = bake_mesh(cube);
    check_refused(refused, BakeStatus::invalid_mesh, {});
    CHECK(refused.report.tree.triangles == 0);
    CHECK(remap_file(refused).empty());
    CHECK(!BakeResult());
}

TEST_CASE("input: options out of range are refused with the range") {
    const auto refused = [](BakeOptions options, const char* text) {
        check_refused(bake_mesh(make_cube(0.0f, 1.0f), options), BakeStatus::invalid_options, {text});
    };
    refused(with_bits(0), "1 to 24");
    refused(with_bits(25), "1 to 24");
    refused(with_tolerance(0.0), "above zero");
    refused(with_tolerance(-1e-9), "-1e-09");
    refused(with_tolerance(std::numeric_limits<double>::infinity()), "above zero");
    refused(with_tolerance(std::numeric_limits<double>::quiet_NaN()), "above zero");
    refused({.effort = static_cast<Effort>(3)}, "fast, normal or best");
    refused({.profile = static_cast<Profile>(4)}, "profile 4");
    refused({.build = {.builder = static_cast<Builder>(99)}}, "builder 99");
    refused({.profile = Profile::balanced, .build = {.builder = Builder::spatial_splits}}, "profile fast");
    refused({.build = {.duplicate_budget = 1.5}}, "0 to 1");
    refused({.build = {.duplicate_budget = std::numeric_limits<double>::quiet_NaN()}}, "0 to 1");
}

TEST_CASE("baker: progress rises from 0 to 1 in the calling thread") {
    const Mesh mesh = make_terrain(200, 3);
    BakeOptions options = {.threads = 4};
    const auto caller = std::this_thread::get_id();
    double last = 0.0;
    unsigned calls = 0;
    options.progress = [&](const char* stage, double done) {
        CHECK(std::this_thread::get_id() == caller);
        CHECK(stage[0] != '\0');
        CHECK(done >= last);
        CHECK(done <= 1.0);
        last = done;
        ++calls;
    };
    REQUIRE(bake_mesh(mesh, options));
    CHECK(last == 1.0);
    CHECK(calls >= 7);
}

}  // namespace
}  // namespace espalier::tests::input_test
