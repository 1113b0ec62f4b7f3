// The making of moving scenes, and what they return of themselves.
#include <runtime/moving_scenes/access.hpp>

namespace espalier {

using namespace detail;

namespace {

constexpr std::size_t alignment = alignof(BoxNode);

bool is_aligned(const std::byte* memory) { return reinterpret_cast<std::uintptr_t>(memory) % alignment == 0; }

/// Returns how many nodes fit into a block, as many as are ever needed.
std::uint32_t nodes_that_fit(std::uint64_t bytes, std::uint32_t slots) {
    const std::uint32_t most = most_nodes_of(slots);
    if (bytes >= block_bytes(slots, most)) return most;
    constexpr auto bytes_of_node = static_cast<std::uint32_t>(block_bytes(0, 1) - block_bytes(0, 0));
    return static_cast<std::uint32_t>(bytes - block_bytes(slots, 0)) / bytes_of_node;  // below 2^32, as with most nodes
}

/// Returns the head of a scene; of one that is not open, zeros.
const BlockHead& head_of(const MovingScene& scene) {
    static constexpr BlockHead none{};
    return scene ? MovingSceneAccess::head(scene) : none;
}

/// Returns the nearest float at or beyond a number of steps: below it for a direction of -1, above it for 1.
float outward(std::int32_t steps, int direction) {
    const auto rounded = static_cast<float>(steps);
    const std::int64_t error = static_cast<std::int64_t>(rounded) - steps;
    if (direction < 0 ? error <= 0 : error >= 0) return rounded;
    // Floats between 2^24 and 2^31 are at most 128 apart.
    return static_cast<float>(steps + direction * 128);
}

}  // namespace

Box detail::box_in_view(const MovingScene& scene, const StepsBox& box) {
    const std::int32_t(&origin)[3] = MovingSceneAccess::origin(scene);
    const float step = power_of_two(scene.step_exponent());
    // Both are within the world: differences have 32 bits.
    const auto low = [&](int k) { return outward(box.low[k] - origin[k], -1) * step; };
    const auto high = [&](int k) { return outward(box.high[k] - origin[k], 1) * step; };
    return {{low(0), low(1), low(2)}, {high(0), high(1), high(2)}};
}

std::uint64_t moving_scene_bytes(std::uint32_t instances) noexcept {
    if (instances == 0 || instances > most_slots) return 0;
    return block_bytes(instances, most_nodes_of(instances));
}

std::uint64_t least_moving_scene_bytes(std::uint32_t instances) noexcept {
    if (instances == 0 || instances > most_slots) return 0;
    return block_bytes(instances, least_nodes_of(instances));
}

MovingScene create_moving_scene(std::span<std::byte> memory, std::uint32_t capacity, int step_exponent,
                                std::span<const Blob> meshes, std::span<const BakedScene> tiles) noexcept {
    const std::uint64_t least = least_moving_scene_bytes(capacity);
    if (least == 0 || memory.size() < least || !is_aligned(memory.data()) || !is_step_exponent(step_exponent))
        return {};
    const std::uint32_t nodes = nodes_that_fit(memory.size(), capacity);
    // Parts that are not in use yet have the same bytes in every block.
    const auto size = static_cast<std::size_t>(block_bytes(capacity, nodes));
    for (std::byte& byte : memory.first(size)) byte = std::byte{0};
    make_block(memory.data(), capacity, nodes, step_exponent);
    return MovingSceneAccess::make(memory.data(), meshes, tiles);
}

MovingScene open_moving_scene(std::span<std::byte> snapshot, std::span<const Blob> meshes,
                              std::span<const BakedScene> tiles) noexcept {
    if (snapshot.size() < sizeof(BlockHead) || !is_aligned(snapshot.data())) return {};
    const MovingScene scene = MovingSceneAccess::make(snapshot.data(), meshes, tiles);
    const BlockHead& head = MovingSceneAccess::head(scene);
    const std::uint64_t least = least_moving_scene_bytes(head.slot_capacity);
    if (least == 0 || snapshot.size() < least || head.node_capacity > most_nodes_of(head.slot_capacity) ||
        head.node_capacity < least_nodes_of(head.slot_capacity) ||
        snapshot.size() < block_bytes(head.slot_capacity, head.node_capacity))
        return {};
    return is_sound(block_of(scene)) && has_boxes_of_instances(scene) ? scene : MovingScene();
}

std::uint32_t MovingScene::instance_count() const noexcept { return head_of(*this).live; }
std::uint32_t MovingScene::capacity() const noexcept { return head_of(*this).slot_capacity; }
std::uint32_t MovingScene::slot_end() const noexcept { return head_of(*this).slots_used; }
int MovingScene::step_exponent() const noexcept { return head_of(*this).step_exponent; }
bool MovingScene::must_refit() const noexcept { return head_of(*this).must_refit != 0; }
std::span<const std::byte> MovingScene::bytes() const noexcept {
    if (block_ == nullptr) return {};
    const BlockHead& head = MovingSceneAccess::head(*this);
    return {block_, static_cast<std::size_t>(block_bytes(head.slot_capacity, head.node_capacity))};
}

Result<InstanceHandle> handle_of(const MovingScene& scene, std::uint32_t slot) noexcept {
    if (!scene) return {{}, QueryStatus::not_open};
    const SceneBlock block = block_of(scene);
    if (slot >= block.head->slots_used) return {{}, QueryStatus::out_of_range};
    if (!is_live(block.slots[slot])) return {{}, QueryStatus::not_found};
    return {{slot, block.slots[slot].generation}, QueryStatus::ok};
}

Result<Instance> instance_at(const MovingScene& scene, InstanceHandle instance) noexcept {
    if (!scene) return {{}, QueryStatus::not_open};
    const SceneBlock block = block_of(scene);
    const InstanceSlot* const slot = find_slot(block, instance);
    if (slot == nullptr) return {{}, QueryStatus::stale_handle};
    return {{seen_transform(scene, *slot), slot->mesh, block.masks[instance.slot], slot->user, instance.slot},
            QueryStatus::ok};
}

Result<Instance> instance_at(const MovingScene& scene, InstanceId instance) noexcept {
    const Result<InstanceHandle> handle = handle_of(scene, instance.index);
    if (!handle) return {{}, handle.status};
    const Result<Instance> placed = instance_at(scene, *handle);
    if (instance.in_tile == no_instance.in_tile) return placed;
    const std::size_t meshes = scene.meshes().size();
    if (placed->mesh < meshes) return {{}, QueryStatus::invalid_argument};
    return instance_at(scene.tiles()[placed->mesh - meshes], InstanceId{instance.in_tile});
}

Result<Box> box_of(const MovingScene& scene, InstanceHandle instance) noexcept {
    if (!scene) return {{}, QueryStatus::not_open};
    const SceneBlock block = block_of(scene);
    const InstanceSlot* const slot = find_slot(block, instance);
    if (slot == nullptr) return {{}, QueryStatus::stale_handle};
    return {box_in_view(scene, slot->box), QueryStatus::ok};
}

}  // namespace espalier
