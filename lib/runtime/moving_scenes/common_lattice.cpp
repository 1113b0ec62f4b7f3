#include <runtime/moving_scenes/access.hpp>

namespace espalier {

using namespace detail;

Lattice detail::common_region(const BlockHead& head, std::uint8_t number) {
    const std::int32_t reach = std::int32_t{1 << 16} << number, extent = 2 * reach - 1;
    const float low = -static_cast<float>(reach) * power_of_two(head.step_exponent);
    return {{low, low, low}, head.step_exponent, {extent, extent, extent}};
}

std::uint8_t detail::common_region_with(const MovingScene& scene, const InstanceSlot& slot) {
    if (!are_equal(slot.origin, {0, 0, 0})) return most_region;
    const BlockHead& head = MovingSceneAccess::head(scene);
    const MeshOrTile part = part_of(scene, slot.mesh);
    const auto is_held_by = [&](std::uint8_t number) {
        return lies_in(common_region(head, number), part, slot.transform);
    };
    std::uint8_t number = head.common_region;
    if (number != no_region && is_held_by(number)) return number;
    // From a near corner alone float32 may subtract a far translation exactly: a larger region would lose such a part.
    if (!is_held_by(most_region)) return number;
    if (number == no_region) number = 1;
    while (!is_held_by(number)) ++number;
    return number;
}

Result<Lattice> MovingScene::common_lattice() const noexcept {
    if (block_ == nullptr) return {{}, QueryStatus::not_open};
    const BlockHead& head = MovingSceneAccess::head(*this);
    const std::uint8_t number = are_equal(origin_, {0, 0, 0}) ? head.common_region : most_region;
    if (number == no_region) return {{}, QueryStatus::not_found};
    return {common_region(head, number), QueryStatus::ok};
}

YesNo is_on_common_lattice(const MovingScene& scene, InstanceId instance) noexcept {
    const Result<Instance> outer = instance_at(scene, InstanceId{instance.index});
    const Result<Instance> inner = instance_at(scene, instance);
    if (!inner) return YesNo(inner.status);
    const Result<Lattice> common = scene.common_lattice();
    if (!common) return YesNo::of(false);
    const MeshOrTile part = part_of(scene, outer->mesh);
    const std::int32_t(&origin)[3] = MovingSceneAccess::origin(scene);
    if (is_rounded_in(block_of(scene).slots[instance.index], origin, scene.step_exponent())) return YesNo::of(false);
    if (!lies_in(*common, part, outer->transform)) return YesNo::of(false);
    if (instance.in_tile == no_instance.in_tile) return YesNo::of(true);
    Lattice in_tile = *common;
    // mutant(== -> true, without 1) equivalent: the tile lies in the region, so that the same move was possible before
    return YesNo::of(move_region(outer->transform, in_tile) == QueryStatus::ok &&
                     lies_in(in_tile, part_of(data_of(*part.tile), inner->mesh), inner->transform));
}

}  // namespace espalier
