// Claims about the lattice: which one is chosen, and that sizes and places do not matter.
#include "support/testing.hpp"

#include <baker/quantise/lattice.hpp>

#include "baker/baking_support.hpp"

namespace espalier::tests::lattice_test {
namespace {

/// The bytes behind the header, and the header without what a change of scale may change.
std::vector<std::byte> without_scale(std::vector<std::byte> blob) {
    namespace header = format::header;
    const auto clear = [&](std::size_t at, std::size_t count) { std::memset(blob.data() + at, 0, count); };
    clear(header::checksum_at, 4);
    clear(header::step_exponent_at, 2);
    clear(header::origin_at, 12);
    clear(header::max_error_at, 4);
    return blob;
}

std::uint32_t largest_extent(const DecodedBlob& blob) {
    return std::max({blob.extent[0], blob.extent[1], blob.extent[2]});
}

TEST_CASE("lattice: scaling by a power of two changes only step and origin and error and checksum") {
    for (const Mesh& mesh : {make_terrain(20, 1), make_icosphere(3, 1.0, {0.3f, -7.0f, 2.0f}), make_soup(300, 2),
                             make_needle_fan(100), make_far_sphere()}) {
        const auto plain = must_bake_mesh(mesh);
        const DecodedBlob decoded = decode(plain.bytes);
        for (const int exponent : {20, -20, 60, -60}) {
            const auto scaled = must_bake_mesh(scaled_by(mesh, std::ldexp(1.0f, exponent)));
            CHECK(without_scale(scaled.bytes) == without_scale(plain.bytes));
            const DecodedBlob other = decode(scaled.bytes);
            CHECK(other.step_exponent == decoded.step_exponent + exponent);
            CHECK(other.max_error == std::ldexp(decoded.max_error, exponent));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                CHECK(other.origin[axis] == std::ldexp(decoded.origin[axis], exponent));
            }
        }
    }
}

TEST_CASE("lattice: scaling by a million keeps the triangles and the bits") {
    const Mesh mesh = make_torus(40, 20, 3.0, 1.0);
    for (const float factor : {1e6f, 1e-6f}) {
        const auto result = must_bake_mesh(scaled_by(mesh, factor));
        CHECK(result.report.tree.triangles == mesh.triangles.size());
        CHECK(result.report.closed);
        CHECK(result.report.lattice.max_error <= std::sqrt(3.0) / 2 * result.report.lattice.step * 1.000001);
        CHECK(result.report.bounds.extent / result.report.lattice.step > 32767.0);
    }
}

TEST_CASE("lattice: moving by whole steps changes only origin and checksum") {
    Mesh mesh = make_icosphere(3, 1.0, {0, 0, 0});
    for (Vec3& point : mesh.positions) {  // multiples of 2^-10, so that moving rounds nothing
        point = {std::round(point.x * 1024) / 1024, std::round(point.y * 1024) / 1024,
                 std::round(point.z * 1024) / 1024};
    }
    const auto here = must_bake_mesh(mesh);
    const auto there = must_bake_mesh(moved_by(mesh, {1000.0f, -512.0f, 77.5f}));
    CHECK(without_scale(here.bytes) == without_scale(there.bytes));
    CHECK(here.report.lattice.max_error == there.report.lattice.max_error);
}

TEST_CASE("lattice: the step is the smallest power of two for which the bits suffice") {
    for (unsigned bits = 1; bits <= 24; ++bits) {
        for (const Mesh& mesh : {make_terrain(12, bits), make_cube(-0.7f, 3.0f)}) {
            const auto result = must_bake_mesh(mesh, with_bits(bits));
            if (result.report.tree.triangles == 0) continue;
            const DecodedBlob decoded = decode(result.bytes);
            CHECK(decoded.bits == bits);
            CHECK(largest_extent(decoded) < 1u << bits);
            CHECK(std::ldexp(1.0, decoded.step_exponent) == result.report.lattice.step);
            // With half the step the largest side would not fit any more.
            const auto with_half_the_step =
                bake_mesh(mesh, {.resolution = Resolution::step(decoded.step_exponent - 1)});
            CHECK((!with_half_the_step || with_half_the_step.report.lattice.bits > bits));
        }
    }
}

TEST_CASE("lattice: an extent one step above the range of the bits doubles the step") {
    const auto exponent_of = [](float side) {
        const auto result = must_bake_mesh(make_cube(0.0f, side), with_bits(8));
        return decode(result.bytes).step_exponent;
    };
    CHECK(exponent_of(255.0f) == 0);
    CHECK(exponent_of(255.5f) == 1);  // 255.5 rounds to 256
    CHECK(exponent_of(255.25f) == 0);
    CHECK(exponent_of(256.0f) == 1);
    CHECK(exponent_of(127.5f) == -1);
}

TEST_CASE("lattice: coordinates snap to the nearest lattice point and ties go to even") {
    CHECK(baker::round_half_even(0.5) == 0.0);
    CHECK(baker::round_half_even(1.5) == 2.0);
    CHECK(baker::round_half_even(2.5) == 2.0);
    CHECK(baker::round_half_even(-0.5) == 0.0);
    CHECK(baker::round_half_even(16777214.5) == 16777214.0);
    CHECK(baker::round_half_even(0.49999999999999994) == 0.0);
    Random random(3);
    for (int i = 0; i < 10'000; ++i) {
        const double value = double(random.signed_unit()) * 0x1p24 + double(random.signed_unit());
        REQUIRE(baker::round_half_even(value) == std::nearbyint(value));
    }
}

TEST_CASE("lattice: the smallest coordinates are 0 and the largest are the extent") {
    for (const Mesh& mesh : {make_terrain(20, 1), make_far_sphere(), make_soup(100, 5), make_plane_grid(9)}) {
        const DecodedBlob decoded = decode(bake_or_throw(mesh));
        GridPoint low = decoded.triangles[0].a;
        GridPoint high = low;
        for (const GridPoint& point : distinct_corners(decoded)) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], point[axis]);
                high[axis] = std::max(high[axis], point[axis]);
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(low[axis] == 0);
            CHECK(static_cast<std::uint32_t>(high[axis]) == decoded.extent[axis]);
        }
    }
}

TEST_CASE("lattice: a farthest triangle that collapses leaves the rest at 0 with its true error") {
    // A speck at -1000.3 vanishes; the cube stays.
    Mesh mesh = make_cube(500.1f, 1000.1f);
    append(mesh, make_cube(-1000.3f, -1000.29f));
    const auto result = must_bake_mesh(mesh, with_bits(4));
    CHECK(result.report.tree.triangles == 12);
    CHECK(result.report.findings.collapsed.count == 12);
    const DecodedBlob decoded = decode(result.bytes);
    for (const GridTriangle& triangle : decoded.triangles) CHECK(triangle.a[0] >= 0);
    const auto corners = distinct_corners(decoded);
    CHECK(corners.front() == GridPoint{0, 0, 0});
    // The speck's distance to the cube counts.
    CHECK(result.report.lattice.max_error >= 1500.0 * std::sqrt(3.0) - 100.0);
    CHECK(result.report.lattice.max_error <= 1501.0 * std::sqrt(3.0) + 300.0);
}

TEST_CASE("lattice: minus zero and subnormal minima give the origin zero") {
    const float denormal = std::numeric_limits<float>::denorm_min();
    for (const float low : {-0.0f, denormal, -denormal, std::bit_cast<float>(0x007FFFFFu)}) {
        const auto result = must_bake_mesh(make_cube(low, 1.0f));
        for (const float origin : decode(result.bytes).origin) CHECK(std::bit_cast<std::uint32_t>(origin) == 0);
    }
}

TEST_CASE("lattice: meshes too small or too large for the steps of the format are refused with the size") {
    for (const float size : {0x1p-100f, 0x1p127f}) {
        check_refused(bake_mesh(make_cube(0.0f, size)), BakeStatus::too_large, {"scale the input"});
    }
    CHECK(bake_mesh(make_cube(0.0f, 0x1p-80f)));
    CHECK(bake_mesh(make_cube(0.0f, 0x1p115f)));
}

TEST_CASE("lattice: a step finer than the float spacing of the source gives a warning") {
    CHECK(bake_mesh(make_far_sphere()).report.warns_of(BakeWarning::Kind::step_below_float_spacing));
    CHECK(!bake_mesh(make_far_sphere(), with_bits(7)).report.warns_of(BakeWarning::Kind::step_below_float_spacing));
    CHECK(!bake_mesh(make_cube(-1.0f, 1.0f)).report.warns_of(BakeWarning::Kind::step_below_float_spacing));
}

TEST_CASE("lattice: a tolerance is kept and the next coarser lattice would break it") {
    for (const Mesh& mesh :
         {make_terrain(30, 4), make_torus(50, 30, 3.0, 1.0), make_icosphere(4, 1.0, {0, 0, 0}), make_soup(200, 3)}) {
        for (const double tolerance : {0.1, 0.01, 0.001, 0.0001}) {
            const auto result = must_bake_mesh(mesh, with_tolerance(tolerance));
            CHECK(result.report.lattice.max_error <= tolerance);
            CHECK(result.report.lattice.max_error > 0.0);
            CHECK(result.report.tree.triangles > 0);
            CHECK(static_cast<double>(decode(result.bytes).max_error) == result.report.lattice.max_error);
            const auto coarser =
                bake_mesh(mesh, with_bits(result.report.lattice.bits > 1 ? result.report.lattice.bits - 1 : 1));
            REQUIRE(coarser);
            if (coarser.report.lattice.step == 2 * result.report.lattice.step && coarser.report.tree.triangles != 0) {
                CHECK(coarser.report.lattice.max_error > tolerance);
            }
        }
    }
}

TEST_CASE("lattice: a mesh on a coarse grid has a step coarse enough for it and fine enough for queries") {
    for (const double tolerance : {0.001, 0.03, 1.0}) {
        const auto result = must_bake_mesh(make_cube(-64.0f, 64.0f), with_tolerance(tolerance));
        CHECK(result.report.lattice.max_error == 0.0);
        CHECK(result.report.lattice.step ==
              std::min(64.0, std::ldexp(64.0, baker::step_exponent_for_tolerance(tolerance))));
        const OpenedBlob opened(result.bytes);
        const auto moved = rounding_error(opened.blob, Vec3{70.0f, 1.0f, 2.0f});
        REQUIRE(moved);
        CHECK(double(moved.value) <= tolerance);
    }
}

TEST_CASE("lattice: a mesh on a coarse grid keeps a tolerance that no blob or query has a use for") {
    // 2^20 steps of the grid: a step of 2^-4 would be the 25th bit.
    const auto large = must_bake_mesh(make_cube(0.0f, 0x1p20f), with_tolerance(0x1p-12));
    CHECK(large.report.lattice.step == 0x1p-3);
    CHECK(large.report.lattice.max_error == 0.0);
    // float32 numbers are a quarter apart here.
    const auto far = must_bake_mesh(make_cube(0x1p21f, 0x1p21f + 64.0f), with_tolerance(0x1p-12));
    CHECK(far.report.lattice.step == 0x1p-2);
    CHECK(!far.report.warns_of(BakeWarning::Kind::step_below_float_spacing));
}

TEST_CASE("lattice: no coarse tolerance makes a whole mesh vanish") {
    for (const double tolerance : {1.0, 1e3, 1e30, 1e300}) {
        const auto result = must_bake_mesh(make_icosphere(2, 1.0, {5, 5, 5}), with_tolerance(tolerance));
        CHECK(result.report.tree.triangles > 0);
        CHECK(result.report.lattice.max_error <= tolerance);
    }
}

TEST_CASE("lattice: a tolerance too fine for 24 bits is refused with the limits") {
    const Mesh mesh = make_torus(50, 30, 1000.0, 300.0);
    const auto result = bake_mesh(mesh, with_tolerance(1e-6));
    // Step 2^-20 keeps 1e-6; with 2^24 - 1 of them 15.999999 are covered.
    check_refused(result, BakeStatus::too_fine, {"2600 large", "may be 15.99999"});
    // 2600 need a step of 2^-12, whose half diagonal is 0.0002114320.
    const std::string before = "finest tolerance is ";
    const std::size_t at = result.message.find(before);
    REQUIRE(at != std::string::npos);
    const double finest = std::stod(result.message.substr(at + before.size()));
    CHECK(finest == doctest::Approx(std::sqrt(3.0) / 2 / 4096).epsilon(1e-7));
    CHECK(bake_mesh(mesh, with_tolerance(finest)));
    for (const double tolerance : {1e-30, 1e-300, std::numeric_limits<double>::denorm_min()}) {
        CHECK(!bake_mesh(mesh, with_tolerance(tolerance)));
    }
}

}  // namespace
}  // namespace espalier::tests::lattice_test
