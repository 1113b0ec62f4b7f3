// Claims about welding, collapsed triangles and duplicates.
#include "support/testing.hpp"

#include <ctime>

#include "baker/baking_support.hpp"

namespace espalier::tests::drop_test {
namespace {

/// The same surface with three vertices of its own for every triangle.
Mesh torn_apart(const Mesh& mesh) {
    Mesh torn = {.name = mesh.name};
    for (const auto& [a, b, c] : mesh.triangles)
        append_triangle(torn, mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    return torn;
}

/// Checks that ten times the triangles take less than forty times the processor's time; in squared time it is a
/// hundred.
template <class Bake>
void check_linear_time(Bake bake, std::uint32_t most) {
    if (!takes_every_case()) most /= 10;
    const auto time_of = [&](std::uint32_t count) {
        const std::clock_t start = std::clock();
        bake(count);
        return std::clock() - start;
    };
    const std::clock_t few = time_of(most / 10);
    CHECK(time_of(most) < 40 * few);
}

TEST_CASE("weld: shared and unshared indices give the same bytes") {
    for (const Mesh& mesh : {make_icosphere(4, 1.0, {0, 0, 0}), make_terrain(20, 2), make_needle_fan(50)}) {
        const auto shared = must_bake_mesh(mesh);
        const auto torn = must_bake_mesh(torn_apart(mesh));
        CHECK(shared.bytes == torn.bytes);
        CHECK(shared.report.tree.vertices == torn.report.tree.vertices);
    }
}

TEST_CASE("weld: the vertex count is the number of distinct lattice points") {
    for (const unsigned bits : {4u, 8u, 16u}) {
        const auto result = must_bake_mesh(make_icosphere(4, 1.0, {0, 0, 0}), with_bits(bits));
        const DecodedBlob decoded = decode(result.bytes);
        CHECK(decoded.vertex_count == distinct_corners(decoded).size());
    }
}

TEST_CASE("weld: triangles that lose their area on the lattice are dropped and counted") {
    const Mesh mesh = make_icosphere(5, 1.0, {0, 0, 0});
    const auto result = must_bake_mesh(mesh, with_bits(4));
    CHECK(result.report.findings.collapsed.count > 1000);
    CHECK(contains(result.report.findings.collapsed.first, ", triangle "));
    CHECK(result.report.tree.triangles + result.report.findings.collapsed.count +
              result.report.findings.duplicate.count ==
          mesh.triangles.size());
    for (const GridTriangle& triangle : decode(result.bytes).triangles) {
        CHECK(triangle.a != triangle.b);
        CHECK(triangle.b != triangle.c);
        CHECK(triangle.c != triangle.a);
    }
    CHECK(verify(result.bytes));
}

TEST_CASE("weld: the first of several triangles with the same corners and winding is kept") {
    Mesh cube = make_cube(0.0f, 1.0f);
    const auto [a, b, c] = cube.triangles[4];
    cube.triangles.push_back({a, b, c});
    cube.triangles.push_back({b, c, a});
    cube.triangles.push_back({c, a, b});
    cube.name = "cube";
    const auto result = must_bake_mesh(cube, {.original_ids = true});
    CHECK(result.report.tree.triangles == 12);
    CHECK(result.report.findings.duplicate.count == 3);
    CHECK(result.report.findings.duplicate.first == "cube, triangle 12");
    REQUIRE(result.report.findings.duplicate.place);
    CHECK(result.report.findings.duplicate.place->triangle == 12u);
    const DecodedBlob decoded = decode(result.bytes);
    for (const std::uint32_t id : decoded.original_ids) CHECK(id < 12);
}

TEST_CASE("weld: the same corners with the other winding are another triangle") {
    Mesh cube = make_cube(0.0f, 1.0f);
    const auto [a, b, c] = cube.triangles[4];
    cube.triangles.push_back({b, a, c});
    const auto result = must_bake_mesh(cube);
    CHECK(result.report.tree.triangles == 13);
    CHECK(result.report.findings.duplicate.count == 0);
}

TEST_CASE("weld: triangles that become equal on the lattice are duplicates") {
    Mesh mesh = make_cube(0.0f, 1.0f);
    Mesh nearly = make_cube(0.0f, 1.0f);
    for (Vec3& point : nearly.positions) point.x += 1e-7f;
    append(mesh, nearly);
    const auto result = must_bake_mesh(mesh);
    CHECK(result.report.tree.triangles == 12);
    CHECK(result.report.findings.duplicate.count == 12);
}

TEST_CASE("weld: a million identical triangles become one in linear time") {
    const std::uint32_t most = scaled(1) >= 10 ? 10'000'000 : 1'000'000;  // ten million need some gigabytes
    const auto bake_many = [](std::uint32_t count) {
        Mesh mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
        mesh.triangles.assign(count, {0, 1, 2});
        const auto shared = must_bake_mesh(mesh);
        const auto torn = must_bake_mesh(torn_apart(mesh));
        CHECK(shared.report.tree.triangles == 1);
        CHECK(shared.report.findings.duplicate.count == count - 1);
        CHECK(shared.bytes.size() < 512);
        CHECK(shared.report.tree.nodes == 1);
    };
    check_linear_time(bake_many, most);
}

TEST_CASE("weld: a million different triangles in one place bake in linear time") {
    // Specks around one lattice point beside a large triangle: every one collapses.
    const auto bake_specks = [](std::uint32_t count) {
        Mesh mesh = {.positions = {{0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}}, .triangles = {{0, 1, 2}}};
        Random random(5);
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto near = [&] {
                return Vec3{400 + random.unit() * 1e-3f, 300 + random.unit() * 1e-3f, random.unit() * 1e-3f};
            };
            append_triangle(mesh, near(), near(), near());
        }
        const auto result = must_bake_mesh(mesh);
        CHECK(result.report.tree.triangles == 1);
        CHECK(result.report.findings.collapsed.count == count);
        CHECK(result.report.lattice.max_error < 2 * result.report.lattice.step);
    };
    check_linear_time(bake_specks, 1'000'000);
}

TEST_CASE("weld: corners keep the winding of the source and its order from the first corner on") {
    for_each_profile([](Profile profile) {
        const Mesh mesh = make_terrain(9, 8);
        const DecodedBlob decoded = decode(bake_or_throw(mesh, {.profile = profile, .original_ids = true}));
        require_corners_of_source(decoded, mesh);
    });
}

}  // namespace
}  // namespace espalier::tests::drop_test
