#include "both.hpp"

#include <doctest/doctest.h>

namespace espalier::tests {

namespace {

template <class C, class Cpp>
void put(C& place, const Cpp& object) {
    place = std::bit_cast<C>(object);
}

/// The first multiple of 32 in memory that has 31 bytes more than needed.
std::byte* aligned(std::vector<std::byte>& memory) {
    return memory.data() + (32 - reinterpret_cast<std::uintptr_t>(memory.data()) % 32) % 32;
}

/// Where rays are rounded for all instances of a scene or for one blob.
Lattice region_of(const BakedScene& scene, const MovingScene& moving, const Blob& blob) {
    if (scene.common_lattice()) return *scene.common_lattice();
    if (!scene.meshes().empty()) return scene.meshes()[0].lattice();
    return moving.meshes().empty() ? blob.lattice() : moving.meshes()[0].lattice();
}

}  // namespace

Both::Both() {
    for (espalier_blob& blob : cpp->blob) put(blob, Blob());
    for (espalier_scene& scene : cpp->scene) put(scene, BakedScene());
    put(cpp->moving_scene[0], MovingScene());
    put(cpp->deformable[0], Deformable());
}

OpenStatus Both::open(std::span<const std::byte> bytes, std::size_t place) {
    std::memset(&c->blob[place], 0xA5, sizeof c->blob[place]);  // what is in it before opening does not matter
    const espalier_open_status status = c99_open(bytes.data(), bytes.size(), &c->blob[place]);
    const Blob blob = espalier::open(bytes);
    put(cpp->blob[place], blob);
    REQUIRE(status == static_cast<espalier_open_status>(blob.status()));
    return blob.status();
}

OpenStatus Both::open_scene(std::span<const std::byte> bytes) {
    c_meshes_.resize(c99_scene_mesh_count(bytes.data(), bytes.size()));
    c_tiles_.resize(c99_scene_tile_count(bytes.data(), bytes.size()));
    meshes_.resize(mesh_count_of_scene(bytes));
    tiles_.resize(tile_count_of_scene(bytes));
    std::memset(&c->scene[0], 0xA5, sizeof c->scene[0]);
    const espalier_open_status status = c99_open_scene(bytes.data(), bytes.size(), c_meshes_.data(), c_meshes_.size(),
                                                       c_tiles_.data(), c_tiles_.size(), &c->scene[0]);
    const BakedScene scene = espalier::open_scene(bytes, meshes_, tiles_);
    put(cpp->scene[0], scene);
    c->input.assign(bytes.begin(), bytes.end());
    cpp->input = c->input;
    REQUIRE(status == static_cast<espalier_open_status>(scene.status()));
    return scene.status();
}

bool Both::create_moving_scene(std::uint32_t capacity, int step_exponent, std::size_t size, std::size_t offset) {
    c_memory_.assign(size + offset + 31, std::byte{0});
    memory_ = c_memory_;
    std::size_t meshes = 0, tiles = 0;
    const espalier_blob* const c_meshes = c99_scene_meshes(&c->scene[0], &meshes);
    const espalier_scene* const c_tiles = c99_scene_tiles(&c->scene[0], &tiles);
    const bool is_open = c99_create_moving_scene(aligned(c_memory_) + offset, size, capacity, step_exponent, c_meshes,
                                                 meshes, c_tiles, tiles, &c->moving_scene[0]);
    put(cpp->moving_scene[0], espalier::create_moving_scene({aligned(memory_) + offset, size}, capacity, step_exponent,
                                                            scene().meshes(), scene().tiles()));
    REQUIRE(is_open == static_cast<bool>(moving()));
    is_moving_ = true;
    REQUIRE(are_memories_equal());
    return is_open;
}

bool Both::open_moving_scene(std::span<const std::byte> snapshot) {
    c_memory_.assign(snapshot.size() + 31, std::byte{0});
    memory_ = c_memory_;
    std::copy(snapshot.begin(), snapshot.end(), aligned(c_memory_));
    std::copy(snapshot.begin(), snapshot.end(), aligned(memory_));
    std::size_t meshes = 0, tiles = 0;
    const espalier_blob* const c_meshes = c99_scene_meshes(&c->scene[0], &meshes);
    const espalier_scene* const c_tiles = c99_scene_tiles(&c->scene[0], &tiles);
    const bool is_open = c99_open_moving_scene(aligned(c_memory_), snapshot.size(), c_meshes, meshes, c_tiles, tiles,
                                               &c->moving_scene[0]);
    put(cpp->moving_scene[0],
        espalier::open_moving_scene({aligned(memory_), snapshot.size()}, scene().meshes(), scene().tiles()));
    REQUIRE(is_open == static_cast<bool>(moving()));
    is_moving_ = true;
    return is_open;
}

QueryStatus Both::create_deformable(std::size_t size) {
    c_memory_.assign(size + 1, std::byte{0});
    memory_ = c_memory_;
    const espalier_query_status status =
        c99_create_deformable(&c->blob[0], c_memory_.data() + 1, size, &c->deformable[0]);
    put(cpp->deformable[0], espalier::create_deformable(blob(), std::span(memory_).subspan(1)));
    REQUIRE(status == static_cast<espalier_query_status>(mesh().status()));
    REQUIRE(are_memories_equal());
    c->blob[1] = c->blob[0];
    cpp->blob[1] = cpp->blob[0];
    c->blob[0] = *c99_deformable_blob(&c->deformable[0]);  // stays valid
    put(cpp->blob[0], mesh().blob());
    return mesh().status();
}

bool Both::are_memories_equal() const {
    if (!is_moving_) return c_memory_ == memory_;
    std::size_t size = 0;
    const void* const block = c99_moving_scene_block(&c->moving_scene[0], &size);
    const std::span<const std::byte> bytes = to<MovingScene>(&cpp->moving_scene[0]).bytes();
    return std::ranges::equal(std::span(static_cast<const std::byte*>(block), size), bytes);
}

void Both::prepare(const question& asked, bool any_bits, bool nothing) {
    const Lattice region = region_of(scene(), moving(), blob());
    Random random(asked.bits);
    for (Pool* const pool : {c.get(), cpp.get()}) {
        pool->nothing = nothing;
        pool->fill(asked, region);
        if (any_bits) pool->spoil(random);
    }
}

void Both::compare(const Entry& entry) {
    const std::string name = entry.name;
    CAPTURE(name);
    c->start_page();
    cpp->start_page();
    for (int page = 0; page < (entry.has_pages ? 2 : 1); ++page) {
        c->log.words.clear();
        cpp->log.words.clear();
        entry.c(*c);
        entry.cpp(*cpp);
        if (c->status == ESPALIER_QUERY_OK) answered.insert(entry.name);
        REQUIRE(c->log.words.size() == cpp->log.words.size());
        const auto word = std::mismatch(c->log.words.begin(), c->log.words.end(), cpp->log.words.begin()).first;
        REQUIRE(word == c->log.words.end());
    }
}

void Both::compare(Takes takes, const question& asked, bool any_bits) {
    for (const bool nothing : {false, true}) {
        prepare(asked, any_bits, nothing);
        for (const Entry& entry : entries)
            if (entry.takes == takes) compare(entry);
    }
}

void Both::change(const question& asked, Random& random) {
    std::vector<const Entry*> changes;
    for (const Entry& entry : entries)
        if (entry.takes == Takes::changes)
            changes.insert(changes.end(), std::strcmp(entry.name, "moving_scene_insert") == 0 ? 4 : 1, &entry);
    for (int i = 0; i < 12; ++i) {
        question other = asked;
        other.bits = static_cast<std::uint32_t>(random.next());
        prepare(other, false, random.below(16) == 0);
        compare(*changes[random.below(static_cast<std::uint32_t>(changes.size()))]);
    }
    if (random.below(8) != 0) {
        const std::uint32_t refitted = espalier::refit(moving());
        REQUIRE(c99_moving_scene_refit(&c->moving_scene[0]) == refitted);
    }
    REQUIRE(are_memories_equal());
}

/// Compares the queries of a view too.
void Both::compare_moving(const question& asked, Random& random, bool any_bits) {
    change(asked, random);
    const espalier_query_status status = c99_moving_scene_view(&c->moving_scene[0], &c->scene[1]);
    REQUIRE(c99_moving_scene_is_open(&c->moving_scene[0]) == static_cast<bool>(moving()));
    REQUIRE(status == (!moving()               ? ESPALIER_QUERY_NOT_OPEN
                       : moving().must_refit() ? ESPALIER_QUERY_NOT_REFITTED
                                               : ESPALIER_QUERY_OK));
    REQUIRE((c99_scene_status(&c->scene[1]) == ESPALIER_OPEN_OK) == (status == ESPALIER_QUERY_OK));
    compare(Takes::moving, asked, any_bits);
    REQUIRE(are_memories_equal());
}

void Both::refit(std::span<const Vec3> positions, const question& asked) {
    for (Pool* const pool : {c.get(), cpp.get()}) {
        pool->positions = reinterpret_cast<const espalier_vec3*>(positions.data());
        pool->position_count = positions.size();
        const std::size_t sizes[] = {asked.bits % 50, blob().size() - 1, blob().size() + 1, blob().size()};
        pool->room.assign(blob() ? sizes[std::min(asked.bits % 8, 3u)] : 1, std::byte{0x5A});
    }
    compare(Takes::deformable, asked);
    REQUIRE(c->room == cpp->room);
    REQUIRE(are_memories_equal());
}

}  // namespace espalier::tests
