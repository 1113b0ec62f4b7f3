// Claims about scenes of any bytes: open_scene() refuses them, or every query on them is safe.
#include "support/testing.hpp"

#include "arguments.hpp"

namespace espalier::tests::scenes_hostile_test {
namespace {

/// Opens the bytes at the end of an allocation, and runs every query if they are accepted.
bool exercise(const std::vector<std::byte>& bytes) {
    std::vector<Blob> meshes(64);
    std::vector<BakedScene> tiles(16);
    const std::vector<std::byte> exact(bytes);
    const BakedScene scene = open_scene(exact, meshes, tiles);
    CHECK(scene.status() == (scene ? OpenStatus::ok : scene.status()));
    const SceneArguments arguments = {.ray = {{-30.0f, 0.1f, 0.2f}, {1.0f, 0.01f, 0.02f}},
                                      .point = {1.0f, 2.0f, 3.0f},
                                      .sphere = {{0.5f, 0.5f, 0.5f}, 3.0f},
                                      .capsule = {{-2.0f, 0.0f, 0.0f}, {3.0f, 1.0f, 0.0f}, 1.0f},
                                      .box = {{-1.0f, -1.0f, -1.0f}, {2.0f, 3.0f, 4.0f}},
                                      .turned = {{1.0f, 0.0f, 0.0f}, {{1, 1, 0}, {-1, 1, 0}, {0, 0, 2}}},
                                      .triangle = {{-9.0f, 0.0f, 0.0f}, {9.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 9.0f}},
                                      .cone = {{-4.0f, 0.0f, 0.0f}, {8.0f, 0.0f, 0.0f}, 2.0f},
                                      .displacement = {5.0f, 0.0f, 0.0f},
                                      .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                      .options = {.skin = 0.5f}};
    static_cast<void>(ask_everything(scene, arguments));
    static_cast<void>(sweep(scene, arguments.sphere, arguments.displacement)->t);
    static_cast<void>(verify_scene(exact).sound);
    return static_cast<bool>(scene);
}

const TestScene& small_scene() {
    for (const TestScene& test : test_scenes())
        if (test.name == "few") return test;
    return test_scenes().front();
}

/// One tile of one cube, placed twice, and a cube.
const OpenedScene& tiled_scene() {
    static const OpenedScene scene = [] {
        const std::vector<OpenedBlob> blobs = opened_blobs({make_cube(-1.0f, 1.0f)});
        std::vector<OpenedScene> tiles;
        tiles.emplace_back(blobs, std::vector<Instance>(1));
        std::vector<Instance> instances(3);
        instances[0].mesh = instances[1].mesh = 1;
        instances[1].transform.translation.x = instances[2].transform.translation.z = 4.0f;
        return OpenedScene(blobs, instances, tiles);
    }();
    return scene;
}

TEST_CASE("scene: a scene that was baked is sound") {
    for (const TestScene& test : test_scenes()) {
        CAPTURE(test.name);
        const VerifyReport report = verify_scene(test.opened.bytes);
        CHECK_MESSAGE(report, report.message);
    }
}

TEST_CASE("scene: every truncation and every trailing byte is refused") {
    std::vector<std::byte> bytes = small_scene().opened.bytes;
    std::vector<Blob> meshes(8);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
        REQUIRE(open_scene(cut, meshes).status() == OpenStatus::too_short);
        REQUIRE(mesh_count_of_scene(cut) == 0);
    }
    bytes.push_back(std::byte{0});
    CHECK(open_scene(bytes, meshes).status() == OpenStatus::trailing_bytes);
}

TEST_CASE("scene: an array that is too small for the meshes is refused") {
    const std::vector<std::byte>& bytes = small_scene().opened.bytes;
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    REQUIRE(meshes.size() > 1);
    CHECK(open_scene(bytes, meshes));
    CHECK(open_scene(bytes, std::span(meshes).first(meshes.size() - 1)).status() == OpenStatus::too_few_meshes);
    CHECK(open_scene(small_scene().blobs[0].bytes, meshes).status() == OpenStatus::not_a_scene);
    CHECK(open(bytes).status() == OpenStatus::not_a_blob);
}

TEST_CASE("scene: every flipped bit is refused and with its checksum repaired refused or safe") {
    const std::vector<std::byte>& original = small_scene().opened.bytes;
    const detail::SceneData& data = detail::data_of(small_scene().opened.scene);
    const auto nodes_at = static_cast<std::size_t>(data.tree.nodes - original.data());
    std::size_t accepted = 0, tried = 0;
    for (std::size_t byte = 0; byte < original.size(); ++byte) {
        // The meshes have a test of their own: open_test.
        if (byte > format::scene::header_bytes + 64 && byte + 64 < nodes_at) continue;
        for (const std::size_t bit : sampled(8, 4, byte)) {
            std::vector<std::byte> bytes = original;
            bytes[byte] ^= static_cast<std::byte>(1u << bit);
            std::vector<Blob> meshes(64);
            const bool is_checksum = byte / 4 == format::scene::checksum_at / 4;
            REQUIRE_FALSE(open_scene(bytes, meshes));
            if (is_checksum) continue;
            repair_checksum(bytes);
            ++tried;
            accepted += exercise(bytes) ? 1u : 0u;
        }
    }
    CHECK(tried > (takes_every_case() ? 4000 : 1000));
    CHECK(accepted > 0);
    CHECK(accepted < tried);
}

TEST_CASE("scene: every field of header and records may hold any number") {
    const std::vector<std::byte>& original = small_scene().opened.bytes;
    const detail::SceneData& data = detail::data_of(small_scene().opened.scene);
    const auto records_at = static_cast<std::size_t>(data.tree.leaves - original.data());
    const std::uint32_t values[] = {0,          1,          2,          0x7FFFFFFF, 0x80000000, 0xFFFFFFFF,
                                    0x7F800000, 0xFF800000, 0x7FC00000, 0x00000001, 0x00800000, 0x0D800000,
                                    0x71800000, 0x3F800000, 0xBF800000, 0x01000000};
    const auto try_at = [&](std::size_t at) {
        for (const std::uint32_t value : values) {
            std::vector<std::byte> bytes = original;
            put(bytes, at, value, 4);
            repair_checksum(bytes);
            exercise(bytes);
        }
    };
    for (std::size_t at = 0; at < format::scene::header_bytes + 16; at += 4)
        if (at != format::scene::checksum_at) try_at(at);
    for (std::size_t at = records_at; at + 4 <= original.size(); at += 4) try_at(at);
}

TEST_CASE("scene: every word of a scene with tiles may hold any number") {
    const std::vector<std::byte>& original = tiled_scene().bytes;
    const std::size_t tile_size = tiled_scene().tiles[0].size();
    const auto tile_at = static_cast<std::size_t>(detail::data_of(tiled_scene().tiles[0]).tree.bytes - original.data());
    std::size_t accepted = 0, tried = 0;
    for (std::size_t at = 0; at + 4 <= original.size(); at += 4) {
        if (at >= format::scene::header_bytes + 64 && at < tile_at) continue;  // the mesh
        for (const std::uint32_t value : {0u, 1u, 2u, 0xFFFFFFu, 0x80000000u, 0xFFFFFFFFu, 0x7F800000u}) {
            std::vector<std::byte> bytes = original;
            put(bytes, at, value, 4);
            repair_checksum(std::span(bytes).subspan(tile_at, tile_size));
            repair_checksum(bytes);
            ++tried;
            accepted += exercise(bytes) ? 1u : 0u;
        }
    }
    CHECK(accepted > 0);
    CHECK(accepted < tried);
}

TEST_CASE("scene: too little room for tiles and tiles in tiles are refused") {
    const std::vector<std::byte>& bytes = tiled_scene().bytes;
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    std::vector<BakedScene> tiles(tile_count_of_scene(bytes));
    REQUIRE(tiles.size() == 1);
    CHECK(open_scene(bytes, meshes, tiles));
    CHECK(open_scene(bytes, meshes).status() == OpenStatus::too_few_meshes);
    CHECK(open_scene(bytes, std::span(meshes).first(meshes.size() - 1), tiles).status() == OpenStatus::too_few_meshes);
    const std::vector<std::span<const std::byte>> nested = {bytes};
    const SceneBakeResult baked = bake_scene(nested, std::vector<Instance>(1));
    CHECK(baked.status == BakeStatus::invalid_mesh);
    CHECK(baked.message.find("tiles hold no tiles") != std::string::npos);
}

TEST_CASE("scene: a damaged tree that opens is found by verify_scene") {
    const TestScene& test = small_scene();
    const detail::SceneData& data = detail::data_of(test.opened.scene);
    const auto nodes_at = static_cast<std::size_t>(data.tree.nodes - test.opened.bytes.data());
    std::vector<std::byte> bytes = test.opened.bytes;
    std::byte& plane = bytes[nodes_at + format::packed_node::hi_at];
    REQUIRE(plane != bytes[nodes_at + format::packed_node::lo_at]);
    plane = bytes[nodes_at + format::packed_node::lo_at];
    repair_checksum(bytes);
    std::vector<Blob> meshes(8);
    REQUIRE(open_scene(bytes, meshes));
    const VerifyReport report = verify_scene(bytes);
    CHECK_FALSE(report);
    CHECK(report.message.find("box") != std::string::npos);
}

TEST_CASE("scene: a common lattice that is not that of the instances is found by verify_scene") {
    const std::vector<std::byte>& original = tiled_scene().bytes;
    REQUIRE(tiled_scene().scene.common_lattice());
    for (const std::size_t at : {format::scene::common_extent_at, format::scene::common_extent_at + 8}) {
        std::vector<std::byte> bytes = original;
        put(bytes, at, 0xFFFFFF, 4);
        repair_checksum(bytes);
        const VerifyReport report = verify_scene(bytes);
        CHECK_FALSE(report);
        CHECK(report.message.find("common lattice") != std::string::npos);
        std::vector<Blob> meshes(mesh_count_of_scene(bytes));
        std::vector<BakedScene> tiles(tile_count_of_scene(bytes));
        const BakedScene scene = open_scene(bytes, meshes, tiles);
        REQUIRE(scene);
        Random random(12);  // a region that is too large costs time, and no answer
        for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
            const Vec3 from = {8.0f * random.signed_unit(), 8.0f * random.signed_unit(), 20.0f};
            const Ray ray = {from, {random.signed_unit(), random.signed_unit(), -8.0f}};
            checked(compare_rays(scene, ray));
        }
    }
}

TEST_CASE("scene: instances that are as far away as float32 reaches lie in their boxes") {
    const std::vector<OpenedBlob> blobs = opened_blobs({make_cube(-1.0f, 1.0f)});
    for (int exponent = 90; exponent < 124; ++exponent) {
        std::vector<Instance> instances(1);
        instances[0].transform.translation.x = std::ldexp(1.3f, exponent);
        const OpenedScene scene(blobs, instances);
        CAPTURE(exponent);
        const VerifyReport report = verify_scene(scene.bytes);
        CHECK_MESSAGE(report, report.message);
    }
}

}  // namespace
}  // namespace espalier::tests::scenes_hostile_test
