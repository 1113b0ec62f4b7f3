#include "world.hpp"

#include <cstring>
#include <stdexcept>

namespace falling {

using namespace espalier;

namespace {

constexpr int step_exponent = -10;  // 1 mm, a thousandth of the smallest thing
constexpr std::size_t first_room = 256;

void require(QueryStatus status) {
    if (status != QueryStatus::ok) throw std::runtime_error(describe(status));
}

/// Returns all pairs of a query. The array grows until there is room for them.
template <class Pair, class Collect>
std::span<const Pair> all_of(std::vector<Pair>& room, Collect collect) {
    for (;;) {
        const FilledPairs<Pair> found = collect(std::span<Pair>(room));
        if (found.status == QueryStatus::output_full) {
            room.resize(2 * room.size());
            continue;
        }
        require(found.status);
        return found.in(room);
    }
}

/// Counts what differs between two lists in ascending order.
Changes compare(std::span<const InstancePair> before, std::span<const InstancePair> now) {
    Changes changes;
    std::size_t i = 0, k = 0;
    while (i < before.size() || k < now.size()) {
        const bool has_ended = k == now.size() || (i < before.size() && before[i] < now[k]);
        const bool has_begun = !has_ended && (i == before.size() || now[k] < before[i]);
        changes.ended += has_ended ? 1u : 0u;
        changes.begun += has_begun ? 1u : 0u;
        i += has_begun ? 0u : 1u;
        k += has_ended ? 0u : 1u;
    }
    return changes;
}

}  // namespace

World::World(std::span<const Blob> meshes, const BakedScene& town, std::uint32_t capacity)
    : block_(static_cast<std::size_t>(moving_scene_bytes(capacity) / sizeof(Unit) + 1)),
      town_(town),
      room_(first_room),
      room_of_town_(first_room) {
    scene_ = create_moving_scene(std::as_writable_bytes(std::span(block_)), capacity, step_exponent, meshes);
    if (!scene_) throw std::runtime_error("the block is too small");
}

InstanceHandle World::insert(std::uint32_t mesh, const Transform& place, std::uint32_t user) {
    Instance instance;
    instance.mesh = mesh;
    instance.transform = place;
    instance.user = user;
    const Result<InstanceHandle> handle = espalier::insert(scene_, instance);
    require(handle.status);
    return *handle;
}

void World::remove(InstanceHandle instance) {
    require(espalier::remove(scene_, instance));
    // Its slot is used again: its pairs end here.
    changes_.ended += static_cast<std::uint32_t>(std::erase_if(
        pairs_, [&](const InstancePair& pair) { return pair.a == instance.slot || pair.b == instance.slot; }));
}

void World::move(std::span<const Movement> movements) {
    end_step(scene_);
    require(espalier::move(scene_, movements).status);
    if (++steps_ % 8 == 0) repack(scene_);
    else refit(scene_);
}

std::span<const InstancePair> World::find_pairs() {
    const std::span<const InstancePair> now = all_of(room_, [&](std::span<InstancePair> room) {
        return collect_colliding_pairs(scene_, room, WorkLimit::unlimited());
    });
    const Changes changes = compare(pairs_, now);
    changes_.begun += changes.begun;
    changes_.ended += changes.ended;
    pairs_.assign(now.begin(), now.end());
    return pairs_;
}

const std::vector<Touch>& World::find_touches() {
    const std::span<const BakedPair> pairs = all_of(room_of_town_, [&](std::span<BakedPair> room) {
        return collect_colliding_pairs(scene_, town_, room, WorkLimit::unlimited());
    });
    touches_.clear();
    for (const BakedPair& pair : pairs) {
        const Instance body = instance_in(pair.moving);
        const Transform at = instance_at(town_, pair.baked)->transform;
        const ClosestPoint nearest =
            closest_point(*mesh_at(town_, pair.baked), to_local(at, body.transform.translation));
        require(nearest.status);
        touches_.push_back({body.user, normal_to_world(at, nearest.face_normal)});
    }
    return touches_;
}

Below World::look_down(InstanceHandle instance) const {
    const Vec3 eye = instance_at(scene_, instance)->transform.translation;
    Ray ray = {.origin = eye, .direction = {0.0f, 0.0f, -1.0f}};
    const InScene<RayHit> in_town = raycast(town_, ray);
    if (in_town) ray.t_max = in_town->t;
    const auto is_other = [&](InstanceId id, TriangleId) { return id.index != instance.slot; };
    if (raycast(scene_, ray, is_other)) return Below::body;
    return in_town ? Below::town : Below::nothing;
}

Changes World::take_changes() {
    const Changes taken = changes_;
    changes_ = {};
    return taken;
}

std::uint32_t World::user_of(std::uint32_t slot) const { return instance_in(slot).user; }

Instance World::instance_in(std::uint32_t slot) const { return *instance_at(scene_, *handle_of(scene_, slot)); }

Snapshot World::snapshot() const {
    const std::span<const std::byte> bytes = scene_.bytes();
    return {{bytes.begin(), bytes.end()}, pairs_, steps_};
}

void World::restore(const Snapshot& snapshot) {
    std::memcpy(block_.data(), snapshot.bytes.data(), snapshot.bytes.size());
    pairs_ = snapshot.pairs;
    steps_ = snapshot.steps;
}

}  // namespace falling
