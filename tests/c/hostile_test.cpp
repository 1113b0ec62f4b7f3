// Tests that no argument of espalier.h does harm, and that hostile ones get the bits of C++. Worth most under
// sanitizers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "both.hpp"
#include "fixtures.hpp"
#include "support/base/checksum.hpp"
#include "support/base/profiles.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/exact_buffer.hpp"

using namespace espalier;
using namespace espalier::tests;

TEST_CASE("c api: garbage with its checksum repaired opens as in C++ and gives the same bits") {
    const OpenedBlob other = blob_with_copies();
    Random random(5);
    std::uint64_t opened = 0;
    for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
        const OpenedBlob good = blob_with_everything(every_profile[i % every_profile.size()]);
        ExactBuffer buffer(good.bytes, random.below(16));
        const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
        for (std::uint32_t changes = 1 + random.below(4); changes > 0; --changes)
            buffer.bytes()[random.below(size)] ^= static_cast<std::byte>(1 + random.below(255));
        repair_checksum(buffer.bytes());
        Both both;
        const std::size_t place = random.below(2);
        opened += both.open(buffer.bytes(), place) == OpenStatus::ok ? 1u : 0u;
        REQUIRE(both.open(other.bytes, 1 - place) == OpenStatus::ok);
        both.compare(Takes::blob, some_question(good.blob, random));
    }
    CHECK(opened > 0);
}

TEST_CASE("c api: any bits are safe as arguments and give the bits of C++") {
    const OpenedBlob opened = blob_with_everything(Profile::balanced), other = blob_with_everything(Profile::fast);
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Both both, never_opened;
    REQUIRE(both.open(opened.bytes) == OpenStatus::ok);
    REQUIRE(both.open(other.bytes, 1) == OpenStatus::ok);
    REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
    Random random(10);
    for (std::uint64_t i = 0; i < scaled(1'500); ++i) {
        for (Pool* const pool : {both.c.get(), both.cpp.get()}) pool->input.resize(i % 100);
        both.compare(Takes::blob, some_question(opened.blob, random), true);
        if (i % 4 == 0) both.compare(Takes::blob, any_bits<question>(random), true);
        if (i % 4 == 1) both.compare(Takes::scene, any_bits<question>(random), true);
        if (i % 4 == 2) never_opened.compare(Takes::blob, any_bits<question>(random), true);
        if (i % 4 == 3) never_opened.compare(Takes::scene, any_bits<question>(random), true);
    }
    for (const std::string& name : never_opened.answered) {
        CHECK(name.find("overlap") == std::string::npos);
        CHECK(name.find("raycast") == std::string::npos);
    }
}

TEST_CASE("c api: a damaged scene with its checksum repaired opens as in C++ and gives the same bits") {
    const std::vector<std::byte> good = bake_instances(some_instances());
    Both whole;
    REQUIRE(whole.open_scene(good) == OpenStatus::ok);
    Random random(15);
    std::uint64_t opened = 0;
    for (std::uint64_t i = 0; i < scaled(500); ++i) {
        ExactBuffer buffer(good, random.below(16));
        const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
        const std::uint32_t behind_meshes = size - 4'000;  // nodes and instances
        for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes) {
            const std::uint32_t at = random.below(4) == 0 ? random.below(200) : behind_meshes + random.below(4'000);
            buffer.bytes()[at] ^= static_cast<std::byte>(1 + random.below(255));
        }
        repair_checksum(buffer.bytes());
        Both both;
        opened += both.open_scene(buffer.bytes()) == OpenStatus::ok ? 1u : 0u;
        both.compare(Takes::scene, some_question(whole.scene(), random));
    }
    CHECK(opened > 0);
}
