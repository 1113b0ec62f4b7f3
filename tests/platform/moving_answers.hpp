// A script of calls on a moving scene, the same on every machine: insertions, removals, moves and queries, and a hash
// of every answer and of the block.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

#include "answer_counts.hpp"
#include "numbers.hpp"

namespace espalier::platform {

/// What the instances of a script place, and a baked scene in the same world, which may be one that is not open.
struct MovingParts {
    std::span<const Blob> meshes;
    std::span<const BakedScene> tiles;
    BakedScene baked;
};

/// Adds the words of a block as numbers, so that the hash is the same for both byte orders.
inline void add_block(Fingerprint& fingerprint, std::span<const std::byte> block) {
    const auto* const head = static_cast<const detail::BlockHead*>(static_cast<const void*>(block.data()));
    constexpr std::size_t small_fields = offsetof(detail::BlockHead, step_exponent);  // four of a byte each
    const std::size_t words = block.size() - head->node_capacity;                     // marks of nodes are bytes
    for (std::size_t at = 0; at < words; at += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, block.data() + at, sizeof word);
        if (at != small_fields) fingerprint.add(word);
    }
    fingerprint.add(block.subspan(small_fields, 4), block.subspan(words));
}

/// A moving scene, and numbers that choose what is called.
class MovingScript : Numbers {
public:
    MovingScript(const MovingParts& parts, std::span<std::byte> memory, std::uint32_t capacity, Answers& answers,
                 Fingerprint& blocks)
        : parts_(parts),
          scene_(create_moving_scene(memory, capacity, -10, parts.meshes, parts.tiles)),
          memory_(memory),
          answers_(answers),
          blocks_(blocks) {
        hash_.add(static_cast<bool>(scene_));
    }

    void run(std::uint32_t calls) {
        constexpr std::uint32_t round = 4096;
        for (std::uint32_t number = 1; number <= calls; ++number) {
            // Instances become more in one round and fewer in the next.
            call(word() >> 8 & 63u, number / round % 2 == 0);
            if (number % round == 0 || number == calls) end_round();
        }
        answers_.calls += calls;
    }

private:
    Vec3 in_cube(float half_side) {
        const float x = signed_fraction() * half_side, y = signed_fraction() * half_side;
        return {x, y, signed_fraction() * half_side};
    }
    Transform place() {
        if (word() % 64 == 0) return any_bits();
        Transform transform;
        const Vec3 axis = in_cube(1.0f);
        if (word() % 4 != 0) transform.rotation = {axis.x, axis.y, axis.z, 1.25f};
        transform.translation = in_cube(48.0f);
        transform.scale = 0.75f + 0.5f * signed_fraction();
        return transform;
    }
    Transform any_bits() {
        float numbers[8];
        for (float& number : numbers) number = std::bit_cast<float>(word());
        return {{numbers[0], numbers[1], numbers[2], numbers[3]}, {numbers[4], numbers[5], numbers[6]}, numbers[7]};
    }
    /// Returns the handle of a live slot, a free one or none.
    InstanceHandle any_handle() {
        const std::uint32_t slot = word() % (scene_.slot_end() + 1);
        const Result<InstanceHandle> handle = handle_of(scene_, slot);
        add(handle.status);
        return handle ? *handle : InstanceHandle{slot, 2};
    }

    void add(QueryStatus status) { hash_.add(static_cast<std::uint32_t>(status)); }
    void add(InstanceId instance) { hash_.add(instance.index, instance.in_tile); }

    void call(std::uint32_t kind, bool is_growing) {
        if (kind < (is_growing ? 16u : 10u)) return insert_one();
        if (kind < 26) return add(remove(scene_, any_handle()));
        if (kind < 48) return move_one();
        if (kind < 50) return move_some();
        if (kind < 58) return ask_ray();
        if (kind < 60) return ask_shapes();
        if (kind == 60) return hash_.add(refit(scene_));
        if (kind == 61) return set_words();
        if (kind == 62) return end_or_repack();
        return collect_pairs();
    }
    void insert_one() {
        Instance instance;
        instance.transform = place();
        instance.mesh = word() % (static_cast<std::uint32_t>(parts_.meshes.size() + parts_.tiles.size()) + 1);
        instance.mask = word() | 1u << word() % 32;
        instance.user = word();
        const Result<InstanceHandle> handle = insert(scene_, instance);
        add(handle.status);
        hash_.add(handle->slot, handle->generation);
    }
    void move_one() {
        const InstanceHandle handle = any_handle();
        add(move(scene_, handle, place()));
    }
    void move_some() {
        Movement movements[6];
        for (Movement& movement : movements) {
            movement.instance = any_handle();
            movement.transform = place();
        }
        const Filled moved = move(scene_, movements);
        add(moved.status);
        hash_.add(static_cast<std::uint32_t>(moved.count));
        if (word() % 16 != 0) hash_.add(refit(scene_));  // else the queries that follow are refused
    }
    void set_words() {
        const InstanceHandle handle = any_handle();
        add(set_mask(scene_, handle, word()));
        add(set_user(scene_, handle, word()));
        const Result<Box> box = box_of(scene_, handle);
        hash_.add(box->min, box->max);
    }
    void end_or_repack() {
        const std::uint32_t kind = word() % 64;
        if (kind == 0) repack(scene_);
        else if (kind < 16) see_from_elsewhere();
        else end_step(scene_);
    }
    /// Goes on in a view from another place: near, so that most instances are in sight, or anywhere in the world.
    void see_from_elsewhere() {
        const Vec3 place = in_cube(word() % 4 == 0 ? 0x1p21f : 16.0f);
        const MovingScene view = seen_from(scene_, {place.x, place.y, place.z});
        hash_.add(static_cast<bool>(view));
        const Vec3d origin = view.origin();
        for (const double coordinate : {origin.x, origin.y, origin.z}) {
            const auto bits = std::bit_cast<std::uint64_t>(coordinate);
            hash_.add(static_cast<std::uint32_t>(bits >> 32), static_cast<std::uint32_t>(bits));
        }
        if (view) scene_ = view;
    }

    void ask_ray() {
        const Ray ray = {in_cube(64.0f), in_cube(64.0f)};
        const std::uint32_t mask = word();
        const InScene<RayHit> hit = raycast(scene_, ray, mask);
        answers_.rays += 1;
        answers_.rays_hit += hit ? 1u : 0u;
        add(hit->status);
        add(hit.instance);
        hash_.add(hit->triangle.index, hit->t, hit->normal);
        hash_.add(occluded(scene_, ray).yes());
    }
    void ask_shapes() {
        const Vec3 point = in_cube(64.0f);
        const InScene<ClosestPoint> nearest = closest_point(scene_, point, 8.0f);
        answers_.points += 1;
        answers_.points_found += nearest ? 1u : 0u;
        add(nearest->status);
        add(nearest.instance);
        hash_.add(nearest->point);
        const Vec3 way = in_cube(16.0f);
        const Box box = {point, {point.x + 1.0f, point.y + 0.5f, point.z + 0.75f}};
        for (const InScene<SweepHit>& contact :
             {sweep(scene_, Sphere{point, 0.5f}, way), sweep(scene_, box, way, SceneSweepOptions{.skin = 0.25f})}) {
            add(contact->status);
            add(contact.instance);
            hash_.add(contact->t);
        }
        answers_.spheres += 1;
        const QueryStatus status = for_each_overlap(scene_, Sphere{point, 2.0f}, [&](InstanceId instance, TriangleId) {
            answers_.overlaps += 1;
            add(instance);
        });
        add(status);
    }

    void collect_pairs() {
        const std::uint32_t kind = word() % 4, slots = scene_.slot_end() + 1;
        const auto keep = [](InstanceId a, InstanceId b) { return (a.index + b.index + b.in_tile) % 3 != 0; };
        PairFilter filter;
        filter.only_moved = word() % 2 == 0;
        if (word() % 4 == 0) filter.keep = keep;
        const std::uint32_t from = word() % slots;
        const WorkLimit limit(2'000);
        InstancePair page[48];
        BakedPair baked[24];
        if (kind == 0) add(collect_candidate_pairs(scene_, page, filter, {from, 0}), page);
        if (kind == 1) add(collect_colliding_pairs(scene_, page, limit, filter, {from, 0}), page);
        if (kind == 2) add(collect_candidate_pairs(scene_, parts_.baked, baked, filter, {from, {0, 0}}), baked);
        if (kind == 3) add(collect_colliding_pairs(scene_, parts_.baked, baked, limit, filter, {from, {0, 0}}), baked);
    }
    template <class Pair, std::size_t size>
    void add(const FilledPairs<Pair>& found, Pair (&page)[size]) {
        add(found.status);
        for (const Pair& pair : found.in(page)) add(pair);
        add(found.next);
        answers_.pairs_near += static_cast<std::uint32_t>(found.count);
    }
    void add(const InstancePair& pair) { hash_.add(pair.a, pair.b); }
    void add(const BakedPair& pair) {
        hash_.add(pair.moving);
        add(pair.baked);
    }

    /// Continues with the scene as a snapshot of it opens.
    void end_round() {
        hash_.add(quality(scene_), scene_.instance_count());
        add_block(blocks_, scene_.bytes());
        scene_ = open_moving_scene(memory_, parts_.meshes, parts_.tiles);
        hash_.add(static_cast<bool>(scene_));
    }

    const MovingParts& parts_;
    MovingScene scene_;
    std::span<std::byte> memory_;
    Answers& answers_;
    Fingerprint& hash_ = answers_.fingerprint;
    Fingerprint& blocks_;
};

/// Runs calls on a moving scene of one mesh that fits into the memory of a microcontroller.
inline Answers ask_moving(const Blob& mesh, std::uint32_t calls) {
    constexpr std::uint32_t capacity = 24;
    alignas(32) std::byte memory[3'616] = {};
    const std::uint64_t bytes = least_moving_scene_bytes(capacity);
    Answers answers;
    Fingerprint blocks;
    const MovingParts parts = {{&mesh, 1}, {}, {}};
    MovingScript script(parts, std::span(memory).first(static_cast<std::size_t>(bytes)), capacity, answers, blocks);
    script.run(calls);
    answers.fingerprint.add(blocks);
    return answers;
}

}  // namespace espalier::platform
