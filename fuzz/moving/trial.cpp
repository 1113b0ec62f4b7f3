#include "trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "judge.hpp"
#include "scene_questions.hpp"
#include "world.hpp"

namespace espalier::fuzz {

using tests::Random;

Trial::Trial(std::uint32_t capacity, int step_exponent, std::size_t bytes)
    : memory_(bytes),
      scene_(create_moving_scene(memory_.bytes(), capacity, step_exponent, world().meshes(), world().tiles())),
      model_(capacity) {}

Trial::Trial(std::span<const std::byte> snapshot)
    : memory_(snapshot),
      scene_(open_moving_scene(memory_.bytes(), world().meshes(), world().tiles())),
      model_(scene_) {}

float Trial::unit() const { return std::ldexp(1.0f, scene_.step_exponent() + 12); }

Transform Trial::any_transform(Random& random) const {
    const std::uint32_t kind = random.below(16);
    Transform transform;
    if (kind == 0)
        return {{any_number(random), any_number(random), any_number(random), any_number(random)},
                any_bits(random),
                any_number(random)};
    if (kind < 10) transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.5f};
    // Neighbours on a grid touch in their sides; others lie anywhere, some of them near the end of the world.
    const auto on_grid = [&] { return static_cast<float>(random.between(-3, 3)) * unit(); };
    transform.scale = unit();
    if (kind >= 13) {
        const float x = on_grid(), y = on_grid(), z = on_grid();
        transform.translation = {x, y, z};
    } else {
        transform.translation = random.in_cube(kind == 1 ? std::ldexp(unit(), 18) : 4.0f * unit());
        transform.scale =
            std::ldexp(unit() * (1.0f + random.unit()), random.between(kind == 2 ? -30 : -3, kind == 3 ? 15 : 1));
    }
    if (kind != 12) return transform;
    constexpr float hostile[] = {0.0f, -0.0f, -1.0f, 0x1p-149f, 0x1p-101f, 0x1p127f, infinity, __builtin_nanf("")};
    float* const fields[] = {&transform.rotation.x,    &transform.rotation.w,    &transform.translation.x,
                             &transform.translation.z, &transform.translation.y, &transform.scale};
    *fields[random.below(6)] = hostile[random.below(static_cast<std::uint32_t>(std::size(hostile)))];
    return transform;
}

InstanceHandle Trial::any_handle(Random& random) const {
    const std::uint32_t kind = random.below(16);
    const auto word = [&] { return static_cast<std::uint32_t>(random.next() >> 32); };
    if (kind == 0) return {random.coin() ? random.below(scene_.slot_end() + 2) : word(), random.below(4)};
    if (kind == 1) return {word(), word()};
    if (kind == 2 && !model_.stale().empty())
        return model_.stale()[random.below(static_cast<std::uint32_t>(model_.stale().size()))];
    if (model_.live().empty()) return {};
    const auto number = random.below(static_cast<std::uint32_t>(model_.live().size()));
    return model_.handle_of(std::next(model_.live().begin(), number)->first);
}

void Trial::require_unchanged() {
    require(std::ranges::equal(scene_.bytes(), before_), "a refusal has changed the block");
}

bool Trial::is_taken(InstanceHandle handle, QueryStatus status) {
    if (model_.is_live(handle)) return true;
    require(status == QueryStatus::stale_handle, "a stale handle is not refused as one");
    require_unchanged();
    return false;
}

void Trial::insert_any(Random& random) {
    Instance instance;
    instance.mesh = random.below(3);
    if (random.below(4) == 0) instance.mesh = random.coin() ? 4 : random.below(9);
    instance.mask = random.below(4) == 0 ? random.below(16) : 0xFFFFFFFF;
    instance.user = random.below(1000);
    instance.transform = any_transform(random);
    const Result<InstanceHandle> handle = insert(scene_, instance);
    model_.inserted(instance, scene_.step_exponent(), handle);
    if (handle) check_box(scene_, *handle);
    else require_unchanged();
}

void Trial::remove_any(Random& random) {
    const InstanceHandle handle = any_handle(random);
    const QueryStatus status = remove(scene_, handle);
    if (!is_taken(handle, status)) return;
    require(status == QueryStatus::ok, "a live instance is not removed");
    model_.removed(handle);
}

void Trial::move_any(Random& random) {
    const InstanceHandle handle = any_handle(random);
    const Transform transform = any_transform(random);
    const QueryStatus status = move(scene_, handle, transform);
    if (!is_taken(handle, status)) return;
    const std::uint32_t mesh = model_.live().at(handle.slot).mesh;
    check_status(fate_of(mesh, transform, scene_.step_exponent()), status, QueryStatus::ok);
    if (status != QueryStatus::ok) return require_unchanged();
    model_.moved(handle, transform, false);
    check_box(scene_, handle);
}

void Trial::move_some(Random& random) {
    std::vector<Movement> movements(random.below(12));
    for (Movement& movement : movements) {
        movement.instance = any_handle(random);
        movement.transform = any_transform(random);
    }
    const Filled moved = move(scene_, movements);
    require(moved.count <= movements.size(), "a batch has moved more than it was given");
    for (std::size_t i = 0; i < moved.count; ++i) {
        const auto& [handle, transform] = movements[i];
        require(model_.is_live(handle), "a batch has moved an instance that is not alive");
        const std::uint32_t mesh = model_.live().at(handle.slot).mesh;
        check_status(fate_of(mesh, transform, scene_.step_exponent()), QueryStatus::ok, QueryStatus::ok);
        model_.moved(handle, transform, true);
        if (model_.live().at(handle.slot).transform == instance_at(scene_, handle)->transform)
            check_box(scene_, handle);
    }
    if (moved.count == movements.size()) return require(moved.status == QueryStatus::ok, "a whole batch is refused");
    const Movement& refused = movements[moved.count];
    if (moved.count == 0) require_unchanged();
    if (!model_.is_live(refused.instance))
        return require(moved.status == QueryStatus::stale_handle, "a stale handle is not refused as one");
    const std::uint32_t mesh = model_.live().at(refused.instance.slot).mesh;
    require(moved.status != QueryStatus::ok, "a batch has stopped without a reason");
    check_status(fate_of(mesh, refused.transform, scene_.step_exponent()), moved.status, QueryStatus::ok);
}

void Trial::set_any(Random& random) {
    const InstanceHandle handle = any_handle(random);
    const std::uint32_t word = random.below(16);
    const bool is_mask = random.coin();
    const QueryStatus status = is_mask ? set_mask(scene_, handle, word) : set_user(scene_, handle, word);
    if (!is_taken(handle, status)) return;
    require(status == QueryStatus::ok, "a word of a live instance cannot be changed");
    if (is_mask) model_.set_mask(handle, word);
    else model_.set_user(handle, word);
}

void Trial::repack_all() {
    repack(scene_);
    model_.refitted();
    require(quality(scene_) == 1.0f, "the quality after a repack is not 1");
}

void Trial::change(std::uint32_t kind, Random& random) {
    before_.assign(scene_.bytes().begin(), scene_.bytes().end());
    switch (kind % change_kinds) {
        case 0:
        case 1:
        case 2:
            return insert_any(random);
        case 3:
            return remove_any(random);
        case 4:
            return move_any(random);
        case 5:
            return move_some(random);
        case 6:
            return set_any(random);
        case 7:
            return repack_all();
        case 8:
            static_cast<void>(refit(scene_));
            return model_.refitted();
        default:
            end_step(scene_);
            return model_.step_ended();
    }
}

void Trial::check() {
    model_.check(scene_);
    tests::AlignedBuffer copy(scene_.bytes());
    const MovingScene opened = open_moving_scene(copy.bytes(), world().meshes(), world().tiles());
    require(static_cast<bool>(opened), "a copy of the block does not open");
    model_.check(opened);
}

}  // namespace espalier::fuzz
