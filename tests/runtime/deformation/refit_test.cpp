// What a refit writes: the same bytes for the same positions, the baked ones for those of the bake.
#include "support/testing.hpp"

#include "support/blobs/deformed_mesh.hpp"
#include "support/machine/exact_buffer.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::refit_test {
namespace {

std::vector<Mesh> meshes_that_move() {
    return {make_plane_grid(20), make_icosphere(3, 1.0, {-7.0f, 0.0f, 2.0f}), make_soup(300, 9)};
}

bool are_same(std::span<const std::byte> a, std::span<const std::byte> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

Box steps_box(const DeformedMesh& moving, std::span<const Vec3> positions) {
    const auto triangles = moving.expected_triangles(positions);
    GridPoint low = triangles.front().a, high = low;
    for (const GridTriangle& t : triangles)
        for (const GridPoint& p : {t.a, t.b, t.c})
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
    const Lattice lattice = moving.still.lattice();
    const auto world = [&](const GridPoint& p) {
        const auto one = [&](std::int32_t steps, float origin) {
            return static_cast<float>(double(origin) + std::ldexp(double(steps), lattice.step_exponent));
        };
        return Vec3{one(p[0], lattice.origin.x), one(p[1], lattice.origin.y), one(p[2], lattice.origin.z)};
    };
    return {world(low), world(high)};
}

TEST_CASE("deformation: the positions of the bake give the baked bytes") {
    for (const Mesh& mesh : meshes_that_move())
        for (const unsigned bits : {6u, 16u, 17u, 24u}) {
            CAPTURE(mesh.name);
            CAPTURE(bits);
            DeformedMesh moving(mesh, bits);
            CHECK(moving.move_to(mesh.positions) == 1.0f);
            CHECK(moving.sealed() == moving.baked);
            moving.move_to(posed(mesh, Motion::twist));
            CHECK(moving.sealed() != moving.baked);
            moving.move_to(mesh.positions);
            CHECK(moving.sealed() == moving.baked);
        }
}

TEST_CASE("deformation: a pose has the same bytes by every path") {
    for (const Mesh& mesh : meshes_that_move()) {
        CAPTURE(mesh.name);
        DeformedMesh straight(mesh), roundabout(mesh);
        for (const Motion motion : every_motion) {
            const std::vector<Vec3> pose = posed(mesh, motion);
            DeformedMesh fresh(mesh);
            const float quality = fresh.move_to(pose);
            roundabout.move_to(posed(mesh, Motion::noise, 1.0, 77));
            roundabout.move_to(posed(mesh, Motion::point));
            CHECK(same_bits(roundabout.move_to(pose), quality));
            CHECK(same_bits(straight.move_to(pose), quality));
            CHECK(straight.sealed() == fresh.sealed());
            CHECK(roundabout.sealed() == fresh.sealed());
        }
    }
}

TEST_CASE("deformation: a sealed pose opens and is sound and deforms again") {
    for (const Mesh& mesh : meshes_that_move()) {
        DeformedMesh moving(mesh, 20);
        for (const Motion motion : every_motion) {
            moving.move_to(posed(mesh, motion));
            const std::vector<std::byte> bytes = moving.sealed();
            const Blob blob = open(bytes);
            REQUIRE(blob);
            CHECK(blob.is_deformable());
            const VerifyReport report = verify(bytes);
            CHECK_MESSAGE(report.sound, report.message);
            std::vector<std::byte> memory(deformable_bytes(blob));
            Deformable again = create_deformable(blob, memory);
            REQUIRE(again);
            REQUIRE(refit(again, mesh.positions));
            std::vector<std::byte> rest(bytes.size());
            REQUIRE(seal(again, rest) == QueryStatus::ok);
            CHECK(rest == moving.baked);
        }
    }
}

TEST_CASE("deformation: the bounds of the blob are those of the pose and its lattice stays") {
    for (const Mesh& mesh : meshes_that_move()) {
        CAPTURE(mesh.name);
        DeformedMesh moving(mesh);
        for (const Motion motion : every_motion) {
            const std::vector<Vec3> pose = posed(mesh, motion);
            moving.move_to(pose);
            const Box bounds = moving.deformable.blob().bounds(), expected = steps_box(moving, pose);
            CHECK(same_bits(bounds.min, expected.min));
            CHECK(same_bits(bounds.max, expected.max));
            CHECK(moving.deformable.blob().lattice().step_exponent == moving.still.lattice().step_exponent);
            CHECK(same_bits(moving.deformable.blob().lattice().origin, moving.still.lattice().origin));
        }
    }
}

TEST_CASE("deformation: a mesh moves in the bytes of its own blob") {
    const Mesh mesh = make_plane_grid(12);
    DeformedMesh apart(mesh);
    std::vector<std::byte> bytes = apart.baked;
    const Blob blob = open(bytes);
    Deformable in_place = create_deformable(blob, bytes);
    REQUIRE(in_place);
    const std::vector<Vec3> pose = posed(mesh, Motion::bend);
    REQUIRE(refit(in_place, pose));
    apart.move_to(pose);
    REQUIRE(seal(in_place, bytes) == QueryStatus::ok);
    CHECK(bytes == apart.sealed());
    REQUIRE(open(bytes));
}

TEST_CASE("deformation: memory may have any alignment and nothing beyond it is read or written") {
    const Mesh mesh = make_torus(12, 7, 2.0, 0.6);
    DeformedMesh reference(mesh, 18);
    const std::vector<Vec3> pose = posed(mesh, Motion::wave);
    reference.move_to(pose);
    for (std::size_t misalignment = 0; misalignment < 8; ++misalignment) {
        ExactBuffer memory(std::vector<std::byte>(deformable_bytes(reference.still)), misalignment);
        ExactBuffer baked(reference.baked, misalignment + 1);
        Deformable moving = create_deformable(open(baked.bytes()), memory.bytes());
        REQUIRE(moving);
        REQUIRE(refit(moving, pose));
        std::vector<std::byte> bytes(reference.baked.size());
        REQUIRE(seal(moving, bytes) == QueryStatus::ok);
        CHECK(bytes == reference.sealed());
        CHECK(are_same(baked.bytes(), reference.baked));
    }
}

TEST_CASE("deformation: another deformable mesh starts in the pose of the one that it copies") {
    const Mesh mesh = make_plane_grid(8);
    DeformedMesh first(mesh);
    first.move_to(posed(mesh, Motion::fold));
    std::vector<std::byte> memory(deformable_bytes(first.deformable.blob()));
    Deformable second = create_deformable(first.deformable.blob(), memory);
    REQUIRE(second);
    std::vector<std::byte> bytes(first.baked.size());
    REQUIRE(seal(second, bytes) == QueryStatus::ok);
    CHECK(bytes == first.sealed());
    REQUIRE(refit(second, mesh.positions));
    REQUIRE(seal(second, bytes) == QueryStatus::ok);
    CHECK(bytes == first.baked);
    CHECK(first.sealed() != first.baked);
}

TEST_CASE("deformation: a copy of the blob has the latest pose") {
    const Mesh mesh = make_plane_grid(4);
    DeformedMesh moving(mesh);
    const Blob copy = moving.deformable.blob();
    const Vec3 middle = mesh.positions[mesh.positions.size() / 2];
    const Ray ray = {.origin = {middle.x + 0.01f, middle.y + 0.02f, middle.z + 9.0f}, .direction = {0, 0, -1}};
    REQUIRE(raycast(copy, ray));
    const float before = raycast(copy, ray).t;
    std::vector<Vec3> lower = mesh.positions;
    const float by = (moving.deformable.range().max.z - moving.deformable.range().min.z) / 4;
    for (Vec3& p : lower) p.z -= by;
    moving.move_to(lower);
    REQUIRE(raycast(copy, ray));
    CHECK(raycast(copy, ray).t == doctest::Approx(double(before + by)).epsilon(1e-3));
}

TEST_CASE("deformation: quality is 1 at rest and grows when the tree fits less") {
    const Mesh mesh = make_plane_grid(32);
    DeformedMesh moving(mesh);
    CHECK(moving.move_to(mesh.positions) == 1.0f);
    const float noise = moving.move_to(posed(mesh, Motion::noise));
    CHECK(noise > 1.5f);
    CHECK(moving.move_to(posed(mesh, Motion::bend, 0.2)) < noise);
    CHECK(moving.move_to(mesh.positions) == 1.0f);
}

TEST_CASE("deformation: vertices without triangles and repeated corners and equal positions move along") {
    Mesh mesh = make_plane_grid(4);
    mesh.positions.push_back({0.5f, 0.5f, 0.25f});  // of no triangle
    mesh.positions.push_back(mesh.positions.front());
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    mesh.triangles.push_back({last, last, 3});
    mesh.triangles.push_back({last, last, last});
    mesh.triangles.push_back({0, 1, last});
    mesh.materials.clear();
    DeformedMesh moving(mesh);
    CHECK(moving.deformable.position_count() == mesh.positions.size());
    CHECK(moving.still.triangle_count() == mesh.triangles.size());
    for (const Motion motion : every_motion) {
        const std::vector<Vec3> pose = posed(mesh, motion, 1.0, 5);
        moving.move_to(pose);
        CHECK(moving.decoded().triangles == moving.expected_triangles(pose));
    }
}

}  // namespace
}  // namespace espalier::tests::refit_test
