#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include "broad_phase.hpp"

namespace espalier::bench::moving {
namespace {

btVector3 vector(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A broad phase of Bullet with its cache of pairs. The cache also has pairs whose boxes no longer touch, and those
/// that only touch with their margins: the exact boxes, which Bullet keeps, decide.
class BulletBoxes : public BroadPhase {
public:
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        for (const Movement& movement : frame.movements) {
            const std::uint32_t slot = movement.instance.slot;
            const Box& box = frame.boxes[slot];
            broad_phase_->setAabb(proxies_[slot], vector(box.min), vector(box.max), nullptr);
        }
        parts.end(Part::update);
        broad_phase_->calculateOverlappingPairs(nullptr);
        const btBroadphasePairArray& found = broad_phase_->getOverlappingPairCache()->getOverlappingPairArray();
        for (int i = 0; i < found.size(); ++i) {
            const btBroadphaseProxy &a = *found[i].m_pProxy0, &b = *found[i].m_pProxy1;
            if (!TestAabbAgainstAabb2(a.m_aabbMin, a.m_aabbMax, b.m_aabbMin, b.m_aabbMax)) continue;
            pairs.add(slot_of(a), slot_of(b));
        }
        parts.end(Part::pairs);
    }
    ~BulletBoxes() override {
        // Each proxy that is destroyed looks through all pairs.
        broad_phase_->getOverlappingPairCache()->getOverlappingPairArray().clear();
        for (btBroadphaseProxy* const proxy : proxies_) broad_phase_->destroyProxy(proxy, nullptr);
    }
    BulletBoxes(const BulletBoxes&) = delete;
    BulletBoxes& operator=(const BulletBoxes&) = delete;

protected:
    explicit BulletBoxes(std::unique_ptr<btBroadphaseInterface> broad_phase) : broad_phase_(std::move(broad_phase)) {}

    void create(const Start& start) {
        for (std::uintptr_t slot = 0; slot < start.boxes.size(); ++slot)
            proxies_.push_back(broad_phase_->createProxy(vector(start.boxes[slot].min), vector(start.boxes[slot].max),
                                                         0, reinterpret_cast<void*>(slot), 1, 1, nullptr));
    }

private:
    static std::uint32_t slot_of(const btBroadphaseProxy& proxy) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(proxy.m_clientObject));
    }

    std::unique_ptr<btBroadphaseInterface> broad_phase_;
    std::vector<btBroadphaseProxy*> proxies_;
};

/// The margin is a global of Bullet: systems with different margins take turns.
class BulletTree final : public BulletBoxes {
public:
    BulletTree(const Start& start, float margin) : BulletBoxes(std::make_unique<btDbvtBroadphase>()), margin_(margin) {
        gDbvtMargin = margin_;
        create(start);
    }
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        gDbvtMargin = margin_;
        BulletBoxes::step(frame, parts, pairs);
    }

private:
    float margin_;
};

class BulletAxisSweep final : public BulletBoxes {
public:
    explicit BulletAxisSweep(const Start& start) : BulletBoxes(made(start)) { create(start); }

private:
    static std::unique_ptr<btBroadphaseInterface> made(const Start& start) {
        const float side = start.motion.side(), margin = 0.01f * side;
        return std::make_unique<bt32BitAxisSweep3>(btVector3(-margin, -margin, -margin),
                                                   btVector3(side + margin, side + margin, side + margin),
                                                   static_cast<unsigned>(start.boxes.size() + 1), nullptr, true);
    }
};

}  // namespace

BroadPhaseMakers bullet_box_makers() {
    BroadPhaseMakers makers = {maker_of<BulletTree>("bullet, margin 0.05", "boxes", 0.05f),
                               maker_of<BulletTree>("bullet, margin 0.2", "boxes", 0.2f),
                               maker_of<BulletTree>("bullet, margin 0.5", "boxes", 0.5f),
                               maker_of<BulletAxisSweep>("bullet, axis sweep", "boxes")};
    makers.back().by_default = false;
    return makers;
}

}  // namespace espalier::bench::moving
