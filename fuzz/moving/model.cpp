#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "judge.hpp"
#include "world.hpp"

namespace espalier::fuzz {

namespace {

/// Returns at least how far a point of a part is from its local origin, along any axis, however it is turned.
double reach_of(std::uint32_t mesh) {
    const Box box = world().bounds_of(mesh);
    const auto along = [](float low, float high) {
        return static_cast<double>(std::max(std::abs(low), std::abs(high)));
    };
    return std::hypot(along(box.min.x, box.max.x), along(box.min.y, box.max.y), along(box.min.z, box.max.z));
}

bool is_valid(const Transform& transform) {
    const Quaternion& q = transform.rotation;
    const Vec3& by = transform.translation;
    for (const float number : {q.x, q.y, q.z, q.w, by.x, by.y, by.z, transform.scale})
        if (!std::isfinite(number)) return false;
    const bool has_rotation = q.x != 0.0f || q.y != 0.0f || q.z != 0.0f || q.w != 0.0f;
    return has_rotation && transform.scale >= 0x1p-100f && transform.scale <= 0x1p100f;
}

}  // namespace

Fate fate_of(std::uint32_t mesh, const Transform& transform, int step_exponent) {
    if (!is_valid(transform)) return Fate::invalid;
    const double end = std::ldexp((1 << 30) - 128, step_exponent);
    const double reach = static_cast<double>(transform.scale) * reach_of(mesh);
    const Vec3& by = transform.translation;
    const double far = static_cast<double>(std::max({std::abs(by.x), std::abs(by.y), std::abs(by.z)}));
    // Twice, since the box of a turned box is larger than what it holds.
    if ((far + 2.0 * reach) * 1.001 + std::ldexp(1.0, -95) < end) return Fate::inside;
    return far - reach > end ? Fate::outside : Fate::near_the_border;
}

void check_status(Fate fate, QueryStatus status, QueryStatus otherwise) {
    switch (fate) {
        case Fate::invalid:
            return require(status == QueryStatus::invalid_argument, "an invalid transform is not refused as one");
        case Fate::outside:
            return require(status == QueryStatus::out_of_range, "a place outside of the world is not refused as one");
        case Fate::inside:
            return require(status == otherwise, "a place in the world is refused, or a refusal has another reason");
        case Fate::near_the_border:
            return require(status == otherwise || status == QueryStatus::out_of_range, "a refusal has no reason");
    }
}

void check_box(const MovingScene& scene, InstanceHandle handle) {
    const Instance instance = *instance_at(scene, handle);
    const Result<Box> box = box_of(scene, handle);
    require(box.status == QueryStatus::ok, "an instance has no box");
    for (const Vec3& vertex : world().vertices_of(instance.mesh)) {
        const Vec3 at = to_world(instance.transform, vertex);
        require(at.x >= box->min.x && at.x <= box->max.x && at.y >= box->min.y && at.y <= box->max.y &&
                    at.z >= box->min.z && at.z <= box->max.z,
                "a vertex is outside of the box of its instance");
    }
}

Model::Model(const MovingScene& scene)
    : capacity_(scene.capacity()),
      knows_past_(false),
      knows_moved_(false),
      must_refit_(scene.must_refit()),
      slot_end_(scene.slot_end()) {
    for (std::uint32_t slot = 0; slot < slot_end_; ++slot) {
        const Result<InstanceHandle> handle = espalier::handle_of(scene, slot);
        if (!handle) continue;
        live_[slot] = *instance_at(scene, *handle);
        generations_[slot] = handle->generation;
    }
}

void Model::inserted(const Instance& instance, int step_exponent, const Result<InstanceHandle>& result) {
    if (!world().is_placeable(instance.mesh))
        return require(result.status == QueryStatus::invalid_argument, "a mesh that cannot be placed is not refused");
    // Worn slots leave a scene without room that has fewer instances than its capacity.
    const bool is_full = !has_room() || (!knows_past_ && result.status == QueryStatus::no_room);
    const Fate fate = fate_of(instance.mesh, instance.transform, step_exponent);
    check_status(fate, result.status, is_full ? QueryStatus::no_room : QueryStatus::ok);
    if (!result) return;
    const std::uint32_t slot = result->slot;
    require(slot < capacity_ && !live_.contains(slot), "insert() has returned a slot that is not free");
    if (knows_past_) {
        require(slot == (free_.empty() ? slot_end_ : free_.back()), "insert() has not taken the free slot that is due");
        const auto before = generations_.find(slot);
        require(result->generation == (before == generations_.end() ? 1 : before->second + 2),
                "a slot has another generation than its lives so far");
        if (!free_.empty()) free_.pop_back();
    }
    slot_end_ = std::max(slot_end_, slot + 1);
    live_[slot] = instance;
    generations_[slot] = result->generation;
    moved_.insert(slot);
}

void Model::removed(InstanceHandle handle) {
    live_.erase(handle.slot);
    free_.push_back(handle.slot);
    stale_.push_back(handle);
    if (stale_.size() > 64) stale_.erase(stale_.begin());
}

void Model::moved(InstanceHandle handle, const Transform& transform, bool by_batch) {
    live_.at(handle.slot).transform = transform;
    moved_.insert(handle.slot);
    must_refit_ |= by_batch;
}

void Model::check(const MovingScene& scene) const {
    require(scene.instance_count() == live_.size(), "another number of instances");
    require(scene.slot_end() == slot_end_, "another end of slots");
    require(scene.capacity() == capacity_, "another capacity");
    require(scene.must_refit() == must_refit_, "another answer to whether a refit must follow");
    for (std::uint32_t slot = 0; slot < slot_end_; ++slot) {
        const Result<InstanceHandle> handle = espalier::handle_of(scene, slot);
        const auto at = live_.find(slot);
        if (at == live_.end()) {
            require(handle.status == QueryStatus::not_found, "a free slot has a handle");
            continue;
        }
        require(handle.status == QueryStatus::ok && *handle == handle_of(slot), "a live slot has another handle");
        const Result<Instance> found = instance_at(scene, *handle);
        const Instance& instance = at->second;
        require(found.status == QueryStatus::ok && found->transform == instance.transform &&
                    found->mesh == instance.mesh && found->mask == instance.mask && found->user == instance.user &&
                    found->source == slot,
                "an instance is another one than was inserted");
    }
    require(espalier::handle_of(scene, slot_end_).status == QueryStatus::out_of_range, "a slot behind the end");
    for (const InstanceHandle& handle : stale_)
        require(instance_at(scene, handle).status == QueryStatus::stale_handle, "a stale handle is not refused");
    const float measured = quality(scene);
    require(measured >= 0.0f && (!live_.empty() || measured == 1.0f), "the quality is no number of the contract");
}

}  // namespace espalier::fuzz
