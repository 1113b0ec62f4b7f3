#include "collision_loop.hpp"

#include <espalier/pair.hpp>

#include "world.hpp"

namespace espalier::fuzz {

namespace {

Verdict touch_of_meshes(const PlacedPart& a, const PlacedPart& b) {
    const YesNo answer =
        overlaps(PlacedBlob(*a.mesh, a.transform), PlacedBlob(*b.mesh, b.transform), WorkLimit::unlimited());
    if (is_refused(answer.status())) return Verdict::refused;
    return answer.yes() ? Verdict::touching : Verdict::apart;
}

/// Joins the verdicts about the meshes of a tile, in whose order the library may stop at the first that is refused or
/// touches, and of which it may leave out those that are far away.
class TileVerdict {
public:
    void add(Verdict verdict) {
        is_touching_ |= verdict == Verdict::touching;
        is_unknown_ |= verdict == Verdict::refused || verdict == Verdict::unknown;
    }
    [[nodiscard]] Verdict joined() const {
        if (is_unknown_) return Verdict::unknown;
        return is_touching_ ? Verdict::touching : Verdict::apart;
    }

private:
    bool is_touching_ = false;
    bool is_unknown_ = false;
};

}  // namespace

PlacedPart part_of(const Instance& instance) {
    const std::size_t meshes = world().meshes().size();
    if (instance.mesh < meshes) return {&world().meshes()[instance.mesh], nullptr, instance.transform};
    return {nullptr, &world().tiles()[instance.mesh - meshes], instance.transform};
}

PlacedPart part_in(const BakedScene& scene, InstanceId instance, const Blob& mesh) {
    return {&mesh, nullptr, instance_at(scene, instance)->transform};
}

Verdict touches(const PlacedPart& a, const PlacedPart& b) {
    if (a.tile == nullptr && b.tile == nullptr) return touch_of_meshes(a, b);
    if (a.tile == nullptr) return touches(b, a);
    const PlacedPart b_in_a = {b.mesh, b.tile, to_local(a.transform, b.transform)};
    TileVerdict verdict;
    for (std::uint32_t i = 0; i < a.tile->instance_count(); ++i) {
        const Blob mesh = *mesh_at(*a.tile, {i});
        const PlacedPart inner = part_in(*a.tile, {i}, mesh);
        verdict.add(touches(b_in_a, inner));
    }
    return verdict.joined();
}

}  // namespace espalier::fuzz
