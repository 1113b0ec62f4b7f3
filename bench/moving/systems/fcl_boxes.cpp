#include <fcl/fcl.h>

#include "../broad_phase.hpp"

namespace espalier::bench {
namespace {

/// A manager of FCL whose objects have boxes that the program hands over.
template <class Manager, class Scalar>
class FclBoxes final : public BroadPhase {
public:
    explicit FclBoxes(const Start& start) {
        for (std::uint32_t slot = 0; slot < start.boxes.size(); ++slot) {
            // The geometry is that of a unit cube, but FCL reads only the box.
            geometries_.push_back(std::make_shared<fcl::Box<Scalar>>(Scalar{1}, Scalar{1}, Scalar{1}));
            owned_.push_back(std::make_unique<Object>(geometries_.back()));
            owned_.back()->setUserData(reinterpret_cast<void*>(static_cast<std::uintptr_t>(slot)));
            objects_.push_back(owned_.back().get());
            set(slot, start.boxes[slot]);
        }
        manager_.registerObjects(objects_);
        manager_.setup();
    }
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        parts.begin();
        moved_.clear();
        for (const Movement& movement : frame.movements) {
            const std::uint32_t slot = movement.instance.slot;
            set(slot, frame.boxes[slot]);
            moved_.push_back(objects_[slot]);
        }
        // The first refits the whole tree, the second inserts objects again.
        if (moved_.size() == objects_.size()) manager_.update();
        else manager_.update(moved_);
        parts.end(Part::update);
        manager_.collide(&pairs, [](Object* a, Object* b, void* data) {
            // It also calls with some pairs that do not touch.
            if (a->getAABB().overlap(b->getAABB())) static_cast<PairList*>(data)->add(slot_of(*a), slot_of(*b));
            return false;
        });
        parts.end(Part::pairs);
    }

private:
    using Object = fcl::CollisionObject<Scalar>;
    static std::uint32_t slot_of(const Object& object) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
    }
    void set(std::uint32_t slot, const Box& box) {
        const auto vector = [](const Vec3& v) {
            return fcl::Vector3<Scalar>(static_cast<Scalar>(v.x), static_cast<Scalar>(v.y), static_cast<Scalar>(v.z));
        };
        geometries_[slot]->aabb_local = fcl::AABB<Scalar>(vector(box.min), vector(box.max));
        objects_[slot]->computeAABB();
    }

    Manager manager_;
    std::vector<std::shared_ptr<fcl::Box<Scalar>>> geometries_;
    std::vector<std::unique_ptr<Object>> owned_;
    std::vector<Object*> objects_, moved_;
};

}  // namespace

BroadPhaseMakers fcl_box_makers() {
    return {maker_of<FclBoxes<fcl::DynamicAABBTreeCollisionManager<double>, double>>("fcl, tree", "boxes"),
            maker_of<FclBoxes<fcl::DynamicAABBTreeCollisionManager<float>, float>>("fcl, tree of floats", "boxes"),
            maker_of<FclBoxes<fcl::DynamicAABBTreeCollisionManager_Array<double>, double>>("fcl, array", "boxes")};
}

}  // namespace espalier::bench
