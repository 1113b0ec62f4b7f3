// Claims about c/bake.h: it bakes what bake.hpp bakes, from any arrays, and reports the same.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "c/baking/given.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/motions.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// Options in both languages.
struct Options {
    BakeOptions cpp;
    espalier_bake_options c = default_options_of_c();
    std::vector<Vec3> poses;  // of C
};

Options some_options(const Mesh& mesh, Random& random) {
    Options options;
    const unsigned kind = random.below(3);
    options.c.resolution_kind = static_cast<espalier_resolution>(kind);
    if (kind == ESPALIER_RESOLUTION_BITS) {
        const unsigned bits = 6 + random.below(14);
        options.cpp.resolution = Resolution::bits(bits);
        options.c.resolution = bits;
    } else if (kind == ESPALIER_RESOLUTION_TOLERANCE) {
        options.cpp.resolution = Resolution::tolerance(0.001);
        options.c.resolution = 0.001;
    } else {
        const int exponent = -static_cast<int>(random.below(12));
        options.cpp.resolution = Resolution::step(exponent);
        options.c.resolution = exponent;
    }
    options.cpp.profile = static_cast<Profile>(options.c.profile = static_cast<std::uint8_t>(random.below(4)));
    options.cpp.effort = static_cast<Effort>(options.c.effort = static_cast<std::uint8_t>(random.below(2)));
    options.cpp.build.builder = static_cast<Builder>(options.c.builder = static_cast<std::uint8_t>(random.below(6)));
    options.cpp.original_ids = (options.c.original_ids = static_cast<std::uint8_t>(random.below(2) * 3)) != 0;
    options.cpp.drop_bad_triangles = (options.c.drop_bad_triangles = static_cast<std::uint8_t>(random.below(2))) != 0;
    options.c.with_remap = static_cast<std::uint8_t>(random.below(2));
    options.cpp.policy.emplace();
    options.cpp.policy->max_dropped = options.c.max_dropped = 10.0 * random.below(11);
    options.cpp.policy->allow_empty = (options.c.allow_empty = static_cast<std::uint8_t>(random.below(3))) != 0;
    options.cpp.policy->strict = (options.c.strict = random.below(8) == 0 ? 1 : 0) != 0;
    if (random.coin()) options.cpp.flat_angle = options.c.flat_angle = random.below(80);
    options.cpp.bounds.oriented_box = (options.c.oriented_box = static_cast<std::uint8_t>(random.below(2))) != 0;
    options.cpp.bounds.sphere = (options.c.sphere = static_cast<std::uint8_t>(random.below(2))) != 0;
    options.cpp.bounds.k_dop = (options.c.k_dop = static_cast<std::uint8_t>(random.below(2))) != 0;
    options.cpp.build.duplicate_budget = options.c.duplicate_budget = 0.1 * random.below(9);
    options.cpp.build.byte_price = options.c.byte_price = static_cast<float>(random.below(9));
    options.cpp.build.max_leaf_triangles = options.c.max_leaf_triangles = 1 + random.below(62);
    options.cpp.threads = options.c.threads = 1 + random.below(2);
    if (random.below(4) != 0) return options;
    options.cpp.deformation.emplace();
    options.c.deformable = 1;
    if (random.coin()) {
        options.cpp.deformation->range = Box{{-3.0f, -3.0f, -3.0f}, {3.0f, 3.0f, 3.0f}};
        options.c.has_range = 7;
        options.c.range = {{-3.0f, -3.0f, -3.0f}, {3.0f, 3.0f, 3.0f}};
    }
    for (unsigned i = random.below(3); i > 0; --i) {
        const std::vector<Vec3> pose = posed(mesh, every_motion[i]);
        options.cpp.deformation->poses.push_back(pose);
        options.poses.insert(options.poses.end(), pose.begin(), pose.end());
        ++options.c.pose_count;
    }
    options.c.poses = options.poses.data();
    if (random.below(4) != 0) {  // go together
        options.cpp.profile = Profile::fast;
        options.c.profile = ESPALIER_PROFILE_FAST;
        options.cpp.build.builder = Builder::sweep_sah;
        options.c.builder = ESPALIER_BUILDER_SWEEP_SAH;
        options.cpp.drop_bad_triangles = options.cpp.bounds.oriented_box = options.cpp.bounds.sphere =
            options.cpp.bounds.k_dop = false;
        options.c.drop_bad_triangles = options.c.oriented_box = options.c.sphere = options.c.k_dop = 0;
        options.cpp.flat_angle = std::nullopt;
        options.c.flat_angle = -1.0;
    }
    return options;
}

Arrangement some_arrangement(const Mesh& mesh, Random& random) {
    return {static_cast<espalier_coordinate_type>(random.below(2)),
            static_cast<espalier_index_type>(mesh.positions.size() < 65536 ? random.below(2) : 0), random.below(9),
            random.coin(), random.below(16)};
}

/// A mesh that is broken now and then.
Mesh some_mesh(Random& random) {
    const std::uint32_t kind = random.below(4);
    Mesh mesh = kind == 0   ? make_icosphere(1, 1.0, {0.2f, 0.1f, 0.0f})
                : kind == 1 ? make_soup(40, random.next())
                : kind == 2 ? make_slivers(30, random.next())
                            : make_coplanar_stacks(30, random.next());
    mesh.name = random.coin() ? "made" : "";
    for (std::uint32_t i = 0; i < mesh.triangles.size() && random.coin(); ++i) mesh.triangles.push_back({i, i, 0});
    if (random.below(4) == 0) mesh.triangles[random.below(9)][1] = 60'000;
    if (random.below(4) == 0) mesh.positions[random.below(9)].y = std::numeric_limits<float>::quiet_NaN();
    if (random.coin()) mesh.materials.assign(mesh.triangles.size(), random.below(70'000));
    return mesh;
}

void check_finding(const espalier_bake_finding& c, const Finding& cpp) {
    CHECK(c.count == cpp.count);
    CHECK(c.first == cpp.first);
    REQUIRE((c.place.is_known != 0) == cpp.place.has_value());
    if (!cpp.place) return;
    CHECK(c.place.file == cpp.place->file);
    CHECK(c.place.mesh == cpp.place->mesh);
    CHECK(c.place.triangle == cpp.place->triangle.value_or(ESPALIER_NO_TRIANGLE));
}

void check_same_report(const espalier_bake_report& c, const BakeReport& cpp) {
    CHECK(c.source_triangles == cpp.source.triangles);
    CHECK(c.source_vertices == cpp.source.vertices);
    check_finding(c.not_finite, cpp.findings.not_finite);
    check_finding(c.index_out_of_range, cpp.findings.index_out_of_range);
    check_finding(c.zero_area, cpp.findings.zero_area);
    check_finding(c.collapsed, cpp.findings.collapsed);
    check_finding(c.duplicate, cpp.findings.duplicate);
    CHECK(c.bounds_min.x == cpp.bounds.min.x);
    CHECK(c.bounds_max.z == cpp.bounds.max.z);
    CHECK(c.extent == cpp.bounds.extent);
    CHECK(c.box_volume == cpp.bounds.volumes.box);
    CHECK(c.oriented_box_volume == cpp.bounds.volumes.oriented_box);
    CHECK(c.sphere_volume == cpp.bounds.volumes.sphere);
    CHECK(c.k_dop_volume == cpp.bounds.volumes.k_dop);
    CHECK(c.step == cpp.lattice.step);
    CHECK(c.max_error == cpp.lattice.max_error);
    CHECK(c.bits == cpp.lattice.bits);
    CHECK(c.range_positions == cpp.motion.positions);
    CHECK(c.moving_bytes == cpp.motion.moving_bytes);
    CHECK(c.range.min.y == cpp.motion.range.min.y);
    CHECK(c.range.max.x == cpp.motion.range.max.x);
    CHECK(c.triangles == cpp.tree.triangles);
    CHECK(c.duplicate_references == cpp.tree.duplicate_references);
    CHECK(c.vertices == cpp.tree.vertices);
    CHECK(c.nodes == cpp.tree.nodes);
    CHECK(c.leaves == cpp.tree.leaves);
    CHECK(c.depth == cpp.tree.depth);
    CHECK((c.is_closed != 0) == cpp.closed);
    CHECK(c.bits_that_keep_closed == cpp.bits_that_keep_closed);
    CHECK(c.bytes == cpp.bytes);
    REQUIRE(c.warning_count == cpp.warnings.size());
    for (std::size_t i = 0; i < c.warning_count; ++i) {
        CHECK(c.warnings[i].message == cpp.warnings[i].message);
        CHECK(c.warnings[i].kind == static_cast<espalier_bake_warning_kind>(cpp.warnings[i].kind));
    }
}

void check_same(const espalier_bake_result& c, const BakeResult& cpp, bool with_remap) {
    REQUIRE(c.status == static_cast<espalier_bake_status>(cpp.status));
    CHECK(c.message == cpp.message);
    CHECK((c.place.is_known != 0) == cpp.place.has_value());
    if (cpp.place) CHECK(c.place.triangle == cpp.place->triangle.value_or(ESPALIER_NO_TRIANGLE));
    check_same_report(*c.report, cpp.report);
    REQUIRE(std::ranges::equal(bytes_of(c), cpp.bytes));
    CHECK((c.bytes == nullptr) == cpp.bytes.empty());
    REQUIRE(c.remap_count == (with_remap ? cpp.remap.size() : 0));
    for (std::size_t i = 0; i < c.remap_count; ++i) {
        REQUIRE(c.remap[i].triangle == cpp.remap[i].triangle);
        REQUIRE(c.remap[i].mesh == cpp.remap[i].mesh);
        REQUIRE(c.remap[i].first_corner == cpp.remap[i].first_corner);
    }
}

}  // namespace

TEST_CASE("c api: the baker gives the bytes and the report of C++") {
    Random random(31);
    std::uint64_t baked = 0, deformable = 0;
    const std::uint64_t rounds = scaled(600);
    for (std::uint64_t i = 0; i < rounds; ++i) {
        const Mesh mesh = some_mesh(random);
        const Options options = some_options(mesh, random);
        GivenMesh given(mesh, some_arrangement(mesh, random));
        const BakedFromC c = bake_from_c(given.view(), options.c);
        const MeshView view = mesh.view();
        const BakeResult cpp = bake(std::span(&view, 1), options.cpp);
        check_same(*c, cpp, options.c.with_remap != 0);
        baked += cpp ? 1u : 0u;
        deformable += cpp && options.cpp.deformation ? 1u : 0u;
    }
    if (asks_enough()) CHECK(baked > rounds / 8);
    if (asks_enough()) CHECK(deformable > rounds / 64);
}

TEST_CASE("c api: the baker takes several meshes and none") {
    const Mesh cube = make_cube(-1.0f, 1.0f), sphere = make_icosphere(2, 1.0, {3.0f, 0.0f, 0.0f});
    GivenMesh first(cube), second(sphere, {.coordinates = ESPALIER_COORDINATE_FLOAT64, .gap = 4});
    std::array views = {first.view(), second.view()};
    std::array cpp_views = {cube.view(), sphere.view()};
    views[1].file = cpp_views[1].file = 4;
    views[1].mesh = cpp_views[1].mesh = 9;
    espalier_bake_options options = default_options_of_c();
    options.original_ids = options.with_remap = 1;
    const BakedFromC both(c99_bake(views.data(), views.size(), &options));
    check_same(*both, bake(cpp_views, {.original_ids = true}), true);
    options = default_options_of_c();
    options.allow_empty = 1;
    const BakedFromC none(c99_bake(nullptr, 0, &options));
    check_same(*none, bake({}), false);
    const BakedFromC by_default(c99_bake(views.data(), views.size(), nullptr));
    check_same(*by_default, bake(cpp_views), false);
}

TEST_CASE("c api: float64 positions and an origin are those of C++") {
    Random random(32);
    for (std::uint64_t i = 0; i < scaled(200); ++i) {
        const double power = std::ldexp(1.0, static_cast<int>(random.below(24)));
        std::vector<double> positions(30);
        for (double& coordinate : positions) coordinate = power * (1.0 + double(random.in_cube(1.0f).x) / 3.0);
        const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5, 6, 7, 8};
        const espalier_mesh_view view = view_of(positions, indices);
        espalier_bake_options options = default_options_of_c();
        BakeOptions cpp_options;
        if (random.coin()) {
            options.origin = {positions[3], positions[4], positions[5]};
            cpp_options.origin = Vec3d{positions[3], positions[4], positions[5]};
        } else if (random.coin()) {
            options.chooses_origin = 1;
            cpp_options.origin.reset();
        }
        const BakedFromC baked = bake_from_c(view, options);
        REQUIRE(baked->status == ESPALIER_BAKE_OK);
        std::vector<Vec3d> points;
        for (std::size_t v = 0; v < 10; ++v)
            points.push_back({positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]});
        const std::vector<TriangleVertices> triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
        MeshView cpp_view;
        cpp_view.float64_positions = points;
        cpp_view.triangles = triangles;
        check_same(*baked, bake(std::span(&cpp_view, 1), cpp_options), false);
    }
}

TEST_CASE("c api: an origin keeps the details of places far away and the blob keeps it") {
    const Mesh mesh = make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f});
    const double far[3] = {445'123.375, 5'411'234.25, 310.5};
    GivenMesh given(mesh, {.coordinates = ESPALIER_COORDINATE_FLOAT64}, far);
    espalier_bake_options options = default_options_of_c();
    const BakedFromC coarse = bake_from_c(given.view(), options);
    options.origin = {far[0], far[1], far[2]};
    const BakedFromC fine = bake_from_c(given.view(), options);
    CHECK(coarse->report->max_error > 0.1);
    CHECK(fine->report->max_error < 1e-4);
    CHECK(fine->report->bounds_max.x == doctest::Approx(1.0).epsilon(0.01));
    CHECK(std::string(coarse->report->not_finite.first).empty());
    espalier_blob blob;
    REQUIRE(espalier_open(fine->bytes, fine->byte_count, &blob) == ESPALIER_OPEN_OK);
    const espalier_vec3d origin = espalier_blob_source_origin(&blob);
    CHECK(origin.x == far[0]);
    CHECK(origin.y == far[1]);
    CHECK(origin.z == far[2]);
    CHECK(fine->report->origin.y == far[1]);
}
