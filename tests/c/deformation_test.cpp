// Claims about deformation.h: refitted and queried from C, a deformable mesh answers what it answers C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <c99.h>

#include "both.hpp"
#include "fixtures.hpp"
#include "room.hpp"
#include "support/base/checksum.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/exact_buffer.hpp"
#include "support/meshes/makers.hpp"
#include "support/meshes/motions.hpp"
#include "support/queries/hostile_arguments.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

/// Returns the positions of a mesh, twice as far from 0 along x.
std::vector<Vec3> stretched(const Mesh& mesh) {
    std::vector<Vec3> pose = mesh.positions;
    for (Vec3& position : pose) position.x *= 2.0f;
    return pose;
}

/// A mesh with materials, its deformable blob, and poses that are in its range.
struct MeshInPoses {
    MeshInPoses(Mesh source, unsigned bits) : mesh(std::move(source)), poses(every_pose(mesh)) {
        poses.push_back(stretched(mesh));
        mesh.materials.resize(mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.materials.size(); ++i) mesh.materials[i] = static_cast<std::uint32_t>(i * 77);
        BakeOptions options;
        options.profile = Profile::fast;
        options.resolution = Resolution::bits(bits);
        options.deformation.emplace();
        options.deformation->range = box_around(poses);
        bytes = bake_or_throw(mesh, options);
        poses.push_back(mesh.positions);
    }

    Mesh mesh;
    std::vector<std::vector<Vec3>> poses;  ///< the last one is that of the bake
    std::vector<std::byte> bytes;
};

using Bytes = std::vector<std::byte>;

}  // namespace

TEST_CASE("c api: refits and queries of a deformable mesh give the bits of C++") {
    Random random(31);
    Both answered;
    for (const unsigned bits : {8u, 16u, 21u})
        for (const Mesh& mesh : {make_torus(12, 8, 2.0, 0.5), make_soup(60, 1), make_terrain(6, 2)}) {
            const MeshInPoses deformed(mesh, bits);
            Both both;
            REQUIRE(both.open(deformed.bytes) == OpenStatus::ok);
            REQUIRE(both.create_deformable(deformable_bytes(both.blob())) == QueryStatus::ok);
            for (const std::vector<Vec3>& pose : deformed.poses) {
                for (const std::size_t given :
                     {pose.size() - 1, std::size_t{SIZE_MAX}, pose.size()})  // or none is read
                    both.refit({pose.data(), given}, some_question(both.blob(), random));
                for (std::uint64_t i = 0; i < scaled(3); ++i)
                    both.compare(Takes::blob, some_question(both.blob(), random));
                Bytes sealed(deformed.bytes.size());
                REQUIRE(seal(both.mesh(), sealed) == QueryStatus::ok);
                REQUIRE(open(sealed));
                if (&pose == &deformed.poses.back()) CHECK(sealed == deformed.bytes);
            }
            answered.answered.merge(both.answered);
        }
    for (const Entry& entry : entries)
        if (entry.takes == Takes::deformable) CHECK(answered.answered.count(entry.name) == 1);
}

TEST_CASE("c api: any bits are safe as positions and a refused refit changes nothing") {
    const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
    Both both;
    REQUIRE(both.open(deformed.bytes) == OpenStatus::ok);
    REQUIRE(both.create_deformable(deformable_bytes(both.blob())) == QueryStatus::ok);
    Random random(33);
    Bytes before(deformed.bytes.size()), after = before;
    REQUIRE(seal(both.mesh(), before) == QueryStatus::ok);
    std::uint64_t refits = 0;
    const std::uint64_t rounds = scaled(500);
    for (std::uint64_t i = 0; i < rounds; ++i) {
        std::vector<Vec3> positions = deformed.poses[random.below(8)];
        for (std::uint32_t changes = random.below(4); changes > 0; --changes) {
            Vec3& position = positions[random.below(static_cast<std::uint32_t>(positions.size()))];
            position = random.coin() ? any_bits<Vec3>(random) : some_point(both.blob(), random);
        }
        if (random.below(16) == 0) positions.resize(random.below(200));
        both.refit(positions, some_question(both.blob(), random));
        const bool is_refitted = static_cast<bool>(refit(both.mesh(), positions));  // to the same once more
        REQUIRE(both.are_memories_equal());
        refits += is_refitted ? 1u : 0u;
        REQUIRE(seal(both.mesh(), after) == QueryStatus::ok);
        if (!is_refitted) REQUIRE(after == before);
        before = after;
        if (random.below(8) == 0) both.compare(Takes::blob, any_bits<question>(random));
    }
    if (asks_enough()) CHECK(refits > rounds / 8);
    CHECK(refits < rounds);
}

TEST_CASE("c api: a damaged deformable blob opens as in C++ and gives the same bits") {
    const MeshInPoses deformed(make_soup(60, 1), 16);
    const OpenedBlob good{Bytes(deformed.bytes)};
    Random random(34);
    std::uint64_t opened = 0, refits = 0;
    const std::uint64_t rounds = scaled(1'000);
    for (std::uint64_t i = 0; i < rounds; ++i) {
        ExactBuffer buffer(deformed.bytes, random.below(16));
        const auto size = static_cast<std::uint32_t>(buffer.bytes().size());
        for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes)
            buffer.bytes()[random.below(random.coin() ? 128 : size)] ^= static_cast<std::byte>(1 + random.below(255));
        repair_checksum(buffer.bytes());
        Both both;
        static_cast<void>(both.open(buffer.bytes()));
        opened += both.create_deformable(deformable_bytes(both.blob())) == QueryStatus::ok ? 1u : 0u;
        std::vector<Vec3> positions = deformed.poses[random.below(8)];
        if (random.coin()) positions.resize(both.mesh().position_count() % 10'000);
        both.refit(positions, some_question(good.blob, random));
        refits += refit(both.mesh(), positions) ? 1u : 0u;  // to the same once more
        both.compare(Takes::blob, some_question(good.blob, random));
    }
    CHECK(opened > 0);
    CHECK(opened < rounds);
    if (asks_enough()) CHECK(refits > 0);
}

TEST_CASE("c api: a deformable mesh is created at aligned addresses with enough memory alone") {
    const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
    const OpenedBlob rigid = blob_with_everything(Profile::fast);
    Random random(32);
    std::size_t needed = 0;
    for (const std::span<const std::byte> bytes : {std::span<const std::byte>(deformed.bytes), {rigid.bytes}, {}})
        for (const std::size_t more : {std::size_t{0}, SIZE_MAX, std::size_t{100}}) {
            Both both;
            static_cast<void>(both.open(bytes));
            needed = std::max(needed, deformable_bytes(both.blob()));
            const QueryStatus status = both.create_deformable(needed + more);
            CHECK((status == QueryStatus::ok) == (bytes.data() == deformed.bytes.data() && more != SIZE_MAX));
            both.refit(deformed.poses[0], some_question(rigid.blob, random));
        }
    espalier_blob blob;
    espalier_deformable mesh;
    Bytes memory(needed);
    REQUIRE(c99_open(deformed.bytes.data(), deformed.bytes.size(), &blob) == ESPALIER_OPEN_OK);
    check_misaligned<espalier_deformable>(16, [&](espalier_deformable* place) {
        return c99_create_deformable(&blob, memory.data(), needed, place) == ESPALIER_QUERY_INVALID_ARGUMENT;
    });
    CHECK(memory == Bytes(needed));
    CHECK(c99_create_deformable(&blob, nullptr, 0, &mesh) == ESPALIER_QUERY_NO_ROOM);
    CHECK(c99_deformable_status(&mesh) == ESPALIER_QUERY_NO_ROOM);
}
