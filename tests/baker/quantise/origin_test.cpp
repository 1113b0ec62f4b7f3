// Positions in float64 and the origin of a blob, judged in long double.
#include "support/testing.hpp"

#include <cmath>

#include "baker/baking_support.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests::origin_test {
namespace {

using Real = long double;  // 11 bits more than float64

struct FarMesh {
    std::vector<Vec3d> positions;
    std::vector<TriangleVertices> triangles;

    [[nodiscard]] MeshView view() const {
        MeshView view;
        view.float64_positions = positions;
        view.triangles = triangles;
        return view;
    }
};

/// Triangles around a place, in a cube of this size.
FarMesh far_mesh(Random& random, const Vec3d& place, double size) {
    FarMesh mesh;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const auto at = [&](double from) {
            return from + size * (double(random.unit()) + 0x1p-30 * double(random.unit()));
        };
        mesh.positions.push_back({at(place.x), at(place.y), at(place.z)});
        if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
    }
    return mesh;
}

BakeResult bake_far(const FarMesh& mesh, const BakeOptions& options) {
    const MeshView view = mesh.view();
    return bake(std::span(&view, 1), options);
}

/// Where the corners of a blob lie in the source.
std::vector<std::array<Real, 3>> places_of(const std::vector<std::byte>& bytes) {
    const Blob blob = open(bytes);
    REQUIRE(blob);
    const Vec3d origin = blob.source_origin();
    const DecodedBlob decoded = decode(bytes);
    const auto step = static_cast<Real>(std::ldexp(1.0, decoded.step_exponent));
    std::vector<std::array<Real, 3>> places;
    for (const GridPoint& corner : distinct_corners(decoded))
        places.push_back({Real(origin.x) + Real(decoded.origin[0]) + Real(corner[0]) * step,
                          Real(origin.y) + Real(decoded.origin[1]) + Real(corner[1]) * step,
                          Real(origin.z) + Real(decoded.origin[2]) + Real(corner[2]) * step});
    return places;
}

Real distance(const std::array<Real, 3>& a, const Vec3d& b) {
    const Real x = a[0] - Real(b.x), y = a[1] - Real(b.y), z = a[2] - Real(b.z);
    return std::sqrt(x * x + y * y + z * z);
}

/// The largest distance of a position to the nearest corner of the blob, and of a corner to the nearest position.
Real largest_distance(const FarMesh& mesh, const std::vector<std::byte>& bytes) {
    const auto places = places_of(bytes);
    Real largest = 0;
    for (const Vec3d& position : mesh.positions) {
        Real nearest = 1e30L;
        for (const auto& place : places) nearest = std::min(nearest, distance(place, position));
        largest = std::max(largest, nearest);
    }
    for (const auto& place : places) {
        Real nearest = 1e30L;
        for (const Vec3d& position : mesh.positions) nearest = std::min(nearest, distance(place, position));
        largest = std::max(largest, nearest);
    }
    return largest;
}

TEST_CASE("origin: float64 positions are rounded once to the nearest lattice points") {
    Random random(6241);
    for (std::uint64_t i = 0; i < scaled(200); ++i) {
        const double far = std::ldexp(1.0, random.between(0, 40));
        const Vec3d place = {far * double(random.signed_unit()), far * double(random.signed_unit()),
                             far * double(random.signed_unit())};
        const FarMesh mesh = far_mesh(random, place, std::ldexp(1.0, random.between(0, 12)));
        BakeOptions options;
        options.resolution = Resolution::bits(static_cast<unsigned>(random.between(10, 22)));
        options.origin.reset();
        const BakeResult baked = bake_far(mesh, options);
        REQUIRE(baked);
        CHECK(!baked.report.warns_of(BakeWarning::Kind::step_below_float_spacing));
        const auto step = static_cast<Real>(baked.report.lattice.step);
        for (const Vec3d& position : mesh.positions) {
            // The multiples of the step nearest to it, whatever the origin.
            bool is_there = false;
            for (const auto& at : places_of(baked.bytes))
                is_there = is_there || (std::abs(at[0] - Real(position.x)) <= step / 2 &&
                                        std::abs(at[1] - Real(position.y)) <= step / 2 &&
                                        std::abs(at[2] - Real(position.z)) <= step / 2);
            REQUIRE(is_there);
        }
        const Real true_error = largest_distance(mesh, baked.bytes);
        REQUIRE(Real(baked.report.lattice.max_error) >= true_error);
        REQUIRE(Real(open(baked.bytes).max_error()) >= true_error);
    }
}

TEST_CASE("origin: the baker chooses one where float32 is coarser than a quarter of a step and only there") {
    Random random(6242);
    BakeOptions options;
    options.origin.reset();
    const FarMesh near = far_mesh(random, {0, 0, 0}, 10.0), far = far_mesh(random, {5e6, -4e6, 300}, 10.0);
    const BakeResult at_home = bake_far(near, options), far_away = bake_far(far, options);
    CHECK(at_home.report.origin == Vec3d{});
    CHECK((decode(at_home.bytes).features & format::feature::source_origin) == 0);
    const Vec3d origin = far_away.report.origin;
    CHECK(std::abs(origin.x - 5e6) <= 32);
    CHECK(std::abs(origin.y + 4e6) <= 32);
    CHECK(std::abs(origin.z - 300) <= 32);
    CHECK(std::fmod(origin.x, 16.0) == 0.0);
    CHECK(open(far_away.bytes).source_origin() == origin);
    CHECK((decode(far_away.bytes).features & format::feature::source_origin) != 0);
    // A coarse step loses nothing to float32.
    options.resolution = Resolution::step(2);
    CHECK(bake_far(far, options).report.origin == Vec3d{});
    options.resolution = Resolution::tolerance(0.001);
    CHECK(bake_far(far, options).report.origin == origin);
    // Places near what float32 holds as it is need one all the same.
    FarMesh rounded = far;
    for (Vec3d& position : rounded.positions)
        position = {double(static_cast<float>(position.x)), double(static_cast<float>(position.y)),
                    double(static_cast<float>(position.z))};
    options = {};
    options.origin.reset();
    CHECK(bake_far(rounded, options).report.origin == origin);
    // Of a mesh about 0 no lattice is too fine, and deformable blobs take positions that count from a given one.
    options.resolution = Resolution::bits(24);
    CHECK(bake_far(near, options).report.origin == Vec3d{});
    options.profile = Profile::fast;
    options.deformation = Deformation{};
    CHECK(bake_far(far, options).report.origin == Vec3d{});
}

TEST_CASE("origin: tiles with an origin each meet in the same places") {
    Random random(6243);
    for (std::uint64_t i = 0; i < scaled(50); ++i) {
        FarMesh west = far_mesh(random, {431'000.0, 5'312'000.0, 500.0}, 100.0), east = west;
        for (std::size_t v = 0; v < 3; ++v) {  // one triangle is in both
            east.positions[v] = west.positions[v];
        }
        for (std::size_t v = 3; v < east.positions.size(); ++v) east.positions[v].x += 700.0;
        BakeOptions options;
        options.resolution = Resolution::step(-random.between(6, 12));
        options.origin.reset();
        const BakeResult a = bake_far(west, options), b = bake_far(east, options);
        REQUIRE(a);
        REQUIRE(b);
        REQUIRE(a.report.origin != b.report.origin);
        const auto of_a = places_of(a.bytes), of_b = places_of(b.bytes);
        for (std::size_t v = 0; v < 3; ++v) {
            const auto nearest = [&](const std::vector<std::array<Real, 3>>& places) {
                return *std::min_element(places.begin(), places.end(), [&](const auto& p, const auto& q) {
                    return distance(p, west.positions[v]) < distance(q, west.positions[v]);
                });
            };
            REQUIRE(nearest(of_a) == nearest(of_b));
        }
    }
}

TEST_CASE("origin: the error counts from the positions as they were given with any origin") {
    Random random(6244);
    for (std::uint64_t i = 0; i < scaled(200); ++i) {
        const FarMesh mesh = far_mesh(random, {7.1e5, 5.2e6, 12.0}, 50.0);
        BakeOptions options;
        options.origin = Vec3d{1e5 * double(random.signed_unit()) / 3.0, 5e6 + 1e5 * double(random.unit()), 0.1};
        options.resolution = Resolution::bits(static_cast<unsigned>(random.between(8, 24)));
        const BakeResult baked = bake_far(mesh, options);
        REQUIRE(baked);
        const Real true_error = largest_distance(mesh, baked.bytes);
        REQUIRE(Real(baked.report.lattice.max_error) >= true_error);
        REQUIRE(Real(baked.report.lattice.max_error) <= true_error * 1.001L + 1e-8L);
    }
}

TEST_CASE("origin: without one a far mesh is baked with the error of float32 and a warning") {
    Random random(6245);
    const FarMesh mesh = far_mesh(random, {5e6, 4e6, 3e6}, 10.0);
    const BakeResult baked = bake_far(mesh, {});
    REQUIRE(baked);
    CHECK(baked.report.origin == Vec3d{});
    REQUIRE(baked.report.warns_of(BakeWarning::Kind::step_below_float_spacing));
    CHECK(baked.report.warnings.front().message.find("choose an origin") != std::string::npos);
    CHECK(baked.report.lattice.max_error > 0.1);
    CHECK(Real(baked.report.lattice.max_error) >= largest_distance(mesh, baked.bytes));
    BakeOptions options;
    options.resolution = Resolution::tolerance(0.001);
    const BakeResult refused = bake_far(mesh, options);
    REQUIRE(refused.status == BakeStatus::too_fine);
    CHECK(refused.message.find("choose an origin near the meshes") != std::string::npos);
}

TEST_CASE("origin: the error of a deformable blob has the float32 of its positions and a refit to them its bytes") {
    Random random(6247);
    for (std::uint64_t i = 0; i < scaled(50); ++i) {
        const FarMesh mesh = far_mesh(random, {5e5, 5.4e6, 600.0}, 10.0);
        BakeOptions options;
        options.profile = Profile::fast;
        options.deformation = Deformation{};
        options.resolution = Resolution::bits(static_cast<unsigned>(random.between(8, 22)));
        if (random.coin()) options.origin = Vec3d{5e5, 5.4e6, 600.0};
        const BakeResult baked = bake_far(mesh, options);
        REQUIRE(baked);
        REQUIRE(Real(baked.report.lattice.max_error) >= largest_distance(mesh, baked.bytes));
        std::vector<Vec3> positions;
        for (const Vec3d& at : mesh.positions)
            positions.push_back({static_cast<float>(at.x - options.origin->x),
                                 static_cast<float>(at.y - options.origin->y),
                                 static_cast<float>(at.z - options.origin->z)});
        Mesh rounded;
        rounded.positions = positions;
        rounded.triangles = mesh.triangles;
        const Vec3d origin = *options.origin;
        options.origin = Vec3d{};
        const BakeResult of_float32 = bake_mesh(rounded, options);
        REQUIRE(of_float32);
        const DecodedBlob a = decode(baked.bytes), b = decode(of_float32.bytes);
        REQUIRE(a.triangles == b.triangles);
        REQUIRE(a.origin == b.origin);
        REQUIRE(open(baked.bytes).source_origin() == origin);
    }
}

TEST_CASE("origin: float32 positions bake to the same bytes as in float64") {
    const Mesh mesh = make_icosphere(3, 7.0, {100.0f, -3.0f, 0.25f});
    FarMesh same;
    for (const Vec3& position : mesh.positions)
        same.positions.push_back({double(position.x), double(position.y), double(position.z)});
    same.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    BakeOptions options;
    CHECK(bake_far(same, options).bytes == bake_mesh(mesh, options).bytes);
    options.origin = Vec3d{100.0, -3.0, 0.25};
    CHECK(bake_far(same, options).bytes == bake_mesh(mesh, options).bytes);
    options.origin.reset();
    CHECK(bake_mesh(mesh, options).report.origin == Vec3d{});
}

TEST_CASE("origin: what cannot be is refused with the reason") {
    Random random(6246);
    FarMesh mesh = far_mesh(random, {0, 0, 0}, 1.0);
    const auto message_of = [](const BakeResult& result) {
        REQUIRE(!result);
        return result.message;
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    BakeOptions options;
    options.origin = Vec3d{0.0, std::nan(""), 0.0};
    CHECK(has(message_of(bake_far(mesh, options)), "the origin has y = NaN"));
    MeshView view = mesh.view();
    const std::vector<Vec3> both(60);
    view.positions = both;
    CHECK(has(message_of(bake(std::span(&view, 1))), "in float32 and in float64"));
    mesh.positions[4].y = 1e300;
    CHECK(has(message_of(bake_far(mesh, {})), "triangle 1: its second corner (vertex 4) has the coordinate 1e+300"));
    BakeOptions dropping;
    dropping.drop_bad_triangles = true;
    CHECK(bake_far(mesh, dropping).report.findings.not_finite.count == 1);
    mesh.positions[4].y = -3e38;
    options.origin = Vec3d{0.0, 3e38, 0.0};
    CHECK(has(message_of(bake_far(mesh, options)), "beyond float32"));
    // Hardly more than zero is zero.
    mesh.positions[4].y = 1e-290;
    CHECK(bake_far(mesh, {}));
}

}  // namespace
}  // namespace espalier::tests::origin_test
