// Tests that no argument of espalier.h does harm, and that hostile ones get the bits of C++. Worth most under
// sanitizers.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
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

/// A value of which every bit is random, or every float or integer one that breaks careless code.
template <class T>
T any_bits(Random& random) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    std::array<std::uint32_t, sizeof(T) / 4> words;
    for (std::uint32_t& word : words) {
        const auto any = static_cast<std::uint32_t>(random.next());
        const auto small = static_cast<std::uint32_t>(static_cast<std::int32_t>(any) >> random.below(32));
        const float hostile = hostile_values[random.below(hostile_values.size())];
        word = std::array{any, small, std::bit_cast<std::uint32_t>(hostile)}[random.below(3)];
    }
    return std::bit_cast<T>(words);
}

template <class T>
bool same_bytes(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

espalier_visit set_visited(espalier_triangle, void* is_visited) {
    *static_cast<bool*>(is_visited) = true;
    return ESPALIER_KEEP_GOING;
}

}  // namespace

TEST_SUITE("hostile") {
    TEST_CASE("c api: each size but the right one is refused and leaves an empty handle") {
        const OpenedBlob good = blob_with_everything(format::Profile::small);
        const Blob empty;
        Random random(4);
        const auto check = [&](const std::byte* bytes, std::size_t size, Status expected) {
            for (const auto open_it : {espalier_open, espalier_open_trusted_image}) {
                espalier_blob blob = open_from_c(good.bytes);  // an old view must not be left behind
                REQUIRE(open_it(bytes, size, &blob) == static_cast<espalier_status>(expected));
                REQUIRE(espalier_blob_size_bytes(&blob) == 0);
                if (random.below(64) == 0) compare_all(blob, blob, empty, empty, some_question(good.blob, random));
            }
        };
        for (std::size_t size = 0; size < good.bytes.size(); ++size) {
            const ExactBuffer shorter(std::span(good.bytes).first(size));
            check(shorter.bytes().data(), size, Status::too_short);
        }
        std::vector<std::byte> longer(good.bytes.begin(), good.bytes.end());
        for (int more = 0; more < 20; ++more) {
            longer.push_back(std::byte{0});
            check(longer.data(), longer.size(), Status::trailing_bytes);
        }
        // The header alone refuses these, also where their lowest 32 bits are those of the right size.
        check(longer.data(), std::numeric_limits<std::size_t>::max(), Status::trailing_bytes);
        if constexpr (sizeof(std::size_t) > 4)
            check(longer.data(), good.bytes.size() + (std::size_t{1} << 16 << 16), Status::trailing_bytes);
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
            Blob blob;
            espalier_blob c_blob;
            std::memset(&c_blob, 0xA5, sizeof c_blob);  // what is in it before opening does not matter
            const Status status = open(buffer.bytes(), blob);
            REQUIRE(espalier_open(buffer.bytes().data(), size, &c_blob) == static_cast<espalier_status>(status));
            opened += status == Status::ok ? 1u : 0u;
            compare_all(c_blob, c_other, blob, other.blob, some_question(good.blob, random));
            compare_all(c_other, c_blob, other.blob, blob, some_question(good.blob, random));
        }
        CHECK(opened > 0);
    }

    TEST_CASE("c api: any words are safe as a rounded ray and give the bits of C++") {
        const OpenedBlob opened = blob_with_everything(format::Profile::balanced);
        const espalier_blob blob = open_from_c(opened.bytes);
        const espalier_lattice region = espalier_lattice_of(&blob);
        Random random(6);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            espalier_rounded_ray rounded = {};
            if (i != 0) {
                const espalier_ray ray = espalier_ray_from(c(some_point(opened.blob, random)), c(random.in_cube(2.0f)));
                (void)espalier_round_ray(&region, &ray, &rounded);
                const auto any = any_bits<espalier_rounded_ray>(random);
                const std::uint32_t one_in = 1 + random.below(30);
                for (std::size_t word = 0; word < std::size(any.opaque_); ++word)
                    if (random.below(one_in) == 0) rounded.opaque_[word] = any.opaque_[word];
            }
            const auto in_cpp = std::bit_cast<RoundedRay>(rounded);
            espalier_ray_hit c_hit = {};
            RayHit hit = std::bit_cast<RayHit>(c_hit);
            bool c_any = false, any = false;
            const espalier_query_status status = espalier_raycast_rounded(&blob, &rounded, &c_hit);
            REQUIRE(status == static_cast<espalier_query_status>(raycast(opened.blob, in_cpp, hit)));
            REQUIRE(espalier_occluded_rounded(&blob, &rounded, &c_any) == status);
            REQUIRE(occluded(opened.blob, in_cpp, any) == static_cast<QueryStatus>(status));
            REQUIRE(std::memcmp(&c_hit, &hit, sizeof hit) == 0);
            REQUIRE(c_any == any);
            if (i == 0) CHECK_FALSE(any);
        }
    }

    TEST_CASE("c api: any bits are safe as a region and a lattice and give the bits of C++") {
        const OpenedBlob opened = blob_with_everything(format::Profile::fast);
        const espalier_blob blob = open_from_c(opened.bytes);
        Random random(7);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            espalier_lattice region = any_bits<espalier_lattice>(random);
            if (random.coin()) region.step_exponent = static_cast<std::int32_t>(random.below(220)) - 110;
            const auto in_cpp = std::bit_cast<Lattice>(region);
            const espalier_ray ray =
                espalier_ray_from(c(some_point(opened.blob, random)), c(some_point(opened.blob, random)));
            espalier_rounded_ray rounded;
            espalier_ray_hit hit = {};
            const espalier_query_status status = espalier_round_ray(&region, &ray, &rounded);
            const RoundedRay expected = round_ray(in_cpp, {cpp(ray.origin), cpp(ray.direction)});
            REQUIRE(status == static_cast<espalier_query_status>(expected.status()));
            REQUIRE(std::memcmp(&rounded, &expected, sizeof rounded) == 0);
            const espalier_query_status answered = espalier_raycast_rounded(&blob, &rounded, &hit);
            if (status != ESPALIER_QUERY_OK) REQUIRE(answered == status);

            espalier_steps steps = any_bits<espalier_steps>(random);
            Steps cpp_steps = std::bit_cast<Steps>(steps);
            const Vec3 world = to_world(in_cpp, cpp_steps);
            const espalier_vec3 c_world = espalier_to_world(&region, &steps);
            REQUIRE(std::memcmp(&world, &c_world, sizeof world) == 0);
            REQUIRE(espalier_to_steps(&region, &ray.origin, &steps) ==
                    static_cast<espalier_query_status>(to_steps(in_cpp, cpp(ray.origin), cpp_steps)));
            REQUIRE(std::memcmp(&steps, &cpp_steps, sizeof steps) == 0);
            const espalier_box box = {ray.origin, ray.direction};
            espalier_box_in_steps around = {{1, 2, 3}, {4, 5, 6}};
            auto cpp_around = std::bit_cast<BoxInSteps>(around);
            REQUIRE(espalier_steps_around(&region, &box, &around) ==
                    static_cast<espalier_query_status>(steps_around(in_cpp, {cpp(box.min), cpp(box.max)}, cpp_around)));
            REQUIRE(std::memcmp(&around, &cpp_around, sizeof around) == 0);
        }
    }

    TEST_CASE("c api: any bits are safe as a hit and a remap and give the bits of C++") {
        const OpenedBlob opened = blob_with_everything(format::Profile::balanced);
        const espalier_blob blob = open_from_c(opened.bytes);
        const std::uint32_t count = espalier_blob_triangle_count(&blob);
        Random random(8);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            auto hit = any_bits<espalier_ray_hit>(random);
            const std::uint32_t triangles[] = {hit.triangle, random.below(count),      count - 1,
                                               count,        ESPALIER_NO_TRIANGLE - 1, ESPALIER_NO_TRIANGLE};
            hit.triangle = triangles[random.below(6)];
            const auto in_cpp = std::bit_cast<RayHit>(hit);
            const espalier_original_hit original = espalier_get_original_hit(&blob, &hit);
            const OriginalHit expected = original_hit(opened.blob, in_cpp);
            REQUIRE(original.status == static_cast<espalier_query_status>(expected.status));
            REQUIRE((original.status == ESPALIER_QUERY_OK) == (hit.triangle < count));
            REQUIRE(original.triangle == expected.triangle);
            REQUIRE(std::memcmp(&original.u, &expected.u, 2 * sizeof(float)) == 0);

            std::vector<espalier_original_triangle> remap(random.below(4));
            for (auto& entry : remap) entry = any_bits<espalier_original_triangle>(random);
            if (!remap.empty()) hit.triangle = random.below(static_cast<std::uint32_t>(remap.size()) + 1);
            const espalier_original_hit by_remap = espalier_get_original_hit_by_remap(remap.data(), remap.size(), &hit);
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
                    ESPALIER_STATUS_NOT_A_REMAP);
            REQUIRE(std::equal(remap.begin(), remap.end(), old.begin(), same_bytes<espalier_original_triangle>));
        }
    }

    TEST_CASE("c api: hostile shapes and an empty handle give an empty page or are refused") {
        const espalier_blob empty = {};
        const Blob in_cpp;
        Random random(10);
        espalier_triangle page[2] = {};
        for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
            const auto box = any_bits<espalier_box>(random);
            const auto oriented = any_bits<espalier_oriented_box>(random);
            const auto capsule = any_bits<espalier_capsule>(random);
            const auto sphere = any_bits<espalier_sphere>(random);
            const auto triangle = any_bits<espalier_corners>(random);
            const auto plane = any_bits<espalier_plane>(random);
            const auto steps = any_bits<espalier_box_in_steps>(random);
            for (const espalier_overlap_page& found :
                 {espalier_collect_overlaps_box(&empty, &box, page, 2, 0),
                  espalier_collect_overlaps_oriented_box(&empty, &oriented, page, 2, 0),
                  espalier_collect_overlaps_capsule(&empty, &capsule, page, 2, 0),
                  espalier_collect_overlaps_sphere(&empty, &sphere, page, 2, 0),
                  espalier_collect_overlaps_triangle(&empty, &triangle, page, 2, 0),
                  espalier_collect_overlaps_planes(&empty, &plane, 1, page, 2, 0),
                  espalier_collect_overlaps_box_in_steps(&empty, &steps, page, 2, 0)}) {
                REQUIRE(found.status <= ESPALIER_QUERY_OUT_OF_RANGE);
                REQUIRE(found.count == 0);
                REQUIRE(found.next == 0);
            }
            compare_all(empty, empty, in_cpp, in_cpp, any_bits<question>(random));
        }
    }

    TEST_CASE("c api: any byte as an enumerator and any number of planes or start of a page is safe") {
        const OpenedBlob opened = blob_with_everything(format::Profile::fast);
        const espalier_blob blob = open_from_c(opened.bytes);
        Random random(9);
        espalier_ray ray = espalier_ray_from({0.0f, 0.0f, 9.0f}, {0.2f, 0.0f, -1.0f});
        for (unsigned value = 0; value < 256; ++value) {
            ray.faces = static_cast<espalier_faces>(value);
            espalier_ray_hit c_hit = {};
            RayHit hit = std::bit_cast<RayHit>(c_hit);
            const Ray in_cpp = {cpp(ray.origin), cpp(ray.direction), ray.t_min, ray.t_max, Faces{ray.faces}};
            REQUIRE(espalier_raycast(&blob, &ray, &c_hit) == raycast(opened.blob, in_cpp, hit));
            REQUIRE(std::memcmp(&c_hit, &hit, sizeof hit) == 0);
            const espalier_contact contact = {
                random.below(100), static_cast<espalier_feature>(value), {0.0f, 0.0f, 1.0f}};
            espalier_vec3 c_normal = {};
            Vec3 normal = {};
            REQUIRE(espalier_is_on_inner_edge(&blob, &contact, &c_normal) ==
                    is_on_inner_edge(opened.blob, {{contact.triangle}, Feature{contact.feature}, {0.0f, 0.0f, 1.0f}},
                                     normal));
            REQUIRE(std::memcmp(&c_normal, &normal, sizeof normal) == 0);
        }
        std::vector<espalier_plane> planes(ESPALIER_MAX_PLANES + 1, {{0.0f, 0.0f, 1.0f}, 100.0f});
        espalier_triangle page[2] = {};
        for (std::size_t count = 0; count <= ESPALIER_MAX_PLANES; ++count)
            CHECK(espalier_overlaps_planes(&blob, planes.data(), count));
        for (const std::size_t count : {planes.size(), std::numeric_limits<std::size_t>::max()}) {
            CHECK_FALSE(espalier_overlaps_planes(&blob, planes.data(), count));
            bool is_visited = false;
            CHECK(espalier_for_each_overlap_planes(&blob, planes.data(), count, set_visited, &is_visited));
            CHECK_FALSE(is_visited);
            CHECK(espalier_collect_overlaps_planes(&blob, planes.data(), count, page, 2, 0).count == 0);
        }
        const std::uint32_t all = espalier_blob_triangle_count(&blob);
        const espalier_sphere sphere = {{0.0f, 0.0f, 0.0f}, 100.0f};
        for (const std::uint32_t first : {all - 1, all, all + 1, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu}) {
            const espalier_overlap_page found = espalier_collect_overlaps_sphere(&blob, &sphere, page, 2, first);
            CHECK(found.count == (first < all ? 1 : 0));
            CHECK(espalier_collect_overlaps_sphere(&blob, &sphere, nullptr, 0, first).count == 0);
        }
    }
}
