// Tests that no argument of espalier.h does harm, and that hostile ones get the bits of C++. Worth most under
// sanitizers.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "comparing.hpp"
#include "expecting.hpp"
#include "support/base/checksum.hpp"
#include "support/base/profiles.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/exact_buffer.hpp"
#include "support/queries/hostile_arguments.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

template <class T>
bool same_bytes(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

espalier_visit set_visited(espalier_triangle_id, const espalier_triangle*, void* is_visited) {
    *static_cast<bool*>(is_visited) = true;
    return ESPALIER_VISIT_NEXT;
}

}  // namespace

TEST_SUITE("hostile") {
    TEST_CASE("c api: each size but the right one is refused and leaves an empty handle") {
        const OpenedBlob good = blob_with_everything(Profile::small);
        Random random(4);
        const auto check = [&](const std::byte* bytes, std::size_t size, OpenStatus expected) {
            const Blob refused = open({bytes, size});
            for (const auto open_it : {espalier_open, espalier_open_unchecked}) {
                espalier_blob blob = open_from_c(good.bytes);  // an old view must not be left behind
                REQUIRE(open_it(bytes, size, &blob) == static_cast<espalier_open_status>(expected));
                REQUIRE(espalier_blob_size(&blob) == 0);
                if (random.below(64) == 0) compare_all(blob, blob, refused, refused, some_question(good.blob, random));
            }
        };
        for (std::size_t size = 0; size < good.bytes.size(); ++size) {
            const ExactBuffer shorter(std::span(good.bytes).first(size));
            check(shorter.bytes().data(), size, OpenStatus::too_short);
        }
        std::vector<std::byte> longer(good.bytes.begin(), good.bytes.end());
        for (int more = 0; more < 20; ++more) {
            longer.push_back(std::byte{0});
            check(longer.data(), longer.size(), OpenStatus::trailing_bytes);
        }
        // The header alone refuses these, also where their lowest 32 bits are those of the right size.
        check(longer.data(), std::numeric_limits<std::size_t>::max(), OpenStatus::trailing_bytes);
        if constexpr (sizeof(std::size_t) > 4)
            check(longer.data(), good.bytes.size() + (std::size_t{1} << 16 << 16), OpenStatus::trailing_bytes);
    }

    TEST_CASE("c api: garbage with its checksum repaired opens as in C++ and gives the same bits") {
        const OpenedBlob other = blob_with_copies();
        const espalier_blob c_other = open_from_c(other.bytes);
        Random random(5);
        std::uint64_t opened = 0;
        const std::uint64_t rounds = scaled(2'000);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            const OpenedBlob good = blob_with_everything(every_profile[i % every_profile.size()]);
            ExactBuffer buffer(good.bytes, random.below(16));
            const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
            for (std::uint32_t changes = 1 + random.below(4); changes > 0; --changes)
                buffer.bytes()[random.below(size)] ^= static_cast<std::byte>(1 + random.below(255));
            repair_checksum(buffer.bytes());
            const Blob blob = open(buffer.bytes());
            espalier_blob c_blob;
            std::memset(&c_blob, 0xA5, sizeof c_blob);  // what is in it before opening does not matter
            REQUIRE(espalier_open(buffer.bytes().data(), size, &c_blob) ==
                    static_cast<espalier_open_status>(blob.status()));
            opened += blob ? 1u : 0u;
            compare_all(c_blob, c_other, blob, other.blob, some_question(good.blob, random));
            compare_all(c_other, c_blob, other.blob, blob, some_question(good.blob, random));
        }
        CHECK(opened > 0);
    }

    TEST_CASE("c api: any words are safe as a rounded ray and give the bits of C++") {
        const OpenedBlob opened = blob_with_everything(Profile::balanced);
        const espalier_blob blob = open_from_c(opened.bytes);
        const espalier_lattice region = espalier_blob_lattice(&blob);
        Random random(6);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            espalier_rounded_ray rounded = {};
            if (i != 0) {
                const espalier_ray ray =
                    espalier_default_ray(c(some_point(opened.blob, random)), c(random.in_cube(2.0f)));
                rounded = espalier_round_ray(&region, &ray);
                const auto any = any_bits<espalier_rounded_ray>(random);
                const std::uint32_t one_in = 1 + random.below(30);
                for (std::size_t word = 0; word < std::size(any.opaque_); ++word)
                    if (random.below(one_in) == 0) rounded.opaque_[word] = any.opaque_[word];
            }
            const auto in_cpp = std::bit_cast<RoundedRay>(rounded);
            const espalier_ray_hit c_hit = espalier_raycast_rounded(&blob, &rounded);
            const RayHit hit = raycast(opened.blob, in_cpp);
            REQUIRE(std::memcmp(&c_hit, &hit, sizeof hit) == 0);
            REQUIRE(espalier_occluded_rounded(&blob, &rounded).status == c_hit.status);
            REQUIRE(occluded(opened.blob, in_cpp).status() == hit.status);
            if (i == 0) CHECK_FALSE(hit);
        }
    }

    TEST_CASE("c api: any bits are safe as a region and a lattice and give the bits of C++") {
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        const espalier_blob blob = open_from_c(opened.bytes);
        Random random(7);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            espalier_lattice region = any_bits<espalier_lattice>(random);
            if (random.coin()) region.step_exponent = static_cast<std::int32_t>(random.below(220)) - 110;
            const auto in_cpp = std::bit_cast<Lattice>(region);
            const espalier_ray ray =
                espalier_default_ray(c(some_point(opened.blob, random)), c(some_point(opened.blob, random)));
            const espalier_rounded_ray rounded = espalier_round_ray(&region, &ray);
            const espalier_query_status status = espalier_rounded_ray_status(&rounded);
            const RoundedRay expected = round_ray(in_cpp, {cpp(ray.origin), cpp(ray.direction)});
            REQUIRE(status == static_cast<espalier_query_status>(expected.status()));
            REQUIRE(std::memcmp(&rounded, &expected, sizeof rounded) == 0);
            const espalier_query_status answered = espalier_raycast_rounded(&blob, &rounded).status;
            if (status != ESPALIER_QUERY_OK) REQUIRE(answered == status);

            const espalier_lattice_point steps = any_bits<espalier_lattice_point>(random);
            const LatticePoint cpp_steps = std::bit_cast<LatticePoint>(steps);
            const Vec3 world = to_local(in_cpp, cpp_steps);
            const espalier_vec3 c_world = espalier_to_local(&region, &steps);
            REQUIRE(std::memcmp(&world, &c_world, sizeof world) == 0);
            const espalier_lattice_point_result nearest = espalier_to_lattice_point(&region, &ray.origin);
            const Result<LatticePoint> cpp_nearest = to_lattice(in_cpp, cpp(ray.origin));
            REQUIRE(nearest.status == static_cast<espalier_query_status>(cpp_nearest.status));
            REQUIRE(std::memcmp(&nearest.value, &cpp_nearest.value, sizeof nearest.value) == 0);
            const espalier_box box = {ray.origin, ray.direction};
            const espalier_lattice_box_result around = espalier_to_lattice_box(&region, &box);
            const Result<LatticeBox> cpp_around = to_lattice(in_cpp, Box{cpp(box.min), cpp(box.max)});
            REQUIRE(around.status == static_cast<espalier_query_status>(cpp_around.status));
            REQUIRE(std::memcmp(&around.value, &cpp_around.value, sizeof around.value) == 0);
        }
    }

    TEST_CASE("c api: any bits are safe as a hit and a remap and give the bits of C++") {
        const OpenedBlob opened = blob_with_everything(Profile::balanced);
        const espalier_blob blob = open_from_c(opened.bytes);
        const std::uint32_t count = espalier_blob_triangle_count(&blob);
        Random random(8);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            auto hit = any_bits<espalier_ray_hit>(random);
            const std::uint32_t triangles[] = {hit.triangle, random.below(count),      count - 1,
                                               count,        ESPALIER_NO_TRIANGLE - 1, ESPALIER_NO_TRIANGLE};
            hit.triangle = triangles[random.below(6)];
            const auto in_cpp = std::bit_cast<RayHit>(hit);
            const espalier_original_hit original = espalier_original_hit_of(&blob, &hit);
            const OriginalHit expected = original_hit(opened.blob, in_cpp);
            REQUIRE(original.status == static_cast<espalier_query_status>(expected.status));
            REQUIRE((original.status == ESPALIER_QUERY_OK) == (hit.triangle < count));
            REQUIRE(original.triangle == expected.triangle);
            REQUIRE(std::memcmp(&original.u, &expected.u, 2 * sizeof(float)) == 0);

            std::vector<espalier_original_triangle> remap(random.below(4));
            for (auto& entry : remap) entry = any_bits<espalier_original_triangle>(random);
            if (!remap.empty()) hit.triangle = random.below(static_cast<std::uint32_t>(remap.size()) + 1);
            const espalier_original_hit by_remap = espalier_original_hit_by_remap(remap.data(), remap.size(), &hit);
            const bool is_known = hit.triangle < remap.size() && remap[hit.triangle].first_corner < 3;
            REQUIRE((by_remap.status == ESPALIER_QUERY_OK) == is_known);
            if (is_known) REQUIRE(by_remap.triangle == remap[hit.triangle].triangle);
        }
        for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
            std::vector<std::byte> file(random.below(100));
            for (std::byte& byte : file) byte = static_cast<std::byte>(random.next());
            const ExactBuffer buffer(file, random.below(16));
            std::vector<espalier_original_triangle> remap(count, {7, 7, 7, 7});
            const auto old = remap;
            REQUIRE(espalier_read_remap(buffer.bytes().data(), file.size(), &blob, remap.data(), remap.size()) ==
                    ESPALIER_OPEN_NOT_A_REMAP);
            REQUIRE(std::equal(remap.begin(), remap.end(), old.begin(), same_bytes<espalier_original_triangle>));
        }
    }

    TEST_CASE("c api: hostile shapes are safe and a handle that was never opened refuses") {
        const espalier_blob empty = {};
        const Blob in_cpp;
        Random random(10);
        espalier_triangle_id page[2] = {};
        for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
            const auto box = any_bits<espalier_box>(random);
            const auto oriented = any_bits<espalier_oriented_box>(random);
            const auto cone = any_bits<espalier_cone>(random);
            const auto capsule = any_bits<espalier_capsule>(random);
            const auto sphere = any_bits<espalier_sphere>(random);
            const auto triangle = any_bits<espalier_triangle>(random);
            const auto plane = any_bits<espalier_plane>(random);
            const auto steps = any_bits<espalier_lattice_box>(random);
            const espalier_convex_volume volume = {&plane, 1};
            const espalier_cursor begin = {};
            for (const espalier_filled& found :
                 {espalier_collect_overlaps_box(&empty, &box, page, 2, begin),
                  espalier_collect_overlaps_oriented_box(&empty, &oriented, page, 2, begin),
                  espalier_collect_overlaps_cone(&empty, &cone, page, 2, begin),
                  espalier_collect_overlaps_capsule(&empty, &capsule, page, 2, begin),
                  espalier_collect_overlaps_sphere(&empty, &sphere, page, 2, begin),
                  espalier_collect_overlaps_triangle(&empty, &triangle, page, 2, begin),
                  espalier_collect_overlaps_convex_volume(&empty, &volume, page, 2, begin),
                  espalier_collect_overlaps_lattice_box(&empty, &steps, page, 2, begin)}) {
                REQUIRE(found.status == ESPALIER_QUERY_NOT_OPEN);
                REQUIRE(found.count == 0);
                REQUIRE(found.next.place[0] == 0);
            }
            compare_all(empty, empty, in_cpp, in_cpp, any_bits<question>(random));
        }
    }

    TEST_CASE("c api: any byte as an enumerator and any number of planes or start of a page is safe") {
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        const espalier_blob blob = open_from_c(opened.bytes);
        Random random(9);
        espalier_ray ray = espalier_default_ray({0.0f, 0.0f, 9.0f}, {0.2f, 0.0f, -1.0f});
        for (unsigned value = 0; value < 256; ++value) {
            ray.culling = static_cast<espalier_face_culling>(value);
            const Ray in_cpp = {cpp(ray.origin), cpp(ray.direction), ray.t_min, ray.t_max, FaceCulling{ray.culling}};
            const espalier_ray_hit c_hit = espalier_raycast(&blob, &ray);
            const RayHit hit = raycast(opened.blob, in_cpp);
            REQUIRE(std::memcmp(&c_hit, &hit, sizeof hit) == 0);
            const std::uint32_t triangle = random.below(100);
            const auto feature = static_cast<espalier_feature>(value);
            const espalier_vec3 c_normal =
                espalier_fix_internal_edge_normal(&blob, triangle, feature, {0.0f, 0.0f, 2.0f});
            const Vec3 normal = fix_internal_edge_normal(opened.blob, {triangle}, Feature{feature}, {0.0f, 0.0f, 2.0f});
            REQUIRE(std::memcmp(&c_normal, &normal, sizeof normal) == 0);
        }
        std::vector<espalier_plane> planes(ESPALIER_MAX_PLANES + 1, {{0.0f, 0.0f, 1.0f}, 100.0f});
        espalier_triangle_id page[2] = {};
        const espalier_cursor begin = {};
        for (std::size_t count = 0; count <= ESPALIER_MAX_PLANES; ++count) {
            const espalier_convex_volume volume = {planes.data(), count};
            CHECK(espalier_yes(espalier_overlaps_convex_volume(&blob, &volume)));
        }
        for (const std::size_t count : {planes.size(), std::numeric_limits<std::size_t>::max()}) {
            const espalier_convex_volume volume = {planes.data(), count};
            CHECK(espalier_overlaps_convex_volume(&blob, &volume).status == ESPALIER_QUERY_INVALID_ARGUMENT);
            bool is_visited = false;
            CHECK(espalier_for_each_overlap_convex_volume(&blob, &volume, set_visited, &is_visited) ==
                  ESPALIER_QUERY_INVALID_ARGUMENT);
            CHECK_FALSE(is_visited);
            CHECK(espalier_collect_overlaps_convex_volume(&blob, &volume, page, 2, begin).count == 0);
        }
        const std::vector<espalier_vec3> vertices(ESPALIER_MAX_HULL_VERTICES + 1, {0.0f, 0.0f, 9.0f});
        const espalier_vec3 down = {0.0f, 0.0f, -9.0f};
        for (const std::size_t count : {std::size_t{1}, std::size_t{ESPALIER_MAX_HULL_VERTICES}, vertices.size(),
                                        std::numeric_limits<std::size_t>::max()}) {
            const espalier_convex_hull hull = {vertices.data(), count};
            const bool is_refused = count > ESPALIER_MAX_HULL_VERTICES;
            const espalier_sweep_hit swept = espalier_sweep_convex_hull(&blob, &hull, down);
            CHECK((swept.status == ESPALIER_QUERY_INVALID_ARGUMENT) == is_refused);
            CHECK((espalier_rounding_error_sweep_convex_hull(&blob, &hull, down).status ==
                   ESPALIER_QUERY_INVALID_ARGUMENT) == is_refused);
        }
        const std::uint32_t all = espalier_blob_triangle_count(&blob);
        const espalier_sphere sphere = {{0.0f, 0.0f, 0.0f}, 100.0f};
        for (const std::uint32_t first : {all - 1, all, all + 1, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
            const espalier_cursor from = {{first, random.below(3), 0}};
            const espalier_filled found = espalier_collect_overlaps_sphere(&blob, &sphere, page, 2, from);
            CHECK(found.count == (first < all ? 1 : 0));
            CHECK(espalier_collect_overlaps_sphere(&blob, &sphere, nullptr, 0, from).count == 0);
        }
    }
    TEST_CASE("c api: a damaged scene with its checksum repaired opens as in C++ and gives the same bits") {
        const std::vector<std::byte> good = bake_instances(some_instances());
        const SceneOfBoth whole(good);
        Random random(15);
        std::uint64_t opened = 0;
        for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
            ExactBuffer buffer(good, random.below(16));
            const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
            const std::uint32_t behind_meshes = size - 4'000;  // nodes and instances
            for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes) {
                const std::uint32_t at = random.below(4) == 0 ? random.below(200) : behind_meshes + random.below(4'000);
                buffer.bytes()[at] ^= static_cast<std::byte>(1 + random.below(255));
            }
            repair_checksum(buffer.bytes());
            const SceneOfBoth both(buffer.bytes());
            REQUIRE(both.c_status == static_cast<espalier_open_status>(both.scene.status()));
            opened += both.scene ? 1u : 0u;
            compare_scenes(both.c_scene, both.scene, some_question(whole.scene, random));
        }
        CHECK(opened > 0);
    }

    TEST_CASE("c api: any bits are safe as a question about a scene") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth both(bytes);
        const espalier_scene empty = {};
        const BakedScene in_cpp;
        Random random(16);
        for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
            const auto asked = any_bits<question>(random);
            compare_scenes(both.c_scene, both.scene, asked);
            compare_scenes(empty, in_cpp, asked);
        }
    }
}
