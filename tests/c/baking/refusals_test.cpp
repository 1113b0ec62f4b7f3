// Claims about c/bake.h: what no mesh and no options can be is refused with a message that helps.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>

#include "c/baking/given.hpp"
#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/blobs/c_bake_options.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::size_t huge = std::numeric_limits<std::size_t>::max();
constexpr std::ptrdiff_t most = std::numeric_limits<std::ptrdiff_t>::max();
constexpr std::ptrdiff_t least = std::numeric_limits<std::ptrdiff_t>::min();

struct Case {
    espalier_bake_status status;
    std::string words;  // of the message, with | between them
    std::function<void(espalier_mesh_view&, espalier_bake_options&)> spoil;
};

void check_refusal(const espalier_bake_result& refused, espalier_bake_status status, const std::string& words) {
    CAPTURE(refused.message);
    CHECK(refused.status == status);
    CHECK(refused.bytes == nullptr);
    CHECK(refused.byte_count == 0);
    CHECK(refused.remap_count == 0);
    REQUIRE(refused.report != nullptr);
    CHECK(refused.report->triangles == 0);
    CHECK(std::string(refused.report->collapsed.first).empty());
    std::istringstream parts(words);
    for (std::string word; std::getline(parts, word, '|');)
        CHECK_MESSAGE(std::strstr(refused.message, word.c_str()) != nullptr, word);
}

}  // namespace

TEST_CASE("c api: the baker refuses each wrong argument and its message names it") {
    using Mesh = espalier_mesh_view;
    using Options = espalier_bake_options;
    const double nan = std::nan("");
    constexpr espalier_bake_status argument = ESPALIER_BAKE_INVALID_ARGUMENT, option = ESPALIER_BAKE_INVALID_OPTIONS,
                                   large = ESPALIER_BAKE_TOO_LARGE, broken = ESPALIER_BAKE_INVALID_MESH;
#define WITH(...) [=]([[maybe_unused]] Mesh& mesh, [[maybe_unused]] Options& options) { __VA_ARGS__; }
    const std::vector<Case> cases = {
        {argument, "the cube|positions is null", WITH(mesh.positions = nullptr)},
        {argument, "the cube|triangles is null", WITH(mesh.triangles = nullptr)},
        {argument, "positions|more than any memory", WITH(mesh.position_count = huge)},
        {argument, "triangles|more than any memory", WITH(mesh.triangle_count = huge)},
        {argument, "more than any memory", WITH(mesh.position_stride = most)},
        {argument, "more than any memory", WITH(mesh.position_stride = least)},
        {argument, "stride of 0|12", WITH(mesh.position_stride = 0)},
        {argument, "stride of -11|12", WITH(mesh.position_stride = -11)},
        {argument, "stride of 12|24", WITH(mesh.coordinate_type = ESPALIER_COORDINATE_FLOAT64)},
        {argument, "stride of 5|6", WITH(mesh.index_type = ESPALIER_INDEX_UINT16, mesh.triangle_stride = 5)},
        {argument, "coordinate type 2", WITH(mesh.coordinate_type = 2)},
        {argument, "index type 255", WITH(mesh.index_type = 255)},
        {large, "3000000000 triangles|split", WITH(mesh.triangle_count = 3'000'000'000u)},
        {large, "5000000000 vertices|split", WITH(mesh.position_count = 5'000'000'000u)},
        {broken, "the cube, triangle|vertex 7|the mesh has 7", WITH(mesh.position_count = 7)},
        {argument, "has the size 0|espalier_init_", WITH(mesh.size = 0)},
        {argument, "has the size 18446744073709551615|newer version|" ESPALIER_VERSION, WITH(mesh.size = huge)},
        {argument, "options|has the size 8", WITH(options.size = 8)},
        {argument, "options|newer version", WITH(options.size = sizeof options + 1)},
        {argument, "release", WITH(options.release = [](void*, std::size_t, void*) {})},
        {option, "resolution_kind 3", WITH(options.resolution_kind = 3)},
        {option, "16.5|whole", WITH(options.resolution = 16.5)},
        {option, "whole", WITH(options.resolution = nan)},
        {option, "whole", WITH(options.resolution = HUGE_VAL)},
        {option, "bits is 0", WITH(options.resolution = -3)},
        {option, "bits is 25", WITH(options.resolution = 25)},
        {option, "2^101", WITH(options.resolution = 101, options.resolution_kind = ESPALIER_RESOLUTION_STEP)},
        {option, "tolerance", WITH(options.resolution = nan, options.resolution_kind = ESPALIER_RESOLUTION_TOLERANCE)},
        {option, "profile 4", WITH(options.profile = 4)},
        {option, "effort 3", WITH(options.effort = 3)},
        {option, "builder 6", WITH(options.builder = 6)},
        {option, "flat_angle", WITH(options.flat_angle = nan)},
        {option, "max_leaf_triangles is 63", WITH(options.max_leaf_triangles = 63)},
        {option, "byte_price", WITH(options.byte_price = -1)},
        {option, "origin", WITH(options.origin.z = -HUGE_VAL)},
        {argument, "poses is null", WITH(options.deformable = 1, options.pose_count = 2)},
        {argument, "pose_count", WITH(options.deformable = 1, options.pose_count = huge, options.poses = &options)},
    };
    const espalier::tests::Mesh cube = [] {
        espalier::tests::Mesh made = make_cube(-1.0f, 1.0f);
        made.name = "the cube";
        return made;
    }();
    for (std::size_t i = 0; i < cases.size(); ++i) {
        CAPTURE(i);
        GivenMesh given(cube);
        espalier_mesh_view view = given.view();
        espalier_bake_options options = default_options_of_c();
        cases[i].spoil(view, options);
        const BakedFromC refused = bake_from_c(view, options);
        check_refusal(*refused, cases[i].status, cases[i].words);
    }
    const espalier_bake_options options = default_options_of_c();
    const BakedFromC no_meshes(c99_bake(nullptr, 2, &options));
    check_refusal(*no_meshes, ESPALIER_BAKE_INVALID_ARGUMENT, "meshes is null");
    GivenMesh given(cube);
    std::array two = {given.view(), given.view()};
    two[1].size -= 1;
    const BakedFromC of_two_sizes(c99_bake(two.data(), 2, &options));
    check_refusal(*of_two_sizes, ESPALIER_BAKE_INVALID_ARGUMENT, "mesh 1|but the first one");
}

TEST_CASE("c api: a coordinate beyond float32 is refused by that name") {
    const double positions[] = {0, 0, 0, 1e300, 0, 0, 0, 1, 0, -3.5e38, 2, 2};
    const std::uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    const espalier_mesh_view view = view_of(positions, triangles);
    espalier_bake_options options = default_options_of_c();
    const BakedFromC refused = bake_from_c(view, options);
    check_refusal(*refused, ESPALIER_BAKE_INVALID_MESH, "triangle 0|vertex 1|the coordinate 1e+300|beyond float32");
    CHECK(refused->place.is_known == 1);
    CHECK(refused->place.triangle == 0);
    options.drop_bad_triangles = 1;
    const BakedFromC lost = bake_from_c(view, options);
    check_refusal(*lost, ESPALIER_BAKE_INVALID_MESH, "dropped 2 of 2 triangles|2 not finite|max_dropped|allow_empty");
    options.max_dropped = 100.0;
    options.allow_empty = 1;
    const BakedFromC dropped = bake_from_c(view, options);
    CHECK(dropped->status == ESPALIER_BAKE_OK);
    CHECK(dropped->report->not_finite.count == 2);
}

TEST_CASE("c api: any bytes are safe as a mesh and options") {
    Random random(33);
    std::uint64_t baked = 0;
    for (std::uint64_t i = 0; i < scaled(3'000); ++i) {
        const Mesh mesh = make_soup(1 + random.below(20), random.next());
        GivenMesh given(mesh);
        espalier_mesh_view view = given.view();
        espalier_bake_options options = default_options_of_c();
        // What the caller vouches for stays: pointers and counts.
        const auto spoil = [&](auto& number) {
            if (random.below(12) == 0)
                for (std::size_t byte = 0; byte < sizeof number; ++byte)
                    reinterpret_cast<unsigned char*>(&number)[byte] = static_cast<unsigned char>(random.next());
        };
        const auto spoil_number = [&](auto& number) {
            if (random.below(8) == 0)
                number = static_cast<std::remove_reference_t<decltype(number)>>(
                    hostile_values[random.below(hostile_values.size())]);
        };
        spoil(view.coordinate_type);
        spoil(view.index_type);
        for_each_choice(options, spoil);
        for_each_number(options, spoil_number);
        const BakedFromC result = bake_from_c(view, options);
        REQUIRE(result != nullptr);
        REQUIRE(result->status != ESPALIER_BAKE_INTERNAL);
        REQUIRE((result->status == ESPALIER_BAKE_OK) == std::string(result->message).empty());
        if (result->status != ESPALIER_BAKE_OK) continue;
        ++baked;
        const VerifyReport sound = verify(bytes_of(*result));
        REQUIRE_MESSAGE(sound, sound.message);
    }
    CHECK(baked > 0);
}

TEST_CASE("c api: an older structure is taken and the fields that it lacks are the defaults") {
    // Of this first version only what pads the last field may be missing.
    GivenMesh given(make_cube(-1.0f, 1.0f));
    espalier_mesh_view view = given.view();
    view.size = offsetof(espalier_mesh_view, index_type) + sizeof view.index_type;
    espalier_bake_options options = default_options_of_c();
    options.size = offsetof(espalier_bake_options, progress_user) + sizeof options.progress_user;
    CHECK(bake_from_c(view, options)->status == ESPALIER_BAKE_OK);
    view.size -= 1;
    CHECK(bake_from_c(view, options)->status == ESPALIER_BAKE_INVALID_ARGUMENT);
    unsigned char larger[sizeof options + 16];
    std::memset(larger, 0xA5, sizeof larger);
    c99_init_bake_options(reinterpret_cast<espalier_bake_options*>(larger), sizeof larger);
    std::memcpy(&options, larger, sizeof options);
    CHECK(options.size == sizeof larger);
    CHECK(options.resolution == 16.0);
    CHECK(larger[sizeof larger - 1] == 0);
    std::memset(larger, 0xA5, sizeof larger);
    c99_init_mesh_view(reinterpret_cast<espalier_mesh_view*>(larger), sizeof(std::size_t));
    CHECK(larger[sizeof(std::size_t)] == 0xA5);
    c99_init_mesh_view(nullptr, sizeof view);
    c99_init_bake_options(nullptr, sizeof options);
}

TEST_CASE("c api: a loaded baker has the sizes of its structures and a sentence for each status") {
#define SIZE(name) CHECK(c99_size_of_baking(#name) == sizeof(espalier_##name));
    BAKING_STRUCTURES(SIZE)
#undef SIZE
    for (const char* const other : {"", "bake", "blob", "bake_options "}) CHECK(c99_size_of_baking(other) == 0);
    CHECK(c99_size_of_baking(nullptr) == 0);
    const std::string unknown = c99_describe_bake_status(200);
    for (unsigned status = 0; status < 256; ++status) {
        const std::string sentence = c99_describe_bake_status(static_cast<espalier_bake_status>(status));
        const bool is_known = status <= ESPALIER_BAKE_INTERNAL ||
                              (status >= ESPALIER_BAKE_INVALID_ARGUMENT && status <= ESPALIER_BAKE_NOT_SOUND);
        CHECK((sentence != unknown) == is_known);
    }
}
