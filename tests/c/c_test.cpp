// Claims about espalier.h: asked from C, every query answers what it answers C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include <espalier/espalier.h>
#include <espalier/espalier.hpp>

#include "../support/hostile_arguments.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"
#include "../support/test_blobs.hpp"
#include "../support/test_scale.hpp"
#include "expecting.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

espalier_vec3 c(Vec3 v) { return {v.x, v.y, v.z}; }

question some_question(const Blob& blob, Random& random) {
    question result = {};
    for (espalier_vec3& point : result.points) point = c(some_point(blob, random));
    const Vec3 size = {blob.bounds_max().x - blob.bounds_min().x, blob.bounds_max().y - blob.bounds_min().y,
                       blob.bounds_max().z - blob.bounds_min().z};
    for (espalier_vec3& direction : result.directions) {
        const Vec3 unit = random.in_cube(1.0f);
        direction = random.below(6) == 0 ? c(some_point(blob, random))
                                         : espalier_vec3{unit.x * size.x, unit.y * size.y, unit.z * size.z};
    }
    for (float& length : result.lengths) length = some_length(blob, random);
    for (float& number : result.rotation) number = random.signed_unit();
    result.bits = static_cast<std::uint32_t>(random.next());
    return result;
}

void remember(std::uint32_t word, void* words) { static_cast<std::vector<std::uint32_t>*>(words)->push_back(word); }

using Ask = void (*)(asking*);
using Expect = void (Expecting::*)();

/// The same question from both sides.
void compare(const std::string& family, Ask ask, Expect expect, const espalier_blob& c_blob,
             const espalier_blob& c_other, const Blob& blob, const Blob& other, const question& asked) {
    CAPTURE(family);
    std::vector<std::uint32_t> told;
    asking from_c = {&c_blob, &c_other, &asked, remember, &told, 0};
    ask(&from_c);
    Expecting expecting(blob, other, asked);
    (expecting.*expect)();
    const std::vector<std::uint32_t>& expected = expecting.words();
    REQUIRE(told.size() == expected.size());
    const auto word = std::mismatch(told.begin(), told.end(), expected.begin()).first - told.begin();
    REQUIRE(static_cast<std::size_t>(word) == told.size());
}

void compare_all(const espalier_blob& c_blob, const espalier_blob& c_other, const Blob& blob, const Blob& other,
                 const question& asked) {
    const auto both = [&](const std::string& family, Ask ask, Expect expect) {
        compare(family, ask, expect, c_blob, c_other, blob, other, asked);
    };
    both("lookups", ask_lookups, &Expecting::lookups);
    both("rays", ask_rays, &Expecting::rays);
    both("volumes", ask_volumes, &Expecting::volumes);
    both("points", ask_points, &Expecting::points);
    both("sweeps", ask_sweeps, &Expecting::sweeps);
    both("pairs", ask_pairs, &Expecting::pairs);
    both("approximations", ask_approximations, &Expecting::approximations);
    both("walks", ask_walks, &Expecting::walks);
    both("steps", ask_steps, &Expecting::steps);
    both("nothing", ask_nothing, &Expecting::nothing);
}

espalier_blob open_from_c(std::span<const std::byte> bytes) {
    espalier_blob blob;
    REQUIRE(espalier_open(bytes.data(), bytes.size(), &blob) == ESPALIER_STATUS_OK);
    return blob;
}

/// Every optional section.
OpenedBlob blob_with_everything(format::Profile profile) {
    Mesh mesh = make_torus(12, 8, 2.0, 0.5);
    mesh.materials.resize(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.materials.size(); ++i) mesh.materials[i] = static_cast<std::uint32_t>(i * 77);
    return {mesh, with_every_section(profile)};
}

OpenedBlob blob_with_materials_alone() {
    Mesh mesh = make_cube(-1.0f, 1.0f);
    mesh.materials.assign(mesh.triangles.size(), 5);
    BakeOptions options;
    options.materials = Materials::bits_8;
    return {mesh, options};
}

OpenedBlob blob_with_copies() {
    BakeOptions options = with_profile(format::Profile::fast);
    options.builder = Builder::spatial_splits;
    options.duplicates = 1.0;
    return {make_soup(60, 1), options};
}

}  // namespace

TEST_SUITE("c") {
    TEST_CASE("c api: every query gives the bits of C++") {
        std::vector<OpenedBlob> special;
        for (const format::Profile profile : every_profile) special.push_back(blob_with_everything(profile));
        special.push_back(blob_with_materials_alone());
        special.push_back(blob_with_copies());
        std::vector<const OpenedBlob*> blobs;
        for (const TestBlob& blob : small_test_blobs()) blobs.push_back(&blob.opened);
        for (const OpenedBlob& blob : special) blobs.push_back(&blob);
        Random random(1);
        for (const OpenedBlob* opened : blobs) {
            const OpenedBlob& other = *blobs[random.below(static_cast<std::uint32_t>(blobs.size()))];
            const espalier_blob c_blob = open_from_c(opened->bytes), c_other = open_from_c(other.bytes);
            for (std::uint64_t i = 0; i < scaled(20); ++i)
                compare_all(c_blob, c_other, opened->blob, other.blob, some_question(opened->blob, random));
        }
    }

    TEST_CASE("c api: a blob filled with zeros is the empty blob") {
        espalier_blob zero;
        std::memset(&zero, 0, sizeof zero);
        static const Blob empty;  // static, so that what lies between its fields is zero too
        CHECK(std::memcmp(&zero, static_cast<const void*>(&empty), sizeof zero) == 0);
        const OpenedBlob opened = blob_with_everything(format::Profile::fast);
        const espalier_blob c_opened = open_from_c(opened.bytes);
        Random random(2);
        for (std::uint64_t i = 0; i < scaled(50); ++i) {
            const question asked = some_question(opened.blob, random);
            compare_all(zero, zero, empty, empty, asked);
            compare_all(zero, c_opened, empty, opened.blob, asked);
            compare_all(c_opened, zero, opened.blob, empty, asked);
        }
    }

    TEST_CASE("c api: a ray and a placement from C have the defaults of C++") {
        const Ray ray = {.origin = {1, 2, 3}, .direction = {4, 5, 6}};
        const espalier_ray c_ray = espalier_ray_from({1, 2, 3}, {4, 5, 6});
        CHECK(c(ray.origin).x == c_ray.origin.x);
        CHECK(c(ray.direction).z == c_ray.direction.z);
        CHECK(ray.t_min == c_ray.t_min);
        CHECK(ray.t_max == c_ray.t_max);
        CHECK(static_cast<espalier_faces>(ray.faces) == c_ray.faces);
        const Placement placement;
        const espalier_placement c_placement = espalier_unplaced();
        CHECK(std::memcmp(&placement, &c_placement, sizeof placement) == 0);
    }

    TEST_CASE("c api: every status has the same sentence in C") {
        for (unsigned value = 0; value < 256; ++value) {
            const auto byte = static_cast<std::uint8_t>(value);
            CHECK(std::string(espalier_describe_status(byte)) == describe(Status{byte}));
            CHECK(std::string(espalier_describe_query_status(byte)) == describe(QueryStatus{byte}));
        }
    }

    TEST_CASE("c api: opening gives the status of C++ and no half-open blob") {
        const OpenedBlob good = blob_with_everything(format::Profile::balanced);
        CHECK(misbehaviour_of_open(good.bytes.data(), good.bytes.size()) == 0);
        std::vector<std::byte> bytes(good.bytes.begin(), good.bytes.end());
        Random random(3);
        for (int i = 0; i < 500; ++i) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
            const std::byte was = bytes[at];
            bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
            Blob blob;
            espalier_blob c_blob;
            const Status status = open(bytes, blob);
            REQUIRE(espalier_open(bytes.data(), bytes.size(), &c_blob) == static_cast<espalier_status>(status));
            REQUIRE(espalier_open_trusted_image(bytes.data(), bytes.size(), &c_blob) ==
                    static_cast<espalier_status>(open_trusted_image(bytes, blob)));
            bytes[at] = was;
        }
    }
}
