// A moving scene: changes, the bytes after them, queries and pairs.
#include <espalier/scenes/pairs.hpp>

#include "scene_queries.hpp"
#include "support/machine/aligned_buffer.hpp"

namespace espalier::answers {

namespace {

constexpr std::uint32_t capacity = 40;

/// Changes of a scene, at the places of questions.
class Changes {
public:
    Changes(MovingScene& scene, const Questions& questions) : scene_(scene), questions_(questions) {}

    void make(std::span<Blob> meshes) {
        insert_some(80, 60);
        move_some(15, 20);
        for (const std::size_t i : {10u, 11u, 12u, 13u, 14u, 10u}) words_.add(remove(scene_, handles_[i]));
        for (std::uint32_t i = 14; i < 22; ++i)
            words_.add(set_mask(scene_, handles_[i], 6), set_user(scene_, handles_[i], 1000 + i));
        repack(scene_);
        end_step(scene_);
        insert_some(150, 6);
        move_some(170, 4);
        meshes[1] = meshes[0];
        words_.add(move_instances_of(scene_, 1));
        repack(scene_);  // as after another lattice
        words_.add(scene_.instance_count(), scene_.capacity(), scene_.slot_end(), scene_.step_exponent(),
                   quality(scene_));
        for (std::uint32_t slot = 0; slot < scene_.slot_end(); ++slot) {
            add(handle_of(scene_, slot));
            if (const auto instance = instance_at(scene_, InstanceId{slot})) words_.add(*instance);
        }
    }

private:
    void add(const Result<InstanceHandle>& handle) {
        words_.add(handle.value.slot, handle.value.generation, handle.status);
    }
    /// Inserts mostly both blobs in turn, and in each ten the tile and a mesh that does not exist.
    void insert_some(std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t mesh = i % 10 < 8 ? i % 2 : i % 10 - 6;
            const auto inserted =
                insert(scene_, {questions_.place(first + i), mesh, 1 + i % 3, 7 * i, no_instance.index});
            add(inserted);
            handles_.push_back(inserted.value);
        }
    }
    /// Moves instances in a batch, which goes on behind those that are refused.
    void move_some(std::uint32_t first, std::size_t count) {
        std::vector<Movement> movements;
        for (std::size_t i = 0; i < count; ++i) movements.push_back({handles_[i], questions_.place(first + i)});
        std::vector<QueryStatus> statuses(count, QueryStatus::ok);
        for (std::size_t begin = 0; begin < count;) {
            const Filled moved = move(scene_, std::span(movements).subspan(begin));
            begin += moved.count;
            if (moved.status != QueryStatus::ok) statuses[begin++] = moved.status;
        }
        refit(scene_);
        for (const QueryStatus status : statuses) words_.add(status);
    }

    MovingScene& scene_;
    const Questions& questions_;
    std::vector<InstanceHandle> handles_;
    Words& words_ = words["moving_changes"];
};

void add_pair(Words& list, const InstancePair& pair) { list.add(pair.a, pair.b); }
void add_pair(Words& list, const BakedPair& pair) { list.add(pair.moving, pair.baked); }

/// Adds all pairs that collect(array) writes, where to go on, and why they end.
template <class Pair, class Collect>
void answer_pairs_of(const char* name, const Collect& collect) {
    Words& list = words[name];
    std::vector<Pair> pairs(100'000);
    const FilledPairs<Pair> filled = collect(std::span(pairs));
    for (const Pair& pair : filled.in(pairs)) add_pair(list, pair);
    add_pair(list, filled.next);
    list.add(filled.status);
}

void answer_all_pairs(MovingScene& scene, const BakedScene& baked) {
    constexpr auto unlimited = WorkLimit::unlimited();
    constexpr WorkLimit limit(300);
    PairFilter moved;
    moved.only_moved = true;
    answer_pairs_of<InstancePair>("moving_candidates", [&](auto pairs) {
        return collect_candidate_pairs(scene, pairs, {}, InstancePair{1, 5});
    });
    answer_pairs_of<InstancePair>("moving_moved",
                                  [&](auto pairs) { return collect_candidate_pairs(scene, pairs, moved); });
    answer_pairs_of<InstancePair>("moving_collisions",
                                  [&](auto pairs) { return collect_colliding_pairs(scene, pairs, unlimited); });
    answer_pairs_of<InstancePair>("moving_collisions_limited",
                                  [&](auto pairs) { return collect_colliding_pairs(scene, pairs, limit); });
    answer_pairs_of<BakedPair>("moving_candidates_with_baked", [&](auto pairs) {
        return collect_candidate_pairs(scene, baked, pairs, {}, BakedPair{2, {3, 0}});
    });
    answer_pairs_of<BakedPair>("moving_collisions_with_baked", [&](auto pairs) {
        return collect_colliding_pairs(scene, baked, pairs, unlimited, moved);
    });
    answer_pairs_of<BakedPair>("moving_collisions_with_baked_limited",
                               [&](auto pairs) { return collect_colliding_pairs(scene, baked, pairs, limit); });
}

}  // namespace

std::vector<std::byte> answer_moving(const Blob& blob, const Blob& coarse, const BakedScene& tile,
                                     const Questions& questions) {
    Blob meshes[] = {blob, coarse};
    const BakedScene tiles[] = {tile};
    tests::AlignedBuffer block(static_cast<std::size_t>(moving_scene_bytes(capacity)));
    MovingScene scene = create_moving_scene(block.bytes(), capacity, -8, meshes, tiles);
    Changes(scene, questions).make(meshes);
    std::vector<std::byte> bytes(scene.bytes().begin(), scene.bytes().end());
    answer_both(std::as_const(scene), questions, "moving_");
    answer_all_pairs(scene, tile);
    return bytes;
}

}  // namespace espalier::answers
