// What create_deformable(), refit() and seal() refuse. A refused call changes nothing.
#include "support/testing.hpp"

#include "support/blobs/deformed_mesh.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::refusals_test {
namespace {

float& coordinate_of(Vec3& point, unsigned axis) { return axis == 0 ? point.x : axis == 1 ? point.y : point.z; }

/// Tests that a refit is refused with a status at a position, and that no byte changes.
void check_refusal(DeformedMesh& moving, const std::vector<Vec3>& positions, QueryStatus status,
                   std::uint32_t position) {
    const std::vector<std::byte> before = moving.memory;
    const RefitResult result = refit(moving.deformable, positions);
    CHECK(result.status == status);
    CHECK(result.position == position);
    CHECK(result.quality == 0.0f);
    CHECK_FALSE(result);
    CHECK(moving.memory == before);
}

TEST_CASE("deformation: a position that is not finite is refused by its number and changes nothing") {
    const Mesh mesh = make_plane_grid(6);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    for (const unsigned bits : {16u, 24u}) {
        DeformedMesh moving(mesh, bits);
        moving.move_to(posed(mesh, Motion::wave));
        for (const float bad : {not_a_number, -not_a_number, infinity, -infinity})
            for (std::uint32_t position = 0; position < count; ++position)
                for (unsigned axis = 0; axis < 3; ++axis) {
                    std::vector<Vec3> positions = mesh.positions;
                    coordinate_of(positions[position], axis) = bad;
                    if (position + 2 < count) coordinate_of(positions[position + 2], 0) = bad;
                    check_refusal(moving, positions, QueryStatus::invalid_argument, position);
                }
    }
}

TEST_CASE("deformation: a position is refused as out of range exactly beyond half a step outside") {
    const Mesh mesh = make_plane_grid(6);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    for (const unsigned bits : {5u, 16u, 17u, 24u}) {
        DeformedMesh moving(mesh, bits);
        const Lattice lattice = moving.still.lattice();
        const Box range = moving.deformable.range();
        for (std::uint32_t position = 0; position < count; position += 5)
            for (unsigned axis = 0; axis < 3; ++axis)
                for (const bool is_above : {false, true}) {
                    CAPTURE(bits);
                    CAPTURE(axis);
                    CAPTURE(is_above);
                    Vec3 low = range.min, high = range.max;
                    const double end = double(coordinate_of(is_above ? high : low, axis));
                    const double half = std::ldexp(is_above ? 0.5 : -0.5, lattice.step_exponent);
                    const auto outermost = static_cast<float>(end + half);
                    for (int ulps = -2; ulps <= 2; ++ulps) {
                        float at = outermost;
                        for (int i = 0; i < std::abs(ulps); ++i)
                            at = std::nextafter(at, (ulps > 0) == is_above ? (is_above ? 9e9f : -9e9f) : 0.5f);
                        const double steps = std::nearbyint(std::ldexp(double(at), -lattice.step_exponent));
                        const double end_steps = std::ldexp(end, -lattice.step_exponent);
                        const bool is_inside = is_above ? steps <= end_steps : steps >= end_steps;
                        std::vector<Vec3> positions = mesh.positions;
                        coordinate_of(positions[position], axis) = at;
                        if (is_inside) CHECK(refit(moving.deformable, positions));
                        else check_refusal(moving, positions, QueryStatus::out_of_range, position);
                    }
                    for (const float far : {1e6f, 1e20f, 3e38f, 8388608.0f, 12582912.0f, 16777216.0f}) {
                        std::vector<Vec3> positions = mesh.positions;
                        coordinate_of(positions[position], axis) = is_above ? far : -far;
                        check_refusal(moving, positions, QueryStatus::out_of_range, position);
                    }
                }
    }
}

TEST_CASE("deformation: another number of positions is refused with the first that is missing or left over") {
    const Mesh mesh = make_plane_grid(6);
    DeformedMesh moving(mesh);
    moving.move_to(posed(mesh, Motion::bend));
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<Vec3> positions = mesh.positions;
    positions.pop_back();
    check_refusal(moving, positions, QueryStatus::invalid_argument, count - 1);
    check_refusal(moving, {}, QueryStatus::invalid_argument, 0);
    positions.resize(count + 1);
    check_refusal(moving, positions, QueryStatus::invalid_argument, count);
}

TEST_CASE("deformation: a blob that is not open or not deformable and little memory are refused") {
    const Mesh mesh = make_plane_grid(6);
    DeformedMesh moving(mesh);
    std::vector<std::byte> memory(moving.memory.size());
    const Deformable none = create_deformable(Blob(), memory);
    CHECK(none.status() == QueryStatus::not_open);
    CHECK(none.position_count() == 0);
    CHECK(none.range().max == Vec3{});
    CHECK(deformable_bytes(Blob()) == 0);
    const OpenedBlob rigid(mesh, {.profile = Profile::fast});
    CHECK_FALSE(rigid.blob.is_deformable());
    CHECK(deformable_bytes(rigid.blob) == 0);
    CHECK(create_deformable(rigid.blob, memory).status() == QueryStatus::no_data);
    memory.pop_back();
    const std::vector<std::byte> before = memory;
    Deformable small = create_deformable(moving.still, memory);
    CHECK(small.status() == QueryStatus::no_room);
    CHECK(memory == before);
    CHECK(refit(small, mesh.positions).status == QueryStatus::no_room);
    CHECK_FALSE(small.blob());
    Deformable unmade;
    CHECK(unmade.status() == QueryStatus::not_open);
    CHECK(refit(unmade, mesh.positions).status == QueryStatus::not_open);
}

TEST_CASE("deformation: memory that overlaps the part that stays is refused and nothing changes") {
    const Mesh mesh = make_plane_grid(9);
    const DeformedMesh whole(mesh);
    const std::size_t moving = whole.memory.size(), size = whole.baked.size();
    std::vector<std::byte> bytes(size + moving + 16);
    const auto blob_at = [&](std::size_t offset) {
        std::fill(bytes.begin(), bytes.end(), std::byte{0});
        std::copy(whole.baked.begin(), whole.baked.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset));
        return open(std::span(bytes).subspan(offset, size));
    };
    for (const std::size_t offset : {std::size_t{1}, std::size_t{4}, size - moving, size - 1}) {
        const Blob blob = blob_at(0);
        const std::vector<std::byte> before = bytes;
        CHECK(create_deformable(blob, std::span(bytes).subspan(offset)).status() == QueryStatus::invalid_argument);
        CHECK(bytes == before);
    }
    CHECK(create_deformable(blob_at(0), std::span(bytes).subspan(size)));
    CHECK(create_deformable(blob_at(0), bytes));
    CHECK(create_deformable(blob_at(moving), bytes));
    CHECK(create_deformable(blob_at(3), bytes));  // the moving part begins three bytes lower
}

TEST_CASE("deformation: seal refuses bytes in which a part of the mesh lies at another place") {
    const Mesh mesh = make_plane_grid(9);
    const DeformedMesh whole(mesh);
    const std::size_t moving = whole.memory.size(), size = whole.baked.size();
    for (const std::size_t offset : {std::size_t{1}, std::size_t{100}, size - moving, moving, size - 1}) {
        std::vector<std::byte> bytes(2 * size);
        const Deformable mesh_there = create_deformable(whole.still, std::span(bytes).subspan(offset));
        REQUIRE(mesh_there);
        const std::vector<std::byte> before = bytes;
        CHECK(seal(mesh_there, std::span(bytes).first(size)) == QueryStatus::invalid_argument);
        CHECK(bytes == before);
    }
    std::vector<std::byte> bytes = whole.baked;  // the rest lies one byte beside its place
    bytes.insert(bytes.begin(), std::byte{0});
    const Blob blob = open(std::span(bytes).subspan(1));
    const Deformable in_place = create_deformable(blob, std::span(bytes).subspan(1));
    REQUIRE(in_place);
    CHECK(seal(in_place, std::span(bytes).first(size)) == QueryStatus::invalid_argument);
    CHECK(seal(in_place, std::span(bytes).subspan(1)) == QueryStatus::ok);
    CHECK(open(std::span(bytes).subspan(1)));
}

TEST_CASE("deformation: seal refuses another number of bytes and writes none of them") {
    const Mesh mesh = make_plane_grid(6);
    const DeformedMesh moving(mesh);
    for (const std::size_t size : {std::size_t{0}, moving.baked.size() - 1, moving.baked.size() + 1}) {
        std::vector<std::byte> bytes(size, std::byte{7});
        const std::vector<std::byte> before = bytes;
        CHECK(seal(moving.deformable, bytes) == QueryStatus::no_room);
        CHECK(bytes == before);
    }
    std::vector<std::byte> bytes(10);
    CHECK(seal(Deformable(), bytes) == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::refusals_test
