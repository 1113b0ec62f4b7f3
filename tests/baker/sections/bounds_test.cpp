// Claims about the bounds of the whole asset: they hold every vertex, and little else.
#include "support/testing.hpp"

#include <baker/sections/fit_bounds.hpp>

#include "baker/baking_support.hpp"
#include "support/meshes/files.hpp"

namespace espalier::tests::sections_bounds_test {
namespace {

BakeOptions with_bounds(unsigned bits = 16) {
    return {.resolution = Resolution::bits(bits), .bounds = {true, true, true}};
}

/// The rotation's rows, from the textbook's formula for a quaternion times its squared length.
std::array<std::array<std::int64_t, 3>, 3> rows_of(const std::vector<std::int32_t>& box) {
    const std::int64_t w = box[0], x = box[1], y = box[2], z = box[3];
    return {{{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
             {2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
             {2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}}};
}

/// Whether all bounds hold all vertices, by the tests' own decoder.
void check_bounds(const OpenedBlob& opened) {
    const DecodedBlob decoded = decode(opened.bytes);
    REQUIRE(decoded.oriented_box.size() == 10);
    REQUIRE(decoded.sphere.size() == 4);
    REQUIRE(decoded.k_dop.size() == 20);
    const auto rows = rows_of(decoded.oriented_box);
    std::int64_t norm = 0;
    for (std::size_t k = 0; k < 4; ++k) norm += std::int64_t{decoded.oriented_box[k]} * decoded.oriented_box[k];
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            std::int64_t dot = 0;
            for (std::size_t k = 0; k < 3; ++k) dot += rows[i][k] * rows[j][k];
            REQUIRE(dot == (i == j ? norm * norm : 0));
        }
    }
    std::array<std::array<std::int64_t, 2>, 3> slack;  // of the box: how far the nearest vertex is from each side
    slack.fill({INT64_MAX, INT64_MAX});
    for (const GridPoint& p : distinct_corners(decoded)) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t at = 16 * (rows[k][0] * p[0] + rows[k][1] * p[1] + rows[k][2] * p[2]);
            slack[k][0] = std::min(slack[k][0], at - norm * decoded.oriented_box[4 + k]);
            slack[k][1] = std::min(slack[k][1], norm * decoded.oriented_box[7 + k] - at);
        }
        std::int64_t squared = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t side = std::int64_t{16} * p[k] - decoded.sphere[k];
            squared += side * side;
        }
        REQUIRE(squared <= std::int64_t{decoded.sphere[3]} * decoded.sphere[3]);
    }
    for (const auto& sides : slack) {
        for (const std::int64_t side : sides) {
            REQUIRE(side >= 0);
            REQUIRE(side < norm);  // rounded to a sixteenth of a step
        }
    }
    constexpr std::int32_t directions[10][3] = {{1, 1, 0},  {1, -1, 0}, {1, 0, 1},  {1, 0, -1}, {0, 1, 1},
                                                {0, 1, -1}, {1, 1, 1},  {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
    for (std::size_t k = 0; k < std::size(directions); ++k) {
        std::int32_t low = INT32_MAX;
        std::int32_t high = INT32_MIN;
        for (const GridPoint& p : distinct_corners(decoded)) {
            const std::int32_t at = directions[k][0] * p[0] + directions[k][1] * p[1] + directions[k][2] * p[2];
            low = std::min(low, at);
            high = std::max(high, at);
        }
        REQUIRE(decoded.k_dop[2 * k] == low);
        REQUIRE(decoded.k_dop[2 * k + 1] == high);
    }
}

/// A box with sides 1, 2 and 5, turned.
Mesh turned_box(Random& random) {
    std::array<double, 4> q;
    double length = 0.0;
    for (double& part : q) {
        part = double(random.signed_unit());
        length += part * part;
    }
    for (double& part : q) part /= std::sqrt(length);
    const auto [w, x, y, z] = q;
    Mesh mesh = make_cube(-1.0f, 1.0f);
    for (Vec3& p : mesh.positions) {
        const double a = 0.5 * double(p.x);
        const double b = 1.0 * double(p.y);
        const double c = 2.5 * double(p.z);
        p = {
            static_cast<float>((w * w + x * x - y * y - z * z) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c),
            static_cast<float>(2 * (x * y + w * z) * a + (w * w - x * x + y * y - z * z) * b + 2 * (y * z - w * x) * c),
            static_cast<float>(2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b +
                               (w * w - x * x - y * y + z * z) * c)};
    }
    return mesh;
}

TEST_CASE("bounds: every vertex is inside on every mesh and lattice and profile") {
    for (const Mesh& mesh :
         {make_cube(-1.0f, 1.0f), make_icosphere(3, 1.0, {0.5f, -3.0f, 0.25f}), make_terrain(20, 7),
          make_needle_fan(300), make_slivers(400, 3), make_soup(300, 9), make_plane_grid(6), make_far_sphere()}) {
        CAPTURE(mesh.name);
        for (const unsigned bits : {1u, 2u, 8u, 16u, 24u}) {
            CAPTURE(bits);
            for_each_profile([&](Profile profile) {
                const OpenedBlob opened(mesh, with_profile(profile, with_bounds(bits)));
                if (opened.blob.triangle_count() != 0) check_bounds(opened);  // coarse lattices leave none of some
            });
        }
    }
}

TEST_CASE("bounds: every vertex of a mesh from a file is inside") {
    for (const auto& path : mesh_files()) {
        CAPTURE(path.string());
        const OpenedBlob opened(read_mesh(path), with_bounds());
        check_bounds(opened);
        CHECK(verify(opened.bytes).message == "");
    }
}

TEST_CASE("bounds: the oriented box of a rotated box is that box to a thousandth") {
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        CAPTURE(i);
        const auto baked = must_bake_mesh(turned_box(random), with_bounds());
        CHECK(baked.report.bounds.volumes.oriented_box >= 0.999 * 10.0);
        CHECK(baked.report.bounds.volumes.oriented_box <= 1.006 * 10.0);
    }
}

TEST_CASE("bounds: the sphere of a ball is the ball and never exceeds the sphere around the box") {
    for (const Mesh& mesh : {make_icosphere(4, 1.0, {7.0f, -3.0f, 0.25f}), make_terrain(20, 7), make_soup(100, 3),
                             make_needle_fan(300), make_cube(-1.0f, 3.0f), make_torus(24, 12, 2.0, 0.7)}) {
        CAPTURE(mesh.name);
        const auto baked = must_bake_mesh(mesh, with_bounds());
        const auto cubed = [](double x) { return x * x * x; };
        const Vec3 low = baked.report.bounds.min;
        const Vec3 high = baked.report.bounds.max;
        const double x = double(high.x) - double(low.x);
        const double y = double(high.y) - double(low.y);
        const double z = double(high.z) - double(low.z);
        constexpr double ball = 4.0 / 3.0 * 3.14159265358979323846;
        const double around_box = ball * cubed(0.5 * std::sqrt(x * x + y * y + z * z));
        CHECK(baked.report.bounds.volumes.sphere <= 1.004 * around_box);
        if (mesh.name.find("icosphere") != std::string::npos) CHECK(baked.report.bounds.volumes.sphere <= 1.004 * ball);
    }
}

TEST_CASE("bounds: the 26-DOP is smaller than the box and that of a cube is the cube") {
    const auto cube = bake_mesh(make_cube(0.0f, 2.0f), with_bounds());
    CHECK(cube.report.bounds.volumes.box == doctest::Approx(8.0));
    CHECK(cube.report.bounds.volumes.k_dop == doctest::Approx(8.0));
    CHECK(cube.report.bounds.volumes.oriented_box == doctest::Approx(8.0).epsilon(1e-4));
    const auto ball = bake_mesh(make_icosphere(4, 1.0, {0, 0, 0}), with_bounds());
    CHECK(ball.report.bounds.volumes.box == doctest::Approx(8.0).epsilon(0.01));
    CHECK(ball.report.bounds.volumes.k_dop < 0.65 * 8.0);  // that of the ball itself is 0.52
    CHECK(ball.report.bounds.volumes.k_dop > 0.52 * 8.0);
}

TEST_CASE("verify: a vertex outside each of the bounds and a wrong edge flag are found") {
    BakeOptions options = with_bounds();
    options.flat_angle = 5.0;
    const auto good = bake_or_throw(make_terrain(10, 1), options);
    const std::size_t size = good.size();
    const auto verdict_with = [&](std::size_t from_end, int by) {
        auto bad = good;
        put(bad, size - from_end, get(bad, size - from_end, 4) + static_cast<std::uint64_t>(by), 4);
        repair_checksum(bad);
        return verify(bad).message;
    };
    CHECK(verdict_with(80, 0) == "");
    for (std::size_t slab = 0; slab < 10; ++slab) {
        CHECK(contains(verdict_with(80 - 8 * slab, -1), "26-DOP"));
        CHECK(contains(verdict_with(80 - 8 * slab - 4, 1), "26-DOP"));
    }
    CHECK(contains(verdict_with(84, -1), "lies outside of the sphere"));  // its radius is rounded up by less than one
    for (std::size_t side = 0; side < 3; ++side) {
        CHECK(contains(verdict_with(96 + 12 - 4 * side, -1), "lies outside of the oriented box"));
        CHECK(contains(verdict_with(96 + 24 - 4 * side, 1), "lies outside of the oriented box"));
    }
    CHECK(contains(verdict_with(128 + 8, 1), "calls its edge"));
}

}  // namespace
}  // namespace espalier::tests::sections_bounds_test
