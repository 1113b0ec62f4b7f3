// Claims about the rules of scene files: open_scene() enforces each of them, and names what breaks it.
#include "support/testing.hpp"

#include "maker.hpp"

namespace espalier::tests::scenes_rules_test {
namespace {

using namespace espalier::format::scene;

/// Returns two cubes of one mesh, moved by whole steps, in a scene.
OpenedScene two_cubes() {
    const std::vector<OpenedBlob> blobs = opened_blobs({make_cube(-1.0f, 1.0f)});
    std::vector<Instance> instances(2);
    instances[1].transform.translation.x = 4.0f;
    return {blobs, instances};
}
/// Returns the same, turned: without a common lattice.
OpenedScene two_turned_cubes() {
    const std::vector<OpenedBlob> blobs = opened_blobs({make_cube(-1.0f, 1.0f)});
    std::vector<Instance> instances(2);
    for (Instance& instance : instances) instance.transform.rotation = {0.1f, 0.2f, 0.3f, 0.9f};
    return {blobs, instances};
}
/// Returns two cubes as a tile of a scene.
OpenedScene cubes_in_tile() {
    std::vector<OpenedScene> tiles;
    tiles.push_back(two_cubes());
    return {{}, std::vector<Instance>(1), tiles};
}

OpenStatus status_of_scene(Bytes bytes, std::size_t room = 64) {
    put(bytes, total_bytes_at, bytes.size(), 4);
    repair_checksum(bytes);
    std::vector<Blob> meshes(room);
    std::vector<BakedScene> tiles(room);
    return open_scene(bytes, meshes, tiles).status();
}
OpenStatus scene_with(Bytes bytes, std::size_t at, std::uint64_t value, unsigned size = 4) {
    put(bytes, at, value, size);
    return status_of_scene(std::move(bytes));
}

std::size_t nodes_at(const OpenedScene& scene) {
    return static_cast<std::size_t>(detail::data_of(scene.scene).tree.nodes - scene.bytes.data());
}
std::size_t record_at(const OpenedScene& scene, std::size_t instance) {
    return static_cast<std::size_t>(detail::data_of(scene.scene).tree.leaves - scene.bytes.data()) +
           instance * instance_bytes;
}
std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }

TEST_CASE("scene: each rule of the header is enforced") {
    const OpenedScene scene = two_cubes(), turned = two_turned_cubes();
    REQUIRE(scene.scene.common_lattice());
    REQUIRE_FALSE(turned.scene.common_lattice());
    const Bytes& bytes = scene.bytes;
    CHECK(status_of_scene(bytes) == OpenStatus::ok);
    Bytes damaged = bytes;
    put(damaged, record_at(scene, 0) + user_at, 1, 4);
    std::vector<Blob> meshes(1);
    CHECK(open_scene(damaged, meshes).status() == OpenStatus::bad_checksum);
    for (const std::uint32_t features : {4u, 5u, 0x80000001u})
        CHECK(scene_with(bytes, features_at, features) == OpenStatus::unsupported_feature);
    // Numbers at their limits break only the rules of what follows.
    for (const std::size_t at : {mesh_count_at, tile_count_at, instance_count_at, node_count_at}) {
        CAPTURE(at);
        CHECK(scene_with(bytes, at, 1u << 24) == OpenStatus::bad_section);
        CHECK(scene_with(bytes, at, (1u << 24) + 1) == OpenStatus::bad_header);
    }
    CHECK(scene_with(bytes, depth_at, format::max_depth, 2) == OpenStatus::bad_node);
    CHECK(scene_with(bytes, depth_at, format::max_depth + 1, 2) == OpenStatus::bad_header);
    CHECK(scene_with(bytes, depth_at + 1, 1, 1) == OpenStatus::bad_header);
    for (const std::size_t at : {instance_count_at, node_count_at, depth_at})
        CHECK(scene_with(bytes, at, 0, at == depth_at ? 2 : 4) == OpenStatus::bad_header);
    CHECK(scene_with(bytes, extent_at, 1u << 24) == OpenStatus::bad_header);
    for (std::size_t at = zeros_at; at < header_bytes; ++at)
        CHECK(scene_with(bytes, at, 1, 1) == OpenStatus::bad_header);
    CHECK(scene_with(bytes, common_extent_at, 1u << 24) == OpenStatus::bad_header);
    CHECK(scene_with(bytes, common_step_exponent_at + 2, 1, 2) == OpenStatus::bad_header);
    for (std::size_t at = common_origin_at; at < tile_mesh_count_at; ++at)
        CHECK(scene_with(turned.bytes, at, 1, 1) == OpenStatus::bad_header);
    const OpenedScene tiled = cubes_in_tile();
    REQUIRE(get(tiled.bytes, tile_mesh_count_at, 4) == 1);
    for (const std::uint32_t other : {0u, 2u, 0xFFFFFFFFu})
        CHECK(scene_with(tiled.bytes, tile_mesh_count_at, other) == OpenStatus::bad_header);
}

TEST_CASE("scene: each rule of a scene without instances is enforced") {
    const OpenedScene empty({}, {});
    REQUIRE(empty.bytes.size() == header_bytes);
    CHECK(status_of_scene(empty.bytes) == OpenStatus::ok);
    for (const std::size_t at : {instance_count_at, node_count_at, depth_at})
        CHECK(scene_with(empty.bytes, at, 1, at == depth_at ? 1 : 4) == OpenStatus::bad_header);
    Bytes with_extent = empty.bytes;
    put(with_extent, extent_at, 5, 4);
    repair_checksum(with_extent);
    const OpenedScene without_boxes(with_extent);
    CHECK(without_boxes.scene.bounds().max == Vec3{});
    Bytes bytes = empty.bytes;
    put(bytes, mesh_count_at, 1, 4);
    CHECK(mesh_count_of_scene(bytes) == 1);  // one more header would fit in, by the size alone
    put(bytes, mesh_count_at, 2, 4);
    CHECK(mesh_count_of_scene(bytes) == 0);
}

TEST_CASE("scene: each rule of the parts is enforced") {
    const OpenedScene scene = two_cubes();
    const Bytes& bytes = scene.bytes;
    const std::size_t first_mesh_at = aligned(header_bytes + part_size_bytes);
    const std::uint64_t mesh_size = get(bytes, header_bytes, 4);
    CHECK(scene_with(bytes, header_bytes, bytes.size() - 1) == OpenStatus::bad_section);
    CHECK(scene_with(bytes, header_bytes, bytes.size() - first_mesh_at + 1) == OpenStatus::bad_section);
    CHECK(scene_with(bytes, header_bytes, 0xFFFFFFFF) == OpenStatus::bad_section);
    CHECK(scene_with(bytes, first_mesh_at - 1, 1, 1) == OpenStatus::bad_section);
    CHECK(scene_with(bytes, first_mesh_at, 0, 1) == OpenStatus::not_a_blob);
    for (std::size_t at = first_mesh_at + mesh_size; at < nodes_at(scene); ++at)
        CHECK(scene_with(bytes, at, 1, 1) == OpenStatus::bad_section);
    Bytes longer = bytes, shorter = bytes;
    longer.resize(bytes.size() + 1);
    shorter.pop_back();
    CHECK(status_of_scene(longer) == OpenStatus::bad_section);
    const auto first_bytes = [&](std::size_t count) {
        return Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    };
    CHECK(status_of_scene(first_bytes(header_bytes)) == OpenStatus::bad_section);
    CHECK(status_of_scene(first_bytes(header_bytes + part_size_bytes)) == OpenStatus::bad_section);
    CHECK(status_of_scene(first_bytes(nodes_at(scene))) == OpenStatus::bad_section);
    CHECK(status_of_scene(shorter) == OpenStatus::bad_section);
    CHECK(scene_with(bytes, instance_count_at, 3) == OpenStatus::bad_section);
    CHECK(scene_with(bytes, node_count_at, 1000) == OpenStatus::bad_section);
    // More parts than headers fit in: refused before the arrays of the caller count.
    Bytes many = bytes;
    put(many, mesh_count_at, bytes.size() / header_bytes + 1, 4);
    CHECK(status_of_scene(many, 0) == OpenStatus::bad_section);
    CHECK(status_of_scene(bytes, 0) == OpenStatus::too_few_meshes);
    put(many, mesh_count_at, 1, 4);
    put(many, tile_mesh_count_at, bytes.size() / header_bytes - 1, 4);
    CHECK(status_of_scene(many, 1) == OpenStatus::too_few_meshes);
    put(many, tile_mesh_count_at, bytes.size() / header_bytes, 4);
    CHECK(status_of_scene(many, 1) == OpenStatus::bad_header);
    const OpenedScene tiled = cubes_in_tile();
    CHECK(status_of_scene(tiled.bytes) == OpenStatus::ok);
    CHECK(scene_with(tiled.bytes, header_bytes, 0xFFFFFFFF) == OpenStatus::bad_section);
}

TEST_CASE("scene: a tile that states tiles or meshes in tiles is refused") {
    const OpenedScene tiled = cubes_in_tile();
    const std::size_t tile_at = aligned(header_bytes + part_size_bytes);
    for (const std::size_t at : {tile_count_at, tile_mesh_count_at}) {
        Bytes bytes = tiled.bytes;
        put(bytes, tile_at + at, 1, 4);
        repair_checksum(std::span(bytes).subspan(tile_at, tiled.tiles[0].size()));
        CHECK(status_of_scene(bytes) == OpenStatus::bad_header);
    }
}

TEST_CASE("scene: each rule of nodes and instances is enforced") {
    const OpenedScene scene = two_cubes();
    const Bytes& bytes = scene.bytes;
    const std::size_t counts_at = nodes_at(scene) + format::packed_node::children_at + 3;
    REQUIRE(get(bytes, counts_at, 1) == 2u << 4);  // two leaves
    CHECK(scene_with(bytes, counts_at, 1u << 4, 1) == OpenStatus::bad_node);
    CHECK(scene_with(bytes, counts_at, 3u << 4, 1) == OpenStatus::bad_node);
    const std::size_t record = record_at(scene, 1);
    const auto with = [&](std::size_t at, float value) { return scene_with(bytes, record + at, bits_of(value)); };
    CHECK(with(scale_at, 0x1p-100f) == OpenStatus::ok);
    CHECK(with(scale_at, std::nextafter(0x1p-100f, 0.0f)) == OpenStatus::bad_instance);
    CHECK(with(scale_at, 0x1p100f) == OpenStatus::ok);
    CHECK(with(scale_at, std::nextafter(0x1p100f, infinity)) == OpenStatus::bad_instance);
    for (const float scale : {0.0f, -1.0f, infinity, not_a_number})
        CHECK(with(scale_at, scale) == OpenStatus::bad_instance);
    CHECK(with(translation_at + 4, infinity) == OpenStatus::bad_instance);
    CHECK(with(rotation_at, infinity) == OpenStatus::bad_instance);
    CHECK(with(rotation_at + 12, 0.0f) == OpenStatus::bad_instance);  // all four are zero then
    CHECK(scene_with(bytes, record + format::scene::mesh_at, 1) == OpenStatus::bad_instance);
}

TEST_CASE("scene: opening finds the coarsest step and the largest scale also in tiles") {
    const std::vector<OpenedBlob> blobs = opened_blobs({make_cube(-1.0f, 1.0f)});
    const float step = std::ldexp(1.0f, blobs[0].blob.lattice().step_exponent);
    const auto scaled_to = [](std::initializer_list<float> scales) {
        std::vector<Instance> instances;
        for (const float scale : scales) instances.emplace_back().transform.scale = scale;
        return instances;
    };
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(blobs, scaled_to({3.0f, 8.0f, 0.5f}));
    const detail::SceneData& tile = detail::data_of(tiles[0].scene);
    CHECK(tile.coarsest_step == 8.0f * step);
    CHECK(tile.largest_scale == 8.0f);
    const OpenedScene outer({}, scaled_to({0.25f, 2.0f, 1.0f}), tiles);
    CHECK(detail::data_of(outer.scene).coarsest_step == 16.0f * step);
    CHECK(detail::data_of(outer.scene).largest_scale == 16.0f);
    tiles.clear();
    tiles.emplace_back(blobs, scaled_to({0.5f}));
    const OpenedScene of_small({}, scaled_to({4.0f}), tiles);
    CHECK(detail::data_of(of_small.scene).largest_scale == 4.0f);
}

}  // namespace
}  // namespace espalier::tests::scenes_rules_test
