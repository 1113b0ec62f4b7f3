// Claims about blobs with one step: where their sources share vertices, they share lattice points.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"
#include "support/meshes/splits.hpp"

namespace espalier::tests::seams_test {
namespace {

/// A place in whole steps from the world's origin.
using WorldSteps = std::array<double, 3>;

/// Where each position of the mesh is, as the blob has it.
std::map<std::uint32_t, WorldSteps> places_of(const Mesh& mesh, const OpenedBlob& opened) {
    const DecodedBlob decoded = decode(opened.bytes);
    std::map<std::uint32_t, WorldSteps> places;
    for (std::uint32_t i = 0; i < decoded.triangles.size(); ++i) {
        const Result<OriginalTriangle> original = original_triangle(opened.blob, {i});
        REQUIRE(original);
        const GridPoint* corners[3] = {&decoded.triangles[i].a, &decoded.triangles[i].b, &decoded.triangles[i].c};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            WorldSteps place{};
            for (std::size_t k = 0; k < 3; ++k)
                place[k] = std::ldexp(double(decoded.origin[k]), -decoded.step_exponent) + (*corners[corner])[k];
            const auto position = mesh.triangles[original->triangle][(original->first_corner + corner) % 3];
            const auto at = places.emplace(position, place).first;
            REQUIRE(at->second == place);
        }
    }
    return places;
}

WorldSteps nearest_steps(const Vec3& position, int exponent) {
    const float at[3] = {position.x, position.y, position.z};
    WorldSteps steps{};
    for (std::size_t k = 0; k < 3; ++k) steps[k] = std::nearbyint(std::ldexp(double(at[k]), -exponent));
    return steps;
}

BakeOptions with_step(int exponent) { return {.resolution = Resolution::step(exponent), .original_ids = true}; }

TEST_CASE("seams: parts of a mesh baked apart with one step share their border vertices bit for bit") {
    std::uint64_t shared = 0;
    const auto splits = static_cast<std::uint32_t>(scaled(100));
    for (std::uint32_t number = 0; number < splits; ++number) {
        const Split split = make_split(number);
        CAPTURE(split.name);
        const int step_exponent = static_cast<int>(split.options.resolution.value());
        std::map<std::uint32_t, WorldSteps> places;  // of the whole's positions
        for (const Split::Part& part : split.parts) {
            const OpenedBlob opened(part.mesh, split.options);
            REQUIRE(opened.blob.triangle_count() == part.mesh.triangles.size());
            for (const auto& [position, place] : places_of(part.mesh, opened)) {
                REQUIRE(place == nearest_steps(part.mesh.positions[position], step_exponent));
                const auto [at, is_new] = places.emplace(part.in_whole[position], place);
                REQUIRE(at->second == place);
                shared += is_new ? 0 : 1;
            }
        }
    }
    CHECK(shared > 20 * splits);
}

TEST_CASE("seams: the step is the one given for meshes of any size and place") {
    Random random(4);
    for (int i = 0; i < 50; ++i) {
        const int exponent = random.between(-90, 90);
        Mesh mesh = scaled_by(make_icosphere(1, 1.0, random.in_cube(1000.0f)), std::ldexp(1.0f, exponent + 8));
        const auto result = must_bake_mesh(mesh, with_step(exponent));
        CHECK(result.report.lattice.step == std::ldexp(1.0, exponent));
        CHECK(result.report.lattice.bits == 10);
        CHECK(result.report.lattice.max_error <= std::sqrt(0.75) * result.report.lattice.step * 1.000001);
        const DecodedBlob decoded = decode(result.bytes);
        for (std::size_t k = 0; k < 3; ++k) {
            const double steps = std::ldexp(double(decoded.origin[k]), -exponent);
            CHECK(steps == std::nearbyint(steps));
        }
    }
    const auto empty = must_bake_mesh({}, with_step(-3));
    CHECK(decode(empty.bytes).step_exponent == -3);
}

TEST_CASE("seams: the lattice of another blob gives its step") {
    for (const int exponent : {-9, -3, 2}) {
        const OpenedBlob other(make_icosphere(1, 30.0, {5.0f, 0.0f, 0.0f}), with_step(exponent));
        const auto result =
            bake_mesh(make_torus(20, 12, 30.0, 10.0), {.resolution = Resolution::same_as(other.blob.lattice())});
        REQUIRE(result);
        CHECK(result.report.lattice.step == std::ldexp(1.0, exponent));
    }
}

TEST_CASE("seams: a step is refused where the format has none") {
    const Mesh cube = make_cube(0.0f, 1.0f);
    check_refused(bake_mesh(cube, with_step(-101)), BakeStatus::invalid_options, {"from 2^-100 to 2^100"});
    check_refused(bake_mesh(cube, with_step(101)), BakeStatus::invalid_options, {"from 2^-100 to 2^100"});
    check_refused(bake_mesh(cube, with_step(-24)), BakeStatus::too_fine, {"the finest step is 2^-23"});
}

}  // namespace
}  // namespace espalier::tests::seams_test
