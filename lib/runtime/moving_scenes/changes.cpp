// Instances that come, move and go, and the upkeep of the tree.
#include <runtime/moving_scenes/access.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Finds the box of a placeable part in the world, at a place that counts from an origin. Returns ok or a refusal.
QueryStatus find_box(const PartBounds& bounds, const Transform& transform, const std::int32_t (&origin)[3],
                     const BlockHead& head, StepsBox& box) {
    if (!is_in_range(transform.scale)) return QueryStatus::invalid_argument;
    // The box of any other transform that is not valid is NaN.
    if (find_steps_box(bounds, transform, head.step_exponent, box) && move_to_world(origin, box))
        return QueryStatus::ok;
    return is_valid(transform) ? QueryStatus::out_of_range : QueryStatus::invalid_argument;
}

/// Writes a new box to the slot of a part, and not to the tree.
void write_box(const MovingScene& scene, SceneBlock& block, std::uint32_t number, const StepsBox& box) {
    InstanceSlot& slot = block.slots[number];
    slot.box = box;
    block.moved[number] = block.head->step;
    block.head->common_region = common_region_with(scene, slot);
}
/// Writes a new place and its box to the slot of a part, and not to the tree.
void write_place(const MovingScene& scene, SceneBlock& block, std::uint32_t number, const Transform& transform,
                 const StepsBox& box) {
    InstanceSlot& slot = block.slots[number];
    slot.transform = transform;
    for (int k = 0; k < 3; ++k) slot.origin[k] = MovingSceneAccess::origin(scene)[k];
    write_box(scene, block, number, box);
}

/// Places a slot if its box is in the world. Returns ok or a refusal.
QueryStatus place_slot(const MovingScene& scene, SceneBlock& block, std::uint32_t number, const PartBounds& bounds,
                       const Transform& transform) {
    StepsBox box;
    const QueryStatus status = find_box(bounds, transform, MovingSceneAccess::origin(scene), *block.head, box);
    if (status != QueryStatus::ok) return status;
    write_place(scene, block, number, transform, box);
    block.head->coarseness.add(bounds, transform);
    return QueryStatus::ok;
}

/// Moves the first eight of a batch, their boxes side by side, but not the boxes above them. Returns false, and changes
/// nothing, if there are fewer, or one is refused or has to be moved alone.
bool move_eight(const MovingScene& scene, SceneBlock& block, std::span<const Movement> movements) {
    constexpr unsigned count = EightStepsBoxes::count;
    if (movements.size() < count) return false;
    PartBounds bounds[count];
    const PartBounds* part = nullptr;
    std::uint32_t mesh = no_child;
    EightPlaces places;
    for (unsigned i = 0; i < count; ++i) {
        const InstanceSlot* const slot = find_slot(block, movements[i].instance);
        if (slot == nullptr) return false;
        // mutant(!= -> true) work: finds the bounds of the same mesh again
        if (slot->mesh != mesh) {
            bounds[i] = bounds_of_part(scene, mesh = slot->mesh);
            part = &bounds[i];
        }
        places.parts[i] = part;
        places.transforms[i] = &movements[i].transform;
    }
    EightStepsBoxes boxes;
    if (!find_steps_boxes_by_best_set(places, block.head->step_exponent, boxes)) return false;
    StepsBox in_world[count];
    for (unsigned i = 0; i < count; ++i) {
        in_world[i] = boxes[i];
        if (!move_to_world(MovingSceneAccess::origin(scene), in_world[i])) return false;
    }
    for (unsigned i = 0; i < count; ++i) {
        write_place(scene, block, movements[i].instance.slot, *places.transforms[i], in_world[i]);
        set_box(block, movements[i].instance.slot);
        const bool is_known = i != 0 && places.parts[i] == places.parts[i - 1] &&
                              places.transforms[i]->scale == places.transforms[i - 1]->scale;
        if (!is_known) block.head->coarseness.add(*places.parts[i], *places.transforms[i]);
    }
    return true;
}

/// Calls `change(block, slot)` with the live slot of a handle. Returns its status, or why the handle is refused.
template <class Change>
QueryStatus change_slot(MovingScene& scene, InstanceHandle instance, Change change) {
    if (!scene) return QueryStatus::not_open;
    SceneBlock block = block_of(scene);
    InstanceSlot* const slot = find_slot(block, instance);
    return slot != nullptr ? change(block, *slot) : QueryStatus::stale_handle;
}

}  // namespace

Result<InstanceHandle> insert(MovingScene& scene, const Instance& instance) noexcept {
    if (!scene) return {{}, QueryStatus::not_open};
    if (!is_placeable(scene, instance.mesh)) return {{}, QueryStatus::invalid_argument};
    SceneBlock block = block_of(scene);
    const PartBounds bounds = bounds_of_part(scene, instance.mesh);
    StepsBox box;
    const QueryStatus status = find_box(bounds, instance.transform, MovingSceneAccess::origin(scene), *block.head, box);
    if (status != QueryStatus::ok) return {{}, status};
    const std::uint32_t number = take_slot(block);
    if (number == no_child) return {{}, QueryStatus::no_room};
    InstanceSlot& slot = block.slots[number];
    slot.mesh = instance.mesh;
    block.masks[number] = instance.mask;
    slot.user = instance.user;
    write_place(scene, block, number, instance.transform, box);
    block.head->coarseness.add(bounds, instance.transform);
    insert_box(block, number);
    return {{number, slot.generation}, QueryStatus::ok};
}

QueryStatus remove(MovingScene& scene, InstanceHandle instance) noexcept {
    return change_slot(scene, instance, [&](SceneBlock& block, InstanceSlot&) {
        remove_box(block, instance.slot);
        give_back_slot(block, instance.slot);
        return QueryStatus::ok;
    });
}

QueryStatus move(MovingScene& scene, InstanceHandle instance, const Transform& transform) noexcept {
    return change_slot(scene, instance, [&](SceneBlock& block, InstanceSlot& slot) {
        const QueryStatus status = place_slot(scene, block, instance.slot, bounds_of_part(scene, slot.mesh), transform);
        if (status == QueryStatus::ok) update_box(block, instance.slot);
        return status;
    });
}

Filled move(MovingScene& scene, std::span<const Movement> movements) noexcept {
    Filled filled;
    if (!scene) return filled;
    filled.status = QueryStatus::ok;
    SceneBlock block = block_of(scene);
    // Most movements are of the same mesh as the one before.
    PartBounds bounds{};
    std::uint32_t mesh = no_child;
    while (filled.count != movements.size()) {
        if constexpr (!small_code)
            if (move_eight(scene, block, movements.subspan(filled.count))) {
                filled.count += EightStepsBoxes::count;
                continue;
            }
        const auto& [instance, transform] = movements[filled.count];
        InstanceSlot* const slot = find_slot(block, instance);
        if (slot == nullptr) {
            filled.status = QueryStatus::stale_handle;
            break;
        }
        // mutant(!= -> true) work: finds the bounds of the same mesh again
        if (slot->mesh != mesh) bounds = bounds_of_part(scene, mesh = slot->mesh);
        filled.status = place_slot(scene, block, instance.slot, bounds, transform);
        if (filled.status != QueryStatus::ok) break;
        set_box(block, instance.slot);
        ++filled.count;
    }
    if (filled.count != 0) block.head->must_refit = 1;
    return filled;
}

QueryStatus move_instances_of(MovingScene& scene, std::uint32_t mesh) noexcept {
    if (!scene) return QueryStatus::not_open;
    if (mesh >= scene.meshes().size()) return QueryStatus::invalid_argument;
    SceneBlock block = block_of(scene);
    const PartBounds bounds = bounds_of_part(scene, mesh);
    const auto for_each_instance = [&](auto change) {
        for (std::uint32_t number = 0; number < block.head->slots_used; ++number) {
            const InstanceSlot& slot = block.slots[number];
            if (!is_live(slot) || slot.mesh != mesh) continue;
            StepsBox box;
            const QueryStatus status = find_box(bounds, slot.transform, slot.origin, *block.head, box);
            if (status != QueryStatus::ok) return status;
            change(number, box);
        }
        return QueryStatus::ok;
    };
    const QueryStatus status = for_each_instance([](std::uint32_t, const StepsBox&) {});
    if (status != QueryStatus::ok) return status;
    return for_each_instance([&](std::uint32_t number, const StepsBox& box) {
        write_box(scene, block, number, box);  // the mesh may have another lattice
        set_box(block, number);
        block.head->must_refit = 1;
    });
}

QueryStatus set_mask(MovingScene& scene, InstanceHandle instance, std::uint32_t mask) noexcept {
    return change_slot(scene, instance, [&](SceneBlock& block, InstanceSlot&) {
        block.masks[instance.slot] = mask;
        return QueryStatus::ok;
    });
}

QueryStatus set_user(MovingScene& scene, InstanceHandle instance, std::uint32_t user) noexcept {
    return change_slot(scene, instance, [&](SceneBlock&, InstanceSlot& slot) {
        slot.user = user;
        return QueryStatus::ok;
    });
}

std::uint32_t refit(MovingScene& scene) noexcept {
    if (!scene) return 0;
    SceneBlock block = block_of(scene);
    block.head->must_refit = 0;
    return refit_boxes(block);
}

void repack(MovingScene& scene) noexcept {
    if (!scene) return;
    SceneBlock block = block_of(scene);
    BlockHead& head = *block.head;
    head.must_refit = 0;
    repack_boxes(block);
    head.packed_area = area_of_boxes(block) + 1.0f;  // not 0, also where all boxes are points
    head.coarseness = {};
    const InstanceSlot* last = nullptr;
    for (std::uint32_t number = 0; number < head.slots_used; ++number) {
        const InstanceSlot& slot = block.slots[number];
        if (!is_live(slot)) continue;
        const bool is_like_last =
            last != nullptr && slot.mesh == last->mesh && slot.transform.scale == last->transform.scale;
        if (!is_like_last) head.coarseness.add(bounds_of_part(scene, slot.mesh), slot.transform);
        last = &slot;
    }
}

float quality(const MovingScene& scene) noexcept {
    if (scene.instance_count() == 0) return 1.0f;
    const SceneBlock block = block_of(scene);
    return (area_of_boxes(block) + 1.0f) / block.head->packed_area;
}

void end_step(MovingScene& scene) noexcept {
    if (!scene) return;
    SceneBlock block = block_of(scene);
    if (++block.head->step != 0) return;
    // After 2^32 steps the numbers begin again.
    for (std::uint32_t number = 0; number < block.head->slots_used; ++number) block.moved[number] = 0;
    block.head->step = 1;
}

}  // namespace espalier
