#include "c/expecting.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/scenes/statistics.hpp>

namespace espalier::tests {

Transform Expecting::some_transform(int i) const {
    const auto rotation = asked_.rotation;
    return {{rotation[0], rotation[1], rotation[2], rotation[3]},
            point(i),
            asked_.bits % 5 == 0 ? length(i) : 0.5f + static_cast<float>(asked_.bits % 8) / 8.0f};
}

void Expecting::tell(const Result<InstanceHandle>& handle) {
    tell(handle.status);
    tell(handle->slot);
    tell(handle->generation);
}

InstanceHandle Expecting::some_handle(std::uint32_t bits) {
    const Result<InstanceHandle> handle = handle_of(moving_, bits % (moving_.slot_end() + 1));
    tell(handle);
    return *handle;
}

void Expecting::changes() {
    const std::uint32_t bits = asked_.bits;
    for (int i = 0; i < 4; ++i) tell(insert(moving_, {some_transform(i), (bits >> i) % 7, bits >> 8, bits, 9}));
    const InstanceHandle any = {bits % 50, bits >> 30};
    tell(remove(moving_, any));
    tell(remove(moving_, some_handle(bits >> 3)));
    if (bits % 16 == 1) tell(remove(moving_, some_handle(bits >> 5)));
    tell(move(moving_, any, some_transform(3)));
    tell(move(moving_, some_handle(bits >> 7), some_transform(3)));
    tell(set_mask(moving_, some_handle(bits >> 9), bits));
    tell(set_user(moving_, some_handle(bits >> 10), bits));

    std::array<Movement, 4> movements;
    for (std::uint32_t i = 0; i < 4; ++i) movements[i] = {some_handle(bits >> i), some_transform(static_cast<int>(i))};
    tell(move(moving_, movements));
    tell(move_instances_of(moving_, (bits >> 4) % 7));
    tell(move_instances_of(moving_, bits));
    tell(moving_.must_refit());
    if (bits % 8 != 0) tell(refit(moving_));
    if (bits % 16 == 3) repack(moving_);
    tell(quality(moving_));
    if (bits % 3 == 0) end_step(moving_);
}

void Expecting::about_instance(InstanceHandle handle) {
    const Result<Box> box = box_of(moving_, handle);
    tell(instance_at(moving_, handle));
    tell(box.status);
    tell(box->min);
    tell(box->max);
}

void Expecting::moving_scene_itself() {
    const std::uint32_t bits = asked_.bits;
    tell(static_cast<bool>(moving_));
    tell(moving_.instance_count());
    tell(moving_.capacity());
    tell(moving_.slot_end());
    tell(static_cast<std::uint32_t>(moving_.step_exponent()));
    tell(moving_.must_refit());
    const std::span<const std::byte> block = moving_.bytes();
    tell(std::uint64_t{block.size()});
    for (std::size_t i = 0; i < block.size(); i += 97) tell(std::to_integer<std::uint32_t>(block[i]));
    tell(std::uint64_t{moving_.meshes().size()});
    for (const Blob& mesh : moving_.meshes()) tell(mesh.checksum());
    tell(std::uint64_t{moving_.tiles().size()});
    for (const BakedScene& tile : moving_.tiles()) tell(tile.size());
    for (unsigned shift = 0; shift < 32; shift += 8) {
        tell(moving_scene_bytes(bits >> shift));
        tell(least_moving_scene_bytes(bits >> shift) >> 4);
    }
    tell(handle_of(moving_, bits));
    about_instance(some_handle(bits >> 2));
    about_instance({bits % 50, bits >> 30});
    for (std::uint32_t slot = 0; slot < 50; ++slot) {
        tell(instance_at(moving_, InstanceId{slot, bits >> 29}));
        tell(instance_at(moving_, InstanceId{slot}));
    }
}

void Expecting::moving_scenes() {
    moving_scene_itself();
    tell(!moving_ ? QueryStatus::not_open : moving_.must_refit() ? QueryStatus::not_refitted : QueryStatus::ok);
    tell(moving_ && !moving_.must_refit() ? OpenStatus::ok : OpenStatus::not_opened);
    queries_of(moving_);
}

void Expecting::tell(const InstancePair& pair) {
    tell(pair.a);
    tell(pair.b);
}

void Expecting::tell(const BakedPair& pair) {
    tell(pair.moving);
    tell(pair.baked);
}

template <class Pair, std::size_t size>
void Expecting::tell(const FilledPairs<Pair>& page, const std::array<Pair, size>& pairs) {
    tell(std::uint64_t{page.count});
    tell(page.next);
    tell(page.status);
    for (const Pair& pair : page.in(pairs)) tell(pair);
}

void Expecting::pages(const PairFilter& filter) {
    const std::uint32_t bits = asked_.bits;
    const InstancePair any = {bits, bits};
    std::array<InstancePair, 7> pairs;
    const auto show = [&](const FilledPairs<InstancePair>& page) {
        tell(page, pairs);
        return page.next;
    };
    InstancePair from;
    for (int page = 0; page < 3; ++page) from = show(collect_candidate_pairs(moving_, pairs, filter, from));
    show(collect_candidate_pairs(moving_, pairs, filter, {bits % 40, bits >> 8}));
    show(collect_candidate_pairs(moving_, pairs, filter, any));
    from = {};
    for (int page = 0; page < 3; ++page)
        from = show(collect_colliding_pairs(moving_, pairs, WorkLimit::unlimited(), filter, from));
    show(collect_colliding_pairs(moving_, pairs, WorkLimit(bits % 900), filter));
    show(collect_colliding_pairs(moving_, pairs, WorkLimit(bits % 900), filter, any));
    SceneCounters walk;
    PairCounters triangles;
    show(collect_candidate_pairs(moving_, pairs, walk, filter, {bits % 40, bits >> 8}));
    show(collect_colliding_pairs(moving_, pairs, WorkLimit(bits % 900), walk, triangles, filter));
    tell(static_cast<std::uint32_t>(walk.box_tests));
    tell(static_cast<std::uint32_t>(walk.pairs));
    tell(static_cast<std::uint32_t>(triangles.box_pairs));
}

void Expecting::pages_with_baked(const PairFilter& filter) {
    const std::uint32_t bits = asked_.bits;
    const BakedPair any = {bits % 40, {bits >> 8, bits}};
    std::array<BakedPair, 7> pairs;
    const auto show = [&](const FilledPairs<BakedPair>& page) {
        tell(page, pairs);
        return page.next;
    };
    BakedPair from;
    for (int page = 0; page < 3; ++page) from = show(collect_candidate_pairs(moving_, scene_, pairs, filter, from));
    show(collect_candidate_pairs(moving_, scene_, pairs, filter, any));
    from = {};
    for (int page = 0; page < 3; ++page)
        from = show(collect_colliding_pairs(moving_, scene_, pairs, WorkLimit::unlimited(), filter, from));
    show(collect_colliding_pairs(moving_, scene_, pairs, WorkLimit(bits % 900), filter, any));
}

void Expecting::scene_pairs() {
    const auto keeps = [&](InstanceId a, InstanceId b) {
        return (2 * a.index + a.in_tile + b.index + b.in_tile + asked_.bits) % 3 != 0;
    };
    const PairFilter all, moved = {.only_moved = asked_.bits % 2 != 0}, kept = {asked_.bits % 4 < 2, keeps};
    for (const PairFilter* filter : {&all, &moved, &kept}) {
        pages(*filter);
        pages_with_baked(*filter);
    }
}

}  // namespace espalier::tests
