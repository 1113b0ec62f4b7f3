// The lattice of a deformable blob holds the range of motion, and its triangles are those of the source.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/blobs/soundness.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::motion_test {
namespace {

BakeOptions deforming(unsigned bits = 16) {
    BakeOptions options = with_bits(bits);
    options.profile = Profile::fast;
    options.deformation.emplace();
    return options;
}

bool holds(const Box& outer, const Box& inner) {
    return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
           outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z;
}

TEST_CASE("deformation: without a range it is the box of mesh and poses and a tenth of the largest side around") {
    const Mesh mesh = make_torus(16, 8, 2.0, 0.5);
    BakeOptions options = deforming();
    options.deformation->poses = {posed(mesh, Motion::bend), posed(mesh, Motion::twist)};
    std::vector<std::vector<Vec3>> all = options.deformation->poses;
    all.push_back(mesh.positions);
    const Box box = box_around(all);
    const BakeResult result = bake_mesh(mesh, options);
    REQUIRE(result);
    const float side = longest_side(box);
    CHECK(result.report.motion.range.min.x == doctest::Approx(double(box.min.x - side / 10)));
    CHECK(result.report.motion.range.min.y == doctest::Approx(double(box.min.y - side / 10)));
    CHECK(result.report.motion.range.max.z == doctest::Approx(double(box.max.z + side / 10)));
    const DeformedMesh moving(mesh, options);
    // Ends are rounded to the lattice.
    const double step = std::ldexp(1.0, moving.still.lattice().step_exponent);
    CHECK(std::abs(double(moving.deformable.range().min.x) - double(result.report.motion.range.min.x)) <= step);
    CHECK(std::abs(double(moving.deformable.range().max.y) - double(result.report.motion.range.max.y)) <= step);
}

TEST_CASE("deformation: a range that is given grows to hold mesh and poses") {
    const Mesh mesh = make_plane_grid(5);
    BakeOptions options = deforming();
    options.deformation->range = Box{{0.25f, 0.25f, -3.0f}, {0.5f, 0.5f, 3.0f}};
    options.deformation->poses = {posed(mesh, Motion::wave)};
    const BakeResult result = bake_mesh(mesh, options);
    REQUIRE(result);
    const Box range = result.report.motion.range;
    CHECK(holds(range, box_around({mesh.positions, options.deformation->poses[0]})));
    CHECK(same_bits(range.min.z, -3.0f));
    CHECK(same_bits(range.max.z, 3.0f));
    CHECK(result.report.motion.positions == mesh.positions.size());
    CHECK(result.report.motion.moving_bytes == deformable_bytes(open(result.bytes)));
    CHECK(result.report.bounds.min.x == doctest::Approx(0.0).epsilon(1e-3));
}

TEST_CASE("deformation: every resolution holds the range and keeps the error that it states") {
    const Mesh mesh = make_terrain(10, 4);
    const std::array resolutions = {Resolution::bits(1),         Resolution::bits(9),  Resolution::bits(24),
                                    Resolution::tolerance(0.01), Resolution::step(-9), Resolution::step(-3)};
    for (const Resolution& resolution : resolutions) {
        BakeOptions options = deformable_options(mesh);
        options.resolution = resolution;
        DeformedMesh moving(mesh, options);
        for (const Motion motion : every_motion) {
            const std::vector<Vec3> pose = posed(mesh, motion);
            moving.move_to(pose);
            const DecodedBlob decoded = moving.decoded();
            REQUIRE(decoded.triangles == moving.expected_triangles(pose));
            REQUIRE(is_sound(decoded));
            double largest = 0.0;
            for (std::size_t i = 0; i < decoded.triangles.size(); ++i) {
                const auto corners = reference::world_corners(decoded, decoded.triangles[i]);
                for (unsigned c = 0; c < 3; ++c) {
                    const OriginalTriangle& source = moving.remap[i];
                    const Vec3& p = pose[mesh.triangles[source.triangle][(source.first_corner + c) % 3]];
                    largest = std::max(largest, reference::length(corners[c] - reference::to_point(p)));
                }
            }
            CHECK(largest <= double(moving.still.max_error()));
        }
    }
}

TEST_CASE("deformation: triangles of any shape stay and repetitions are dropped") {
    Mesh mesh = make_plane_grid(3);
    mesh.triangles.push_back({0, 0, 1});
    mesh.triangles.push_back({2, 2, 2});
    mesh.triangles.push_back(mesh.triangles.front());
    const auto [a, b, c] = mesh.triangles[1];
    mesh.triangles.push_back({b, c, a});
    mesh.triangles.push_back({c, b, a});  // another winding
    mesh.materials.clear();
    const DeformedMesh moving(mesh, deforming());
    CHECK(moving.report.tree.triangles == 18 + 3);
    CHECK(moving.report.findings.duplicate.count == 2);
    CHECK(verify(moving.baked).sound);
}

TEST_CASE("deformation: positions of many meshes are numbered in a row") {
    const Mesh cube = make_cube(0.0f, 1.0f), grid = make_plane_grid(2);
    const BakeResult result = bake_meshes({&cube, &grid}, deforming());
    REQUIRE(result);
    std::vector<std::byte> memory(result.bytes.size());
    Deformable moving = create_deformable(open(result.bytes), memory);
    REQUIRE(moving.position_count() == 8 + 9);
    std::vector<Vec3> positions = cube.positions;
    positions.insert(positions.end(), grid.positions.begin(), grid.positions.end());
    REQUIRE(refit(moving, positions));
    std::vector<std::byte> bytes(result.bytes.size());
    REQUIRE(seal(moving, bytes) == QueryStatus::ok);
    CHECK(bytes == result.bytes);
    positions[16].z = nanf("");
    CHECK(refit(moving, positions).position == 16);
}

TEST_CASE("deformation: a closed surface stays closed in every pose and an open one open") {
    DeformedMesh ball(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f})), cloth(make_plane_grid(4));
    for (const Motion motion : every_motion) {
        ball.move_to(posed(ball.mesh, motion));
        cloth.move_to(posed(cloth.mesh, motion));
        CHECK(ball.deformable.blob().is_closed());
        CHECK_FALSE(cloth.deformable.blob().is_closed());
    }
}

TEST_CASE("deformation: ids and materials are those of the source and a bake is the same on any threads") {
    Mesh mesh = make_terrain(12, 2);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.materials.push_back(static_cast<std::uint32_t>(i * 7 % 300));
    BakeOptions options = deformable_options(mesh);
    options.original_ids = true;
    options.threads = 1;
    DeformedMesh moving(mesh, options);
    options.threads = 2;
    CHECK(DeformedMesh(mesh, options).baked == moving.baked);
    moving.move_to(posed(mesh, Motion::twist));
    const Blob& blob = moving.deformable.blob();
    for (std::uint32_t i = 0; i < blob.triangle_count(); ++i) {
        const Result<OriginalTriangle> original = original_triangle(blob, TriangleId{i});
        REQUIRE(original);
        CHECK(*original == moving.remap[i]);
        CHECK(material(blob, TriangleId{i}) == mesh.materials[original->triangle]);
    }
}

}  // namespace
}  // namespace espalier::tests::motion_test
