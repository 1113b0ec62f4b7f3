// A moving scene: changes, the bytes after them, queries and pairs.
#include <new>

#include <espalier/scenes/pairs.hpp>

#include "scene_queries.hpp"

namespace {

constexpr std::uint32_t capacity = 40;

/// A block that is aligned as the library wants it.
class Block {
public:
    explicit Block(std::size_t size) : bytes_(static_cast<std::byte*>(::operator new(size, alignment))), size_(size) {}
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;
    ~Block() { ::operator delete(bytes_, alignment); }
    [[nodiscard]] std::span<std::byte> bytes() const { return {bytes_, size_}; }

private:
    static constexpr std::align_val_t alignment{32};
    std::byte* bytes_;
    std::size_t size_;
};

using Handles = std::vector<espalier::InstanceHandle>;

/// Returns what an instance is of: mostly both blobs in turn, and in each ten the tile and a mesh that does not exist.
constexpr std::uint32_t mesh_of(std::uint32_t i) { return i % 10 < 8 ? i % 2 : i % 10 - 6; }

/// Inserts instances at the places of some questions.
void insert_some(espalier::MovingScene& scene, const Questions& questions, std::uint32_t first, std::uint32_t count,
                 Handles& handles, Words& words) {
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto inserted = espalier::insert(
            scene, {questions.place(first + i), mesh_of(i), 1 + i % 3, 7 * i, espalier::no_instance.index});
        words.add(inserted.value.slot, inserted.value.generation, inserted.status);
        handles.push_back(inserted.value);
    }
}

/// Moves instances in a batch, which goes on behind those that are refused.
void move_some(espalier::MovingScene& scene, const Questions& questions, std::uint32_t first, const Handles& handles,
               std::size_t count, Words& words) {
    std::vector<espalier::Movement> movements;
    for (std::size_t i = 0; i < count; ++i) movements.push_back({handles[i], questions.place(first + i)});
    std::vector<espalier::QueryStatus> statuses(count, espalier::QueryStatus::ok);
    for (std::size_t begin = 0; begin < count;) {
        const espalier::Filled moved = espalier::move(scene, std::span(movements).subspan(begin));
        begin += moved.count;
        if (moved.status != espalier::QueryStatus::ok) statuses[begin++] = moved.status;
    }
    espalier::refit(scene);
    for (const espalier::QueryStatus status : statuses) words.add(status);
}

void change(espalier::MovingScene& scene, std::span<espalier::Blob> meshes, const Questions& questions) {
    Words words("moving_changes");
    Handles handles;
    insert_some(scene, questions, 80, 60, handles, words);
    move_some(scene, questions, 15, handles, 20, words);
    for (const std::size_t i : {10u, 11u, 12u, 13u, 14u, 10u}) words.add(espalier::remove(scene, handles[i]));
    for (std::uint32_t i = 14; i < 22; ++i) {
        words.add(espalier::set_mask(scene, handles[i], 6));
        words.add(espalier::set_user(scene, handles[i], 1000 + i));
    }
    espalier::repack(scene);
    espalier::end_step(scene);
    insert_some(scene, questions, 150, 6, handles, words);
    move_some(scene, questions, 170, handles, 4, words);
    meshes[1] = meshes[0];
    words.add(espalier::move_instances_of(scene, 1));
    espalier::repack(scene);  // as after another lattice
    words.add(scene.instance_count(), scene.capacity(), scene.slot_end(), scene.step_exponent(),
              espalier::quality(scene));
    for (std::uint32_t slot = 0; slot < scene.slot_end(); ++slot) {
        const auto handle = espalier::handle_of(scene, slot);
        words.add(handle.value.slot, handle.value.generation, handle.status);
        const auto instance = espalier::instance_at(scene, espalier::InstanceId{slot});
        if (instance) add(words, *instance);
    }
}

void add_pair(Words& words, const espalier::InstancePair& pair) { words.add(pair.a, pair.b); }
void add_pair(Words& words, const espalier::BakedPair& pair) { words.add(pair.moving, pair.baked); }

/// Adds all pairs that collect(array) writes, where to go on, and why they end.
template <class Pair, class Collect>
void answer_pairs(const char* name, const Collect& collect) {
    Words words(name);
    std::vector<Pair> pairs(100'000);
    const espalier::FilledPairs<Pair> filled = collect(std::span(pairs));
    for (std::size_t i = 0; i < filled.count; ++i) add_pair(words, pairs[i]);
    add_pair(words, filled.next);
    words.add(filled.status);
}

void answer_all_pairs(espalier::MovingScene& scene, const espalier::BakedScene& baked) {
    using espalier::BakedPair;
    using espalier::InstancePair;
    constexpr auto unlimited = espalier::WorkLimit::unlimited();
    constexpr espalier::WorkLimit limit(300);
    espalier::PairFilter moved;
    moved.only_moved = true;
    answer_pairs<InstancePair>("moving_candidates", [&](auto pairs) {
        return espalier::collect_candidate_pairs(scene, pairs, {}, InstancePair{1, 5});
    });
    answer_pairs<InstancePair>("moving_moved",
                               [&](auto pairs) { return espalier::collect_candidate_pairs(scene, pairs, moved); });
    answer_pairs<InstancePair>("moving_collisions",
                               [&](auto pairs) { return espalier::collect_colliding_pairs(scene, pairs, unlimited); });
    answer_pairs<InstancePair>("moving_collisions_limited",
                               [&](auto pairs) { return espalier::collect_colliding_pairs(scene, pairs, limit); });
    answer_pairs<BakedPair>("moving_candidates_with_baked", [&](auto pairs) {
        return espalier::collect_candidate_pairs(scene, baked, pairs, {}, BakedPair{2, {3, 0}});
    });
    answer_pairs<BakedPair>("moving_collisions_with_baked", [&](auto pairs) {
        return espalier::collect_colliding_pairs(scene, baked, pairs, unlimited, moved);
    });
    answer_pairs<BakedPair>("moving_collisions_with_baked_limited",
                            [&](auto pairs) { return espalier::collect_colliding_pairs(scene, baked, pairs, limit); });
}

}  // namespace

void answer_moving(const espalier::Blob& blob, const espalier::Blob& coarse, const espalier::BakedScene& tile,
                   const Questions& questions) {
    espalier::Blob meshes[] = {blob, coarse};
    const espalier::BakedScene tiles[] = {tile};
    const Block block(espalier::moving_scene_bytes(capacity));
    espalier::MovingScene scene = espalier::create_moving_scene(block.bytes(), capacity, -8, meshes, tiles);
    change(scene, meshes, questions);
    write_file("moving_scene", scene.bytes().data(), scene.bytes().size());
    SceneAnswers(std::as_const(scene), questions, "moving_", false).write();
    SceneAnswers(std::as_const(scene), questions, "filtered_moving_", true).write();
    answer_all_pairs(scene, tile);
}
