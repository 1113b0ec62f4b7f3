// Claims about deformation.h: refitted and queried from C, a deformable mesh answers what it answers C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include <c99.h>

#include "both.hpp"
#include "fixtures.hpp"
#include "support/base/checksum.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/aligned_buffer.hpp"
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

/// A deformable blob of C, and a mesh that copied its moving part.
struct MeshOfC {
    explicit MeshOfC(const Bytes& bytes) {
        REQUIRE(c99_open(bytes.data(), bytes.size(), &blob) == ESPALIER_OPEN_OK);
        memory.resize(c99_deformable_bytes(&blob));
        REQUIRE(c99_create_deformable(&blob, memory.data(), memory.size(), &mesh) == ESPALIER_QUERY_OK);
    }
    espalier_refit_result refit(const std::vector<Vec3>& positions) {
        return c99_deformable_refit(&mesh, reinterpret_cast<const espalier_vec3*>(positions.data()), positions.size());
    }
    [[nodiscard]] Bytes sealed() const {
        Bytes bytes(c99_blob_size(&blob));
        REQUIRE(c99_deformable_seal(&mesh, bytes.data(), bytes.size()) == ESPALIER_QUERY_OK);
        return bytes;
    }
    [[nodiscard]] Box bounds() const { return to<Box>(c99_blob_bounds(c99_deformable_blob(&mesh))); }

    espalier_blob blob;
    espalier_deformable mesh;
    Bytes memory;
};

/// Checks that a mesh refuses everything with a status.
void check_refused(espalier_deformable& mesh, espalier_query_status status) {
    const espalier_vec3 position = {0, 0, 0};
    std::byte byte{0xA5};
    const espalier_box range = c99_deformable_range(&mesh), zero = {};
    CHECK(c99_deformable_status(&mesh) == status);
    CHECK(c99_deformable_position_count(&mesh) == 0);
    CHECK(std::memcmp(&range, &zero, sizeof range) == 0);
    CHECK(c99_blob_status(c99_deformable_blob(&mesh)) == ESPALIER_OPEN_NOT_OPENED);
    for (const std::size_t count : {0u, 1u}) {
        const espalier_refit_result result = c99_deformable_refit(&mesh, count == 0 ? nullptr : &position, count);
        CHECK(result.status == status);
        CHECK(result.position == 0);
        CHECK(result.quality == 0.0f);
        CHECK(c99_deformable_seal(&mesh, count == 0 ? nullptr : &byte, count) == status);
    }
    CHECK(byte == std::byte{0xA5});
}

bool is_filled(std::span<const std::byte> bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte byte) { return byte == std::byte{0xA5}; });
}

bool holds(const Box& outer, const Box& inner) {
    return outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
           outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z;
}

}  // namespace

TEST_SUITE("deformation") {
    TEST_CASE("c api: refits and queries of a deformable mesh give the bits of C++") {
        Random random(31);
        Both answered;
        for (const unsigned bits : {8u, 16u, 21u})
            for (const Mesh& mesh : {make_torus(12, 8, 2.0, 0.5), make_soup(60, 1), make_terrain(6, 2)}) {
                const MeshInPoses deformed(mesh, bits);
                Both both;
                REQUIRE(both.open(deformed.bytes) == OpenStatus::ok);
                REQUIRE(both.create_deformable() == QueryStatus::ok);
                for (const std::vector<Vec3>& pose : deformed.poses) {
                    both.refit(pose, some_question(both.blob(), random));
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
        REQUIRE(both.create_deformable() == QueryStatus::ok);
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
                buffer.bytes()[random.below(random.coin() ? 128 : size)] ^=
                    static_cast<std::byte>(1 + random.below(255));
            repair_checksum(buffer.bytes());
            Both both;
            static_cast<void>(both.open(buffer.bytes()));
            opened += both.create_deformable() == QueryStatus::ok ? 1u : 0u;
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
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        espalier_blob blob, rigid, zero_blob = {};
        REQUIRE(c99_open(deformed.bytes.data(), deformed.bytes.size(), &blob) == ESPALIER_OPEN_OK);
        REQUIRE(c99_open(opened.bytes.data(), opened.bytes.size(), &rigid) == ESPALIER_OPEN_OK);
        espalier_deformable mesh, zero = {};
        check_refused(zero, ESPALIER_QUERY_NOT_OPEN);
        const std::size_t size = c99_deformable_bytes(&blob);
        REQUIRE(size > 0);
        CHECK(size < c99_blob_size(&blob));
        CHECK(c99_blob_is_deformable(&blob));
        CHECK_FALSE(c99_blob_is_deformable(&rigid));
        CHECK(c99_deformable_bytes(&rigid) == 0);
        CHECK(c99_deformable_bytes(&zero_blob) == 0);

        Bytes memory(size + 100, std::byte{0xA5});
        const struct {
            const espalier_blob* from;
            void* place;
            std::size_t size;
            espalier_query_status status;
        } refused[] = {{&zero_blob, memory.data(), memory.size(), ESPALIER_QUERY_NOT_OPEN},
                       {&rigid, memory.data(), memory.size(), ESPALIER_QUERY_NO_DATA},
                       {&blob, nullptr, 0, ESPALIER_QUERY_NO_ROOM},
                       {&blob, memory.data(), size - 1, ESPALIER_QUERY_NO_ROOM},
                       {&blob, memory.data(), 1, ESPALIER_QUERY_NO_ROOM}};
        for (const auto& r : refused) {
            std::memset(&mesh, 0xA5, sizeof mesh);
            CHECK(c99_create_deformable(r.from, r.place, r.size, &mesh) == r.status);
            check_refused(mesh, r.status);
        }
        alignas(16) std::byte room[2 * sizeof mesh];
        std::memset(room, 0xA5, sizeof room);
        for (std::size_t offset = 1; offset < 16; ++offset)
            CHECK(c99_create_deformable(
                      &blob, memory.data(), memory.size(),
                      reinterpret_cast<espalier_deformable*>(reinterpret_cast<std::uintptr_t>(room) + offset)) ==
                  ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(is_filled(room));
        CHECK(is_filled(memory));
        for (std::size_t offset = 0; offset < 4; ++offset) {
            std::fill(memory.begin(), memory.end(), std::byte{0xA5});
            CHECK(c99_create_deformable(&blob, memory.data() + offset, size, &mesh) == ESPALIER_QUERY_OK);
            CHECK(c99_deformable_status(&mesh) == ESPALIER_QUERY_OK);
            CHECK(is_filled(std::span(memory).first(offset)));
            CHECK(is_filled(std::span(memory).subspan(offset + size)));
        }
    }

    TEST_CASE("c api: a refit refuses positions that are no numbers or out of range and names the first") {
        const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
        MeshOfC mesh(deformed.bytes);
        const std::vector<Vec3>& rest = deformed.mesh.positions;
        const std::vector<Vec3> pose = stretched(deformed.mesh);
        const Box range = to<Box>(c99_deformable_range(&mesh.mesh));
        const auto count = static_cast<std::uint32_t>(rest.size());
        REQUIRE(c99_deformable_position_count(&mesh.mesh) == count);
        const auto check_position = [&](std::uint32_t index, Vec3 position, espalier_query_status status) {
            std::vector<Vec3> positions = pose;
            positions[index] = positions[count - 1] = position;
            const Bytes before = mesh.memory;
            const espalier_refit_result result = mesh.refit(positions);
            CHECK(result.status == status);
            CHECK(result.position == index);
            CHECK(result.quality == 0.0f);
            CHECK(mesh.memory == before);
        };
        for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z})
            for (const float value : {NAN, INFINITY, -INFINITY, 3e38f, -3e38f}) {
                Vec3 position = range.min;
                position.*axis = value;
                check_position(count / 2, position,
                               std::isfinite(value) ? ESPALIER_QUERY_OUT_OF_RANGE : ESPALIER_QUERY_INVALID_ARGUMENT);
            }
        const float behind = range.max.x + (range.max.x - range.min.x) / 1000;
        check_position(0, {behind, range.max.y, range.max.z}, ESPALIER_QUERY_OUT_OF_RANGE);
        const auto* const positions = reinterpret_cast<const espalier_vec3*>(rest.data());
        for (const std::size_t given : {std::size_t{0}, std::size_t{count - 1}, SIZE_MAX}) {  // none is read
            const espalier_refit_result result =
                c99_deformable_refit(&mesh.mesh, given == 0 ? nullptr : positions, given);
            CHECK(result.status == ESPALIER_QUERY_INVALID_ARGUMENT);
            CHECK(result.position == std::min<std::size_t>(given, count));
        }
        const espalier_refit_result posed = mesh.refit(pose), rested = mesh.refit(rest);
        CHECK(posed.status == ESPALIER_QUERY_OK);
        CHECK(posed.position == 0);
        CHECK(posed.quality > 0.0f);
        CHECK(rested.status == ESPALIER_QUERY_OK);
        CHECK(std::fabs(rested.quality - 1.0f) < 1e-5f);
    }

    TEST_CASE("c api: a sealed mesh is the blob of its pose in memory of exactly its size") {
        const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
        const std::vector<Vec3> pose = stretched(deformed.mesh);
        MeshOfC mesh(deformed.bytes);
        const std::size_t size = deformed.bytes.size();
        Bytes whole(size + 1, std::byte{0xA5});
        for (const std::size_t other : {size - 1, size + 1})
            CHECK(c99_deformable_seal(&mesh.mesh, whole.data(), other) == ESPALIER_QUERY_NO_ROOM);
        CHECK(c99_deformable_seal(&mesh.mesh, nullptr, 0) == ESPALIER_QUERY_NO_ROOM);
        CHECK(is_filled(whole));
        CHECK(c99_deformable_seal(&mesh.mesh, whole.data(), size) == ESPALIER_QUERY_OK);
        CHECK(whole.back() == std::byte{0xA5});
        whole.pop_back();
        CHECK(whole == deformed.bytes);  // at rest
        REQUIRE(mesh.refit(pose).status == ESPALIER_QUERY_OK);
        Bytes posed = mesh.sealed();
        espalier_blob opened;
        REQUIRE(c99_open(posed.data(), size, &opened) == ESPALIER_OPEN_OK);
        CHECK(c99_blob_checksum(&opened) != c99_blob_checksum(&mesh.blob));
        const espalier_box bounds = c99_blob_bounds(&opened);
        const Box moved = to<Box>(bounds), in_mesh = mesh.bounds();
        CHECK(std::memcmp(&moved, &in_mesh, sizeof moved) == 0);
        CHECK(moved.max.x > c99_blob_bounds(&mesh.blob).max.x);

        // The bytes of a blob as the memory of the mesh: they become those that the other mesh sealed.
        Bytes copy = deformed.bytes;
        espalier_blob in_place;
        espalier_deformable other;
        REQUIRE(c99_open(copy.data(), size, &in_place) == ESPALIER_OPEN_OK);
        REQUIRE(c99_create_deformable(&in_place, copy.data(), c99_deformable_bytes(&in_place), &other) ==
                ESPALIER_QUERY_OK);
        REQUIRE(c99_deformable_refit(&other, reinterpret_cast<const espalier_vec3*>(pose.data()), pose.size()).status ==
                ESPALIER_QUERY_OK);
        REQUIRE(c99_deformable_seal(&other, copy.data(), size) == ESPALIER_QUERY_OK);
        CHECK(copy == posed);

        // A mesh of a mesh has its pose, and a copy of a mesh is as good as the mesh.
        const espalier_deformable same = mesh.mesh;
        REQUIRE(c99_create_deformable(c99_deformable_blob(&same), copy.data(), copy.size(), &other) ==
                ESPALIER_QUERY_OK);
        REQUIRE(mesh.refit(deformed.mesh.positions).status == ESPALIER_QUERY_OK);
        REQUIRE(c99_deformable_seal(&other, whole.data(), size) == ESPALIER_QUERY_OK);
        REQUIRE(c99_open(whole.data(), size, &opened) == ESPALIER_OPEN_OK);
        const espalier_box kept = c99_blob_bounds(&opened);
        CHECK(std::memcmp(&kept, &bounds, sizeof kept) == 0);
    }

    TEST_CASE("c api: instances of a refitted mesh move in a moving scene and do not leave the world") {
        const MeshInPoses deformed(make_torus(12, 8, 2.0, 0.5), 16);
        const std::vector<Vec3> pose = stretched(deformed.mesh);
        MeshOfC mesh(deformed.bytes);
        const espalier_blob meshes[1] = {*c99_deformable_blob(&mesh.mesh)};
        AlignedBuffer memory(20'000);
        espalier_moving_scene scene;
        espalier_scene view;
        REQUIRE(c99_create_moving_scene(memory.bytes().data(), 20'000, 8, -16, meshes, 1, nullptr, 0, &scene));
        CHECK(c99_moving_scene_move_instances_of(&scene, 0) == ESPALIER_QUERY_OK);  // there are none
        CHECK_FALSE(c99_moving_scene_must_refit(&scene));
        espalier_transform place = c99_identity();
        const espalier_instance instance = {place, 0, 1, 0, 0};
        const espalier_instance_handle_result inserted = c99_moving_scene_insert(&scene, &instance);
        REQUIRE(inserted.status == ESPALIER_QUERY_OK);
        const espalier_instance_handle handle = inserted.value;
        const auto box = [&] { return to<Box>(c99_moving_scene_box_of(&scene, handle).value); };
        REQUIRE(mesh.refit(pose).status == ESPALIER_QUERY_OK);
        CHECK_FALSE(holds(box(), mesh.bounds()));  // still the one of the rest
        for (const std::uint32_t other : {1u, UINT32_MAX})
            CHECK(c99_moving_scene_move_instances_of(&scene, other) == ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK_FALSE(c99_moving_scene_must_refit(&scene));
        CHECK(c99_moving_scene_move_instances_of(&scene, 0) == ESPALIER_QUERY_OK);
        CHECK(holds(box(), mesh.bounds()));
        CHECK(c99_moving_scene_view(&scene, &view) == ESPALIER_QUERY_NOT_REFITTED);
        c99_moving_scene_refit(&scene);
        CHECK(c99_moving_scene_view(&scene, &view) == ESPALIER_QUERY_OK);
        const espalier_closest_point_result in_scene =
            c99_scene_closest_point(&view, {100, 0, 0}, 1000, UINT32_MAX).hit;
        const espalier_closest_point_result in_mesh = c99_closest_point(&meshes[0], {100, 0, 0}, 1000);
        CHECK(in_scene.status == ESPALIER_QUERY_OK);
        CHECK(in_scene.triangle == in_mesh.triangle);
        CHECK(in_mesh.distance < 100 - c99_blob_bounds(&mesh.blob).max.x);  // nearer than at rest

        // A pose that leaves the world is refused, and changes nothing.
        REQUIRE(mesh.refit(deformed.mesh.positions).status == ESPALIER_QUERY_OK);
        CHECK(c99_moving_scene_move_instances_of(&scene, 0) == ESPALIER_QUERY_OK);
        float last = 0, beyond = 1;  // along x
        const auto moves_to = [&](float x) {
            place.translation.x = x;
            return c99_moving_scene_move(&scene, handle, &place) == ESPALIER_QUERY_OK;
        };
        for (; moves_to(beyond); beyond *= 2) last = beyond;
        for (int i = 0; i < 40; ++i) {
            const float middle = last + (beyond - last) / 2;
            (moves_to(middle) ? last : beyond) = middle;
        }
        REQUIRE(moves_to(last));
        CHECK(last >= 1.0f);
        c99_moving_scene_refit(&scene);
        CHECK(c99_moving_scene_move_instances_of(&scene, 0) == ESPALIER_QUERY_OK);
        c99_moving_scene_refit(&scene);
        REQUIRE(mesh.refit(pose).status == ESPALIER_QUERY_OK);
        const Bytes before(memory.bytes().begin(), memory.bytes().end());
        CHECK(c99_moving_scene_move_instances_of(&scene, 0) == ESPALIER_QUERY_OUT_OF_RANGE);
        CHECK(std::equal(before.begin(), before.end(), memory.bytes().begin()));
        CHECK_FALSE(c99_moving_scene_must_refit(&scene));
    }
}
